#include "tests/house/source_tree.hpp"

#include <algorithm>
#include <filesystem>

#include "core/file.hpp"

namespace skinfit::house {
namespace {

const std::filesystem::path root = SKINFIT_SOURCE_DIR;

}  // namespace

std::vector<SourceFile> source_files(const std::vector<std::string>& folders, const std::vector<std::string>& endings) {
    std::vector<SourceFile> files;
    for (const std::string& folder : folders) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            const std::string ending = entry.path().extension().string();
            if (!entry.is_regular_file() || std::ranges::find(endings, ending) == endings.end()) continue;
            files.push_back(
                {.path = entry.path().lexically_relative(root).generic_string(), .text = read_file(entry.path())});
        }
    }
    std::ranges::sort(files, {}, &SourceFile::path);
    return files;
}

std::string source_text(const std::string& path) {
    return read_file(root / path);
}

bool source_exists(const std::string& path) {
    return std::filesystem::exists(root / path);
}

}  // namespace skinfit::house
