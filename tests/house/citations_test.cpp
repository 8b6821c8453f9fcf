#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/text.hpp"
#include "tests/house/markdown.hpp"
#include "tests/house/source_tree.hpp"

namespace skinfit::house {
namespace {

using Names = std::set<std::string, std::less<>>;

bool is_upper(char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}

/// The citation key behind the bracket at `open`: two capitals or more, digits, then a comma or the closing bracket.
/// Empty where there is none: for an index (`values[N]`), an attribute, or a Markdown link.
std::string key_at(std::string_view text, std::size_t open) {
    constexpr std::string_view indexed = "_)]";  // after a name, a call or another index, a bracket is an index
    const char before = open == 0 ? ' ' : text[open - 1];
    if (std::isalnum(static_cast<unsigned char>(before)) != 0 || indexed.find(before) != std::string_view::npos)
        return {};
    const auto letters_end =
        std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(open) + 1, text.end(), is_upper);
    const auto end = std::find_if_not(letters_end, text.end(), is_digit);
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(open) + 1;
    if (letters_end - begin < 2 || end == text.end() || (*end != ',' && *end != ']')) return {};
    const bool is_link = *end == ']' && end + 1 != text.end() && *(end + 1) == '(';
    return is_link ? std::string() : std::string(begin, end);
}

Names cited_keys(std::string_view text) {
    Names keys;
    for (std::size_t open = text.find('['); open != std::string_view::npos; open = text.find('[', open + 1)) {
        if (std::string key = key_at(text, open); !key.empty()) keys.insert(std::move(key));
    }
    return keys;
}

/// The keys that the list of references defines, and those of them under its heading "Further reading".
struct Definitions {
    Names all;
    Names further_reading;
};

Definitions definitions(std::string_view references) {
    constexpr std::string_view entry = "**[";
    Definitions found;
    bool further = false;
    for (const std::string_view line : split_lines(references)) {
        if (line.starts_with("#")) further = line.find("Further reading") != std::string_view::npos;
        if (!line.starts_with(entry)) continue;
        const std::string key = key_at(line, entry.size() - 1);
        found.all.insert(key);
        if (further) found.further_reading.insert(key);
    }
    return found;
}

Names missing_from(const Names& known, const Names& names) {
    Names missing;
    std::ranges::set_difference(names, known, std::inserter(missing, missing.end()));
    return missing;
}

Names undefined_keys(std::string_view references, const std::vector<SourceFile>& files) {
    Names undefined;
    for (const SourceFile& file : files) {
        for (const std::string& key : missing_from(definitions(references).all, cited_keys(file.text))) {
            undefined.insert(file.path + ": " + key);
        }
    }
    return undefined;
}

Names unused_keys(std::string_view references, const std::vector<SourceFile>& files) {
    const Definitions defined = definitions(references);
    Names used = defined.further_reading;
    for (const SourceFile& file : files) used.merge(cited_keys(file.text));
    return missing_from(used, defined.all);
}

/// The files of the project's folders that `text` names in backticks.
Names named_files(std::string_view text) {
    Names named;
    const std::vector<std::string> folders = source_folders();
    const std::vector<std::string_view> parts = split(text, '`');
    for (std::size_t i = 1; i < parts.size(); i += 2) {
        const std::string_view folder = parts[i].substr(0, parts[i].find('/'));
        const bool is_ours = folder == "tests" || std::ranges::find(folders, folder) != folders.end();
        if (is_ours && parts[i].size() > folder.size()) named.insert(std::string(parts[i]));
    }
    return named;
}

const std::string references_path = "model/REFERENCES.md";

/// Sources, tables and documents, these without code, where a bracket is an optional argument.
std::vector<SourceFile> citing_files() {
    std::vector<std::string> folders = source_folders();
    folders.emplace_back("tests");
    std::vector<SourceFile> files = source_files(folders, {".cpp", ".hpp", ".csv"});
    for (const SourceFile& document : documents()) {
        files.push_back({.path = document.path, .text = without_code(document.text)});
    }
    return files;
}

/// A citation for the tests of the tests, so that this file cites nothing itself.
std::string cite(const std::string& inside) {
    return "[" + inside + "]";
}

TEST(Citations, EveryKeyIsDefined) {
    const std::vector<SourceFile> files = citing_files();
    ASSERT_FALSE(files.empty());
    EXPECT_EQ(undefined_keys(source_text(references_path), files), Names());
}

TEST(Citations, EveryDefinitionIsUsedOrFurtherReading) {
    std::vector<SourceFile> files = citing_files();
    std::erase_if(files, [](const SourceFile& file) { return file.path == references_path; });
    EXPECT_EQ(unused_keys(source_text(references_path), files), Names());
}

TEST(Citations, EveryFileNamedByTheReferencesExists) {
    Names absent;
    for (const std::string& path : named_files(source_text(references_path))) {
        if (!source_exists(path)) absent.insert(path);
    }
    EXPECT_EQ(absent, Names());
}

TEST(Citations, AnUndefinedKeyIsFoundWhereItIsCited) {
    const std::string references = "**" + cite("AB01") + "** title";
    const std::vector<SourceFile> files = {{.path = "a.cpp", .text = "// " + cite("AB01, Eq. 3")},
                                           {.path = "b.csv", .text = "# source: " + cite("NOWHERE99")}};
    EXPECT_EQ(undefined_keys(references, files), Names{"b.csv: NOWHERE99"});
}

TEST(Citations, AnUnusedDefinitionIsFoundUnlessItIsFurtherReading) {
    const std::string references = "**" + cite("AB01") + "** title\n**" + cite("CD02") + "** title\n" +
                                   "## Further reading\n**" + cite("EF03") + "** title\n";
    EXPECT_EQ(unused_keys(references, {{.path = "a.cpp", .text = cite("AB01")}}), Names{"CD02"});
}

TEST(Citations, AKeyIsNoIndexNoAttributeAndNoLink) {
    EXPECT_EQ(cited_keys("values" + cite("SIZE") + " f()" + cite("SIZE") + " a_" + cite("SIZE")), Names());
    EXPECT_EQ(cited_keys("[" + cite("nodiscard") + "] " + cite("N") + " " + cite("Eq. 3")), Names());
    EXPECT_EQ(cited_keys(cite("README") + "(README.md)"), Names());
    EXPECT_EQ(cited_keys(cite("AB01, Table 1") + " (" + cite("CD") + ")\n" + cite("EF02") + " (1998)"),
              (Names{"AB01", "CD", "EF02"}));
}

TEST(Citations, AFileNamedInBackticksIsFound) {
    EXPECT_EQ(named_files("in `model/nowhere.cpp` and `printed`, not model/bare.cpp"), Names{"model/nowhere.cpp"});
}

}  // namespace
}  // namespace skinfit::house
