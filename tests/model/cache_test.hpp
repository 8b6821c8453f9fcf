#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/disk_cache.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit::test {

/// A cache in a folder of its own, which is not there at first, and what it says.
class CacheTest : public TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        folder = in_folder("cache");
    }

    DiskCache cache() {
        return {.folder = folder,
                .warn = [this](const std::string& text) { warnings.push_back(text); },
                .inform = [this](const std::string&) { ++made; }};
    }

    std::filesystem::path folder;
    std::vector<std::string> warnings;
    int made = 0;  ///< how often something costly was begun
};

}  // namespace skinfit::test
