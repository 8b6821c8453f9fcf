#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>

#include "core/text.hpp"
#include "core/version.hpp"
#include "tests/house/source_tree.hpp"

namespace skinfit::house {
namespace {

/// The value of a key of the outermost level of `yaml`, on the key's line; empty where there is none.
std::string top_value(std::string_view yaml, std::string_view key) {
    for (const std::string_view line : split_lines(yaml)) {
        if (line.starts_with(key) && line.substr(key.size()).starts_with(": "))
            return std::string(trimmed(line.substr(key.size() + 1)));
    }
    return {};
}

/// What follows `before` in `text`, up to white space; empty where `text` has no `before`.
std::string word_after(std::string_view text, std::string_view before) {
    const std::size_t found = text.find(before);
    if (found == std::string_view::npos) return {};
    const std::string_view rest = text.substr(found + before.size());
    return std::string(rest.substr(0, rest.find_first_of(" \n")));
}

/// The options that a CMake file declares.
std::set<std::string> declared_options(std::string_view cmake) {
    constexpr std::string_view declaration = "option(";
    std::set<std::string> options;
    for (const std::string_view line : split_lines(cmake)) {
        if (line.starts_with(declaration)) options.insert(word_after(line, declaration));
    }
    return options;
}

/// `text` as a block of code of a document in Markdown.
std::string code_block(const std::string& language, const std::string& text) {
    return "```" + language + "\n" + text + "```\n";
}

const std::string citation_path = "CITATION.cff";
const std::string installing_path = "docs/installing.md";

TEST(Citation, HasTheVersionOfTheProgram) {
    EXPECT_EQ(top_value(source_text(citation_path), "version"), version);
}

TEST(Citation, NamesThePaperOfTheReferences) {
    const std::string doi = word_after(source_text("model/REFERENCES.md"), "doi:");
    EXPECT_EQ(word_after(source_text(citation_path), "doi: "), doi);
    EXPECT_TRUE(doi.starts_with("10.")) << doi;
}

TEST(Citation, HasTheLicenceOfTheProject) {
    EXPECT_EQ(top_value(source_text(citation_path), "license") + " License\n",
              source_text("LICENSE").substr(0, sizeof("MIT License")));
}

TEST(Installing, ExplainsEveryOption) {
    const std::string text = source_text(installing_path);
    const std::set<std::string> options = declared_options(source_text("CMakeLists.txt"));
    EXPECT_TRUE(options.contains("SKINFIT_WEB"));
    for (const std::string& option : options) EXPECT_NE(text.find("`" + option + "`"), std::string::npos) << option;
}

TEST(Installing, ShowsTheExampleThatIsTested) {
    const std::string text = source_text(installing_path);
    for (const auto& [language, file] : {std::pair("cmake", "CMakeLists.txt"), std::pair("cpp", "main.cpp")}) {
        const std::string example = source_text(std::string("tests/install/example/") + file);
        EXPECT_NE(text.find(code_block(language, example)), std::string::npos) << file;
    }
}

TEST(Documents, AValueIsThatOfTheOutermostKeyAlone) {
    EXPECT_EQ(top_value("a: 1\nb:\n  version: 2\nversion: 3\n", "version"), "3");
    EXPECT_EQ(top_value("cff-version: 1\nversions: 2\n", "version"), "");
}

}  // namespace
}  // namespace skinfit::house
