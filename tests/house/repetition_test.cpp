#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "tests/house/source_tree.hpp"

/// What is written twice must be changed twice.
namespace skinfit::house {
namespace {

/// Lines that say something; so many of them, one after the other, must not stand in two places.
constexpr std::size_t block_lines = 6;

struct CodeLine {
    std::size_t number;
    std::string_view text;
};

/// Whether a line says something that could be said once: not that it includes, comments, closes or names a scope.
bool is_code(std::string_view line) {
    const auto starts = [&](std::string_view word) { return line.starts_with(word); };
    return std::ranges::any_of(line, [](char c) { return std::isalnum(static_cast<unsigned char>(c)); }) &&
           !starts("#") && !starts("//") && !starts("namespace ") && !starts("using ") && !starts("import ") &&
           !starts("}");
}

std::vector<CodeLine> code_of(std::string_view text) {
    std::vector<CodeLine> code;
    std::size_t number = 0;
    for (const std::string_view line : split_lines(text)) {
        ++number;
        if (is_code(trimmed(line))) code.push_back({.number = number, .text = trimmed(line)});
    }
    return code;
}

/// "second:line repeats first:line" of every block that stands in two places.
std::vector<std::string> repetitions(const std::vector<SourceFile>& files) {
    std::map<std::string, std::string> places;
    std::vector<std::string> found;
    for (const SourceFile& file : files) {
        const std::vector<CodeLine> code = code_of(file.text);
        for (std::size_t first = 0; first + block_lines <= code.size(); ++first) {
            std::string block;
            for (std::size_t i = 0; i < block_lines; ++i) block += std::string(code[first + i].text) + '\n';
            const std::string place = fmt::format("{}:{}", file.path, code[first].number);
            const auto [known, is_new] = places.emplace(block, place);
            if (!is_new) found.push_back(fmt::format("{} repeats {}", place, known->second));
        }
    }
    return found;
}

TEST(Repetition, NoBlockOfCodeStandsInTwoPlaces) {
    std::vector<std::string> folders = source_folders();
    folders.emplace_back("tests");
    std::vector<SourceFile> files = source_files(folders, {".cpp", ".hpp"});
    std::ranges::move(source_files({"web/src"}, {".ts", ".tsx"}), std::back_inserter(files));
    EXPECT_GT(files.size(), 600U);
    EXPECT_THAT(repetitions(files), testing::IsEmpty());
}

TEST(Repetition, IsFoundHoweverItIsIndented) {
    const SourceFile once{.path = "a.cpp", .text = "#include <a>\none\ntwo\n\nthree\n}\nfour\nfive\nsix\n"};
    const SourceFile twice{.path = "b.cpp", .text = "zero\n  one\n  two\n  three\n  // four\n  four\n  five\n  six\n"};
    const SourceFile five{.path = "c.cpp", .text = "one\ntwo\nthree\nfour\nfive\n"};
    EXPECT_THAT(repetitions({once, twice, five}), testing::ElementsAre("b.cpp:2 repeats a.cpp:2"));
    EXPECT_THAT(repetitions({{.path = "d.cpp", .text = once.text + once.text}}),
                testing::Contains("d.cpp:11 repeats d.cpp:2"));
}

}  // namespace
}  // namespace skinfit::house
