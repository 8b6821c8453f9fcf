#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "core/file.hpp"
#include "core/nearest_names.hpp"
#include "core/text.hpp"
#include "core/vocabulary.hpp"
#include "fit/description.hpp"
#include "fit/settings.hpp"
#include "measurements/quality_checks.hpp"
#include "model/parameters.hpp"
#include "study/fit_status.hpp"
#include "study/pixel_fitter.hpp"
#include "tests/house/source_tree.hpp"
#include "tests/support/known_names.hpp"

namespace skinfit::house {
namespace {

using test::known_names;
using test::Names;

/// Files whose words are no keys of ours: of HTML, of shells, of other people's spectra, names of tables, and columns
/// of a recipe's data.
bool speaks_for_itself(const std::string& path) {
    return path.starts_with("report/html") || path.starts_with("calibration/") || path.starts_with("app/completion") ||
           path == "app/command_completion.cpp" || path == "report/uncertainty_section.cpp" ||
           path == "report/fit_report.cpp" || path == "model/chromophores.cpp" ||
           (path.starts_with("measurements/") && !path.ends_with("json.cpp"));
}

/// What `text` writes as a key of JSON, `{"key", ...}` and `["key"]`, or as a line of columns, `"first,second"`.
Names written_names(const std::string& text) {
    static const std::regex key(R"re((?:\{|\[)"([a-z][a-z0-9_]*)"(?:,|\]))re");
    static const std::regex columns(R"re("([a-z][a-z0-9_]*(?:,[a-z][a-z0-9_]*)+),?(?:\\n)?")re");
    Names names;
    for (std::sregex_iterator each(text.begin(), text.end(), key), end; each != end; ++each) names.insert((*each)[1]);
    for (std::sregex_iterator each(text.begin(), text.end(), columns), end; each != end; ++each) {
        const std::string line = (*each)[1];
        for (const std::string_view name : split(line, ',')) names.emplace(name);
    }
    return names;
}

std::vector<std::string> outside_the_vocabulary(const std::vector<SourceFile>& files) {
    const Names known = known_names();
    std::vector<std::string> unknown;
    for (const SourceFile& file : files) {
        if (speaks_for_itself(file.path)) continue;
        for (const std::string& name : written_names(file.text)) {
            if (!known.contains(name)) unknown.push_back(file.path + ": " + name);
        }
    }
    return unknown;
}

bool is_part_of_a_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Whether `name` stands in one of `texts`, and not as a part of a longer name.
bool stands_in(const std::vector<SourceFile>& files, std::string_view name) {
    return std::ranges::any_of(files, [&](const SourceFile& file) {
        for (std::size_t at = file.text.find(name); at != std::string::npos; at = file.text.find(name, at + 1)) {
            const std::size_t end = at + name.size();
            const bool begins = at == 0 || !is_part_of_a_name(file.text[at - 1]);
            if (begins && (end == file.text.size() || !is_part_of_a_name(file.text[end]))) return true;
        }
        return false;
    });
}

/// The rows of the table of everyday words.
std::vector<std::string> everyday_lines() {
    const std::string text = read_file(SKINFIT_SOURCE_DIR "/core/data/everyday_words.csv");
    std::vector<std::string> rows;
    for (const std::string_view line : split_lines(text)) {
        if (!line.starts_with('#') && line != "word,names") rows.emplace_back(line);
    }
    return rows;
}

std::vector<SourceFile> sources() {
    return source_files(source_folders(), {".cpp", ".hpp"});
}

TEST(Vocabulary, HoldsEveryNameThatTheProgramWrites) {
    EXPECT_THAT(outside_the_vocabulary(sources()), testing::IsEmpty());
}

TEST(Vocabulary, FindsANameThatIsNotInIt) {
    const std::vector<SourceFile> made = {
        {"fit/made.cpp", R"(Json{{"chi_squared", 1}}; json["rmse_error"]; "verdict,chi_2\n")"}};
    EXPECT_THAT(outside_the_vocabulary(made),
                testing::ElementsAre("fit/made.cpp: chi_2", "fit/made.cpp: chi_squared", "fit/made.cpp: rmse_error"));
}

TEST(Vocabulary, HoldsNoWordThatIsNotUsed) {
    const std::vector<SourceFile> files = sources();
    for (const Word& word : vocabulary()) EXPECT_TRUE(stands_in(files, word.name)) << word.name;
    EXPECT_FALSE(stands_in(files, "wavelength_n"));
}

TEST(Vocabulary, HoldsWhatResultsAndFindingsAreCalled) {
    const Names known = known_names();
    std::vector<std::string_view> words = {"consistent"};
    for (const std::string_view word : fit_status_names) words.push_back(word);
    for (const std::string_view word : pixel_reason_names) words.push_back(word);
    for (const std::string_view word : quality_check_names) words.push_back(word);
    for (const std::string_view word : words) {
        EXPECT_TRUE(word == name_of(PixelReason::none) || known.contains(std::string(word))) << word;
    }
}

/// Sources that speak to other programs in capitals: databases, shells, web servers, readers of other people's files.
bool speaks_to_programs(const std::string& path) {
    return path.starts_with("study/ledger") || path == "study/cube_ledger.cpp" || path == "study/one_process.cpp" ||
           path.starts_with("measurements/") || path.starts_with("model/") || path.starts_with("core/") ||
           path.starts_with("app/completion") || path == "app/command_completion.cpp" || path == "app/terminal.cpp" ||
           path == "explore/api.cpp" || path == "explore/guard.cpp" || path == "app/manual.cpp" ||
           path == "report/fit_picture.cpp" || path == "app/command_explore.cpp" || path == "fit/gnuplot.cpp" ||
           path == "report/html_page.cpp";
}

/// The words in capitals within the string literals of `text`, but keys of citations, [KA04], and names of files.
Names capitals(const std::string& text) {
    static const std::regex literal(R"re("((?:[^"\\\n]|\\.)*)")re");
    static const std::regex words(
        R"re((^|[^A-Za-z0-9_\[/-])([A-Z][A-Z0-9]+(?: [A-Z][A-Z0-9]+)*)(?![A-Za-z0-9_./\]]))re");
    Names found;
    for (std::sregex_iterator each(text.begin(), text.end(), literal), end; each != end; ++each) {
        const std::string line = (*each)[1];
        for (std::sregex_iterator word(line.begin(), line.end(), words); word != end; ++word) {
            found.insert((*word)[2]);
        }
    }
    return found;
}

std::vector<std::string> undescribed_capitals(const std::vector<SourceFile>& files) {
    std::vector<std::string> unknown;
    for (const SourceFile& file : files) {
        if (speaks_to_programs(file.path)) continue;
        for (const std::string& word : capitals(file.text)) {
            if (!description_of(word)) unknown.push_back(file.path + ": " + word);
        }
    }
    return unknown;
}

TEST(Vocabulary, DescribesWhateverIsPrintedInCapitals) {
    EXPECT_THAT(undescribed_capitals(sources()), testing::IsEmpty());
    const std::vector<SourceFile> made = {
        {"fit/made.cpp", R"("AT BOUND: {}" "XYZZY in [KA04, Fig. 3], see REFERENCES.md" "PLUGH TOO COARSE")"}};
    EXPECT_THAT(undescribed_capitals(made),
                testing::ElementsAre("fit/made.cpp: PLUGH TOO COARSE", "fit/made.cpp: XYZZY"));
}

TEST(Vocabulary, LabelsAreInOrderAndNoWordsOfIt) {
    const std::span<const Word> all = labels();
    ASSERT_GT(all.size(), 50U);
    EXPECT_TRUE(std::ranges::is_sorted(all, std::ranges::less(), &Word::name));
    const Names known = known_names();
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_FALSE(i > 0 && all[i].name == all[i - 1].name) << all[i].name;
        EXPECT_FALSE(all[i].meaning.empty()) << all[i].name;
        EXPECT_EQ(std::ranges::find(vocabulary(), spelt(all[i].name), &Word::name), vocabulary().end()) << all[i].name;
    }
}

TEST(Vocabulary, EverydayWordsLeadToNamesOfIt) {
    const Names known = known_names();
    for (const std::string word : {"melanin", "blood", "saturation", "StO2", "bilirubin", "haemoglobin", "hemoglobin",
                                   "carotene", "thickness", "perfusion", "oxygenation", "scattering", "angle"}) {
        ASSERT_FALSE(everyday_names(word).empty()) << word;
        for (const std::string_view name : everyday_names(word)) EXPECT_TRUE(known.contains(std::string(name))) << name;
    }
    for (const std::string& line : everyday_lines()) {
        const std::string word = line.substr(0, line.find(','));
        EXPECT_EQ(word, spelt(word));
        EXPECT_FALSE(find_parameter(word).has_value()) << word;
        for (const std::string_view name : everyday_names(word)) {
            EXPECT_TRUE(known.contains(std::string(name))) << word << ": " << name;
        }
    }
}

TEST(Vocabulary, IsInOrderAndDefinesNothingTwice) {
    const std::span<const Word> words = vocabulary();
    ASSERT_GT(words.size(), 250U);
    EXPECT_TRUE(std::ranges::is_sorted(words, std::ranges::less(), &Word::name));
    for (std::size_t i = 0; i < words.size(); ++i) {
        EXPECT_FALSE(i > 0 && words[i].name == words[i - 1].name) << words[i].name;
        EXPECT_FALSE(words[i].meaning.empty()) << words[i].name;
        EXPECT_FALSE(find_parameter(words[i].name).has_value()) << words[i].name << " is a parameter";
        EXPECT_EQ(std::ranges::find(setting_table(), words[i].name, &Setting::name), setting_table().end())
            << words[i].name << " is a setting";
    }
}

TEST(Vocabulary, SaysUnitsInNames) {
    constexpr std::array<std::string_view, 10> units = {"nm",     "mm",      "cm",     "deg",        "s",
                                                        "per_sr", "g_per_l", "per_cm", "umol_per_l", "mg_per_dl"};
    for (const Word& word : vocabulary()) {
        const auto ends_in = [&](std::string_view unit) { return word.name.ends_with("_" + std::string(unit)); };
        EXPECT_TRUE(word.unit.empty() || ends_in(word.unit)) << word.name << " is in " << word.unit;
        const bool names_a_unit = std::ranges::any_of(units, ends_in) && !ends_in("per_s") && !ends_in("per_cpu_s");
        EXPECT_EQ(names_a_unit, !word.unit.empty()) << word.name;
    }
}

}  // namespace
}  // namespace skinfit::house
