#include "tests/house/source_tree.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "core/file.hpp"

namespace skinfit::house {
namespace {

const std::filesystem::path root = SKINFIT_SOURCE_DIR;

bool holds_cpp(const std::filesystem::path& folder) {
    return std::ranges::any_of(std::filesystem::directory_iterator(folder), [](const auto& entry) {
        return entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp";
    });
}

SourceFile source_file(const std::filesystem::path& path) {
    return {.path = path.lexically_relative(root).generic_string(), .text = read_file(path)};
}

}  // namespace

std::vector<std::string> source_folders() {
    std::vector<std::string> folders;
    for (const auto& entry : std::filesystem::directory_iterator(root)) {
        const std::string name = entry.path().filename().string();
        if (!entry.is_directory() || name == "tests" || !std::filesystem::exists(entry.path() / "CMakeLists.txt")) {
            continue;
        }
        if (holds_cpp(entry.path())) folders.push_back(name);
    }
    std::ranges::sort(folders);
    return folders;
}

std::vector<SourceFile> source_files(const std::vector<std::string>& folders, const std::vector<std::string>& endings) {
    std::vector<SourceFile> files;
    for (const std::string& folder : folders) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            const std::string ending = entry.path().extension().string();
            if (!entry.is_regular_file() || std::ranges::find(endings, ending) == endings.end()) continue;
            files.push_back(source_file(entry.path()));
        }
    }
    std::ranges::sort(files, {}, &SourceFile::path);
    return files;
}

std::vector<SourceFile> documents() {
    std::vector<SourceFile> files = source_files({"docs"}, {".md"});
    for (const auto& entry : std::filesystem::directory_iterator(root)) {
        if (entry.path().extension() == ".md") files.push_back(source_file(entry.path()));
    }
    files.push_back(source_file(root / "model/REFERENCES.md"));
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
