#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>

namespace skinfit::test {

/// A folder of its own for each test, removed afterwards.
class TemporaryFolder : public testing::Test {
protected:
    void SetUp() override {
        std::string name = testing::TempDir() + "skinfit_XXXXXX";  // mkdtemp puts a name of its own for the Xs
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::filesystem::path in_folder(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] std::ptrdiff_t entries() const {
        return std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator());
    }

private:
    std::filesystem::path folder_;
};

}  // namespace skinfit::test
