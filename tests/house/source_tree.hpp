#pragma once

#include <string>
#include <vector>

namespace skinfit::house {

/// One file of the project.
struct SourceFile {
    std::string path;  ///< from the project's root, with slashes
    std::string text;
};

/// The folders of the project's own C++ but for its tests, in alphabetical order: those in the root that have sources
/// beside a CMakeLists.txt.
[[nodiscard]] std::vector<std::string> source_folders();

/// The files in the project's `folders`, at any depth, that end in one of `endings`, ordered by path. Build folders lie
/// outside these and are never read.
[[nodiscard]] std::vector<SourceFile> source_files(const std::vector<std::string>& folders,
                                                   const std::vector<std::string>& endings);

/// What the project tells its readers: the Markdown files of its root and of docs, and model/REFERENCES.md.
[[nodiscard]] std::vector<SourceFile> documents();

/// The text of the project's file at `path`, from the project's root.
[[nodiscard]] std::string source_text(const std::string& path);

/// Whether the project has a file or folder at `path`, from the project's root.
[[nodiscard]] bool source_exists(const std::string& path);

}  // namespace skinfit::house
