#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "tests/house/source_shape.hpp"
#include "tests/house/source_tree.hpp"

/// A file fits in one sitting, a function on one screen, and every public declaration is explained.
namespace skinfit::house {
namespace {

constexpr std::ptrdiff_t longest_file = 300;
constexpr int longest_function = 60;

std::vector<SourceFile> sources(const std::vector<std::string>& endings) {
    return source_files(source_folders(), endings);
}

TEST(Shape, NoFileIsLongerThanASitting) {
    std::vector<std::string> folders = source_folders();
    folders.emplace_back("tests");
    for (const SourceFile& file : source_files(folders, {".cpp", ".hpp"})) {
        EXPECT_LE(std::ranges::count(file.text, '\n'), longest_file) << file.path;
    }
}

TEST(Shape, NoFunctionIsLongerThanAScreen) {
    std::size_t functions = 0;
    for (const SourceFile& file : sources({".cpp", ".hpp"})) {
        for (const FunctionLength& each : functions_in(file.text)) {
            EXPECT_LE(each.lines, longest_function) << file.path << ": " << each.first_line;
            ++functions;
        }
    }
    EXPECT_GT(functions, 1000U);
}

TEST(Shape, MeasuresFunctionsOfNamespacesAndClasses) {
    const std::vector<FunctionLength> found = functions_in(
        "namespace skinfit {\ndouble half(\n    double x) {\n    if (x < 0.0) {\n        x = 0.0;\n    }\n    return x "
        "/ "
        "2.0;\n}\nconstexpr int list[] = {\n    1,\n};\nclass Two {\n    int two() {\n        return 2;\n    "
        "}\n};\n}\n");
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].first_line, "double half(");
    EXPECT_EQ(found[0].lines, 7);
    EXPECT_EQ(found[1].first_line, "int two() {");
    EXPECT_EQ(found[1].lines, 3);
}

TEST(Shape, EveryPublicDeclarationIsExplained) {
    for (const SourceFile& file : sources({".hpp"})) {
        EXPECT_THAT(undocumented_in(file.text), testing::IsEmpty()) << file.path;
    }
}

TEST(Shape, FindsWhatIsNotExplained) {
    EXPECT_THAT(undocumented_in("namespace skinfit {\n\n/// Explained, with the next.\nint one();\nint two();\n\nint "
                                "three(int a,\n          int b);\n\nclass Box {\npublic:\n    explicit Box(int);\n    "
                                "[[nodiscard]] int four() const;\n\nprivate:\n    [[nodiscard]] int five() const;\n};\n"
                                "inline constexpr int six = 6;  ///< explained\n\n}\n"),
                testing::ElementsAre("int three(int a,", "class Box {", "[[nodiscard]] int four() const;"));
}

/// The header that defines each public type.
std::map<std::string, std::string> homes_of_types(const std::vector<std::string>& folders) {
    std::map<std::string, std::string> homes;
    for (const SourceFile& file : source_files(folders, {".hpp"})) {
        for (const std::string& type : types_in(file.text)) {
            const auto [home, is_new] = homes.emplace(type, file.path);
            EXPECT_TRUE(is_new || home->second == file.path)
                << type << " is defined in " << home->second << " and in " << file.path;
        }
    }
    return homes;
}

/// Two types of one name would be one to the linker, which keeps one destructor for both.
TEST(Shape, NoTwoHeadersDefineTypesOfOneName) {
    std::vector<std::string> folders = source_folders();
    folders.emplace_back("tests");
    EXPECT_GT(homes_of_types(folders).size(), 300U);
}

TEST(Shape, NoSourceFileHasATypeOfItsOwnWithAPublicName) {
    std::map<std::string, std::string> homes = homes_of_types(source_folders());
    std::erase_if(homes, [](const auto& home) { return home.second == "model/vector_scattering.hpp"; });  // per CPU
    for (const SourceFile& file : sources({".cpp"})) {
        for (const std::string& type : types_in(file.text)) {
            EXPECT_FALSE(homes.contains(type)) << type << " of " << file.path << " is in " << homes[type] << " too";
        }
    }
}

TEST(Shape, FindsTheTypesOfAHeader) {
    EXPECT_THAT(
        types_in("namespace skinfit {\n\nstruct Known;\nclass Box final : public Known {\n    struct Inner {\n    "
                 "};\n};\nstruct Empty {};\nenum class Side : int { left, right };\nusing Row = "
                 "std::vector<Box>;\nusing std::min;\nstruct Long\n    : Known {\n};\n\n}\n"),
        testing::ElementsAre("Box", "Empty", "Side", "Row", "Long"));
}

}  // namespace
}  // namespace skinfit::house
