#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/text.hpp"
#include "tests/house/source_tree.hpp"

namespace skinfit::house {
namespace {

/// What each folder may include, from the project's own folders.
const std::map<std::string, std::vector<std::string>, std::less<>> permitted = {
    {"core", {"core"}},
    {"model", {"core", "model"}},
    {"measurements", {"core", "measurements"}},
    {"fit", {"core", "model", "measurements", "fit"}},
    {"validation", {"core", "model", "measurements", "fit", "validation"}},
    {"report", {"core", "model", "measurements", "fit", "report"}},
    {"study", {"core", "model", "measurements", "fit", "report", "study"}},
    {"bench", {"core", "model", "measurements", "fit", "bench"}},
    {"explore", {"core", "model", "measurements", "fit", "report", "explore"}},
    {"app", {"core", "model", "measurements", "fit", "report", "validation", "study", "bench", "explore", "app"}},
};

std::string first_folder(std::string_view path) {
    return std::string(path.substr(0, path.find('/')));
}

/// What a line includes, between quotes or angle brackets; empty where it includes nothing.
std::string_view included(std::string_view line) {
    line = trimmed(line);
    if (!line.starts_with('#')) return {};
    line = trimmed(line.substr(1));
    if (!line.starts_with("include")) return {};
    const std::size_t open = line.find_first_of("\"<");
    if (open == std::string_view::npos) return {};
    return line.substr(open + 1, line.find_first_of("\">", open + 1) - open - 1);
}

/// Every include of `file`, one of the folders of `permitted`, that reaches into a folder it must not know.
std::vector<std::string> forbidden_includes(const SourceFile& file) {
    const std::vector<std::string>& may = permitted.at(first_folder(file.path));
    std::vector<std::string> forbidden;
    for (const std::string_view line : split_lines(file.text)) {
        const std::string target = first_folder(included(line));
        const bool is_ours = permitted.contains(target) || target == "tests";
        if (is_ours && std::ranges::find(may, target) == may.end()) {
            forbidden.push_back(file.path + ": " + std::string(trimmed(line)));
        }
    }
    return forbidden;
}

using Complaints = std::vector<std::string>;

TEST(Dependencies, PointOneWay) {
    const std::vector<SourceFile> files = source_files(
        {"core", "model", "measurements", "fit", "report", "validation", "study", "bench", "explore", "app"},
        {".cpp", ".hpp"});
    ASSERT_FALSE(files.empty());
    Complaints forbidden;
    for (const SourceFile& file : files) std::ranges::copy(forbidden_includes(file), std::back_inserter(forbidden));
    EXPECT_EQ(forbidden, Complaints());
}

TEST(Dependencies, AnIncludeAgainstTheDirectionIsFound) {
    const auto complaints = [](const std::string& folder, const std::string& target) {
        return forbidden_includes({.path = folder + "/a.cpp", .text = "#include \"" + target + "/b.hpp\"\n"}).size();
    };
    for (const auto& [folder, may] : permitted) {
        for (const auto& [target, unused] : permitted) {
            const std::size_t expected = std::ranges::find(may, target) == may.end() ? 1 : 0;
            EXPECT_EQ(complaints(folder, target), expected) << folder << " includes " << target;
        }
        EXPECT_EQ(complaints(folder, "tests"), 1U) << folder << " includes tests";
    }
}

TEST(Dependencies, EveryWayToWriteAnIncludeIsRead) {
    const SourceFile file{.path = "model/a.cpp",
                          .text =
                              "  # include  <fit/b.hpp>\r\n#include <vector>\n#include \"app/c.hpp\"  // why\n"
                              "// #include \"fit/d.hpp\"\n#define include \"fit/e.hpp\"\n"};
    EXPECT_EQ(forbidden_includes(file),
              (Complaints{"model/a.cpp: # include  <fit/b.hpp>", "model/a.cpp: #include \"app/c.hpp\"  // why"}));
}

}  // namespace
}  // namespace skinfit::house
