#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/text.hpp"
#include "tests/house/source_tree.hpp"

/// Every test that docs/faults.md names as the one that catches a fault exists, under the label given there.
namespace skinfit::house {
namespace {

using Complaints = std::vector<std::string>;
using Labels = std::map<std::string, std::string>;  // of tests, by Suite.Name; empty where the folder states none

/// The label that a CMakeLists.txt gives the tests of `file`.
std::string label_of(std::string_view cmake, const std::string& file) {
    constexpr std::string_view call = "skinfit_test(";
    for (const std::string_view line : split_lines(cmake)) {
        if (!line.starts_with(call)) continue;
        const std::vector<std::string_view> words = split(line.substr(call.size()), ' ');
        if (words.size() > 1 && trimmed(words[1].substr(0, words[1].find(')'))) == file) return std::string(words[0]);
    }
    return {};
}

/// `Suite.Name` of each test that a source declares.
std::vector<std::string> tests_in(std::string_view source) {
    std::vector<std::string> tests;
    for (const std::string_view macro : {"\nTEST(", "\nTEST_F(", "\nTEST_P("}) {
        for (std::size_t at = source.find(macro); at != std::string_view::npos; at = source.find(macro, at + 1)) {
            const std::string_view inside = source.substr(at + macro.size());
            const std::vector<std::string_view> names = split(inside.substr(0, inside.find(')')), ',');
            if (names.size() == 2) tests.push_back(std::string(names[0]) + "." + std::string(names[1]));
        }
    }
    return tests;
}

Labels all_tests() {
    Labels labels;
    for (const SourceFile& file : source_files({"tests"}, {".cpp"})) {
        const std::size_t slash = file.path.rfind('/');
        const std::string cmake = file.path.substr(0, slash) + "/CMakeLists.txt";
        const std::string label =
            source_exists(cmake) ? label_of(source_text(cmake), file.path.substr(slash + 1)) : std::string();
        for (const std::string& test : tests_in(file.text)) labels.emplace(test, label);
    }
    return labels;
}

/// What is wrong with the last cell of a row of the table, "`Suite.Name` (label)" once or more.
Complaints faults_of_cell(std::string_view cell, const Labels& tests) {
    Complaints complaints;
    std::size_t named = 0;
    for (std::size_t begin = cell.find('`'); begin != std::string_view::npos; begin = cell.find('`', begin)) {
        const std::size_t end = std::min(cell.find('`', begin + 1), cell.size());
        const std::string name(cell.substr(begin + 1, end - begin - 1));
        const std::string_view behind = cell.substr(std::min(end + 1, cell.size()));
        begin = std::min(end + 1, cell.size());
        ++named;
        const auto found = tests.find(name);
        if (found == tests.end()) {
            complaints.push_back(name + " is no test");
        } else if (!behind.starts_with(" (" + found->second + ")")) {
            complaints.push_back(name + " has the label " + found->second);
        }
    }
    if (named == 0) complaints.push_back("no test in: " + std::string(cell));
    return complaints;
}

/// The last cells of the rows that begin with a number.
std::vector<std::string> last_cells(std::string_view document) {
    std::vector<std::string> cells;
    for (const std::string_view line : split_lines(document)) {
        if (line.size() < 3 || !line.starts_with("| ") || line[2] < '0' || line[2] > '9') continue;
        const std::string_view row = trimmed(line.substr(0, line.rfind('|')));
        cells.emplace_back(trimmed(row.substr(row.rfind(" | ") + 3)));
    }
    return cells;
}

TEST(Faults, AreCaughtByTestsThatExist) {
    const Labels tests = all_tests();
    const std::vector<std::string> cells = last_cells(source_text("docs/faults.md"));
    EXPECT_GE(cells.size(), 24U);
    for (const std::string& cell : cells) EXPECT_EQ(faults_of_cell(cell, tests), Complaints());
}

TEST(Faults, ATestThatIsGoneIsMissed) {
    const std::string document = source_text("docs/faults.md");
    for (const std::string& cell : last_cells(document)) EXPECT_FALSE(faults_of_cell(cell, {}).empty()) << cell;
}

TEST(Faults, EveryWrongNameIsFound) {
    const Labels tests = {{"A.Holds", "unit"}, {"B.Holds", "validation"}};
    const std::string document =
        "| n | caught by |\n|---|---|\n"
        "| 1 | `a \\|\\| b` | `A.Holds` (unit) |\n| 2 | `A.Holds` (unit), `B.Holds` (validation) |\n"
        "| 3 | `A.Hold` (unit) |\n| 4 | `B.Holds` (unit) |\n| 5 | nothing |\n| 6 | `A.Holds` |\n";
    Complaints complaints;
    for (const std::string& cell : last_cells(document)) {
        for (const std::string& complaint : faults_of_cell(cell, tests)) complaints.push_back(complaint);
    }
    EXPECT_EQ(complaints, (Complaints{"A.Hold is no test", "B.Holds has the label validation", "no test in: nothing",
                                      "A.Holds has the label unit"}));
}

TEST(Faults, TestsAreReadFromSources) {
    EXPECT_EQ(
        tests_in("\nTEST(A, B) {\n// TEST(C, D)\n    EXPECT(TEST(E, F));\nTEST_P(G,\n       H) {\nTEST_F(I, J) {"),
        (std::vector<std::string>{"A.B", "I.J", "G.H"}));
    EXPECT_EQ(label_of("# skinfit_test(label source libraries...)\nskinfit_test(unit a.cpp b)\nskinfit_test(cli b.cpp)",
                       "b.cpp"),
              "cli");
    EXPECT_EQ(label_of("skinfit_test(unit aa.cpp b)", "a.cpp"), "");
}

}  // namespace
}  // namespace skinfit::house
