#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <regex>

#include "core/json.hpp"
#include "core/text.hpp"
#include "fit/description.hpp"
#include "tests/cli/cli_test.hpp"
#include "tests/support/known_names.hpp"

namespace skinfit::test {
namespace {

using Arguments = std::vector<std::string>;
/// The keys of `json`, at any depth, but those that users choose.
void add_keys(const Json& json, Names& names) {
    if (!json.is_structured()) return;
    for (const auto& [key, value] : json.items()) {
        if (json.is_object()) names.insert(key);
        if (key != "metadata") add_keys(value, names);
    }
}

/// The columns of a table with comments above.
Names columns_of(const std::string& csv) {
    for (const std::string_view line : split_lines(csv)) {
        if (line.starts_with('#')) continue;
        const std::vector<std::string_view> columns = split(line, ',');
        return {columns.begin(), columns.end()};
    }
    return {};
}

Names unknown_among(const Names& names) {
    Names unknown;
    const Names known = known_names();
    std::ranges::set_difference(names, known, std::inserter(unknown, unknown.end()));
    return unknown;
}

class VocabularyRuns : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        const Outcome made = run({"simulate", "--set", "engine=solver", "--wavelengths", "450:650:10"});
        ASSERT_EQ(made.exit_code, 0) << made.err;
        put("all.csv", made.out);
        const Outcome one = run({"convert", "all.csv", "--column", "reflectance"});
        ASSERT_EQ(one.exit_code, 0) << one.err;
        put("made.csv", one.out);
    }

    [[nodiscard]] std::string output_of(Arguments arguments, const std::string& format) const {
        arguments.insert(arguments.end(), {"--format", format});
        const Outcome outcome = run(arguments);
        EXPECT_THAT(outcome.exit_code, testing::AnyOf(0, 1)) << outcome.err;
        return outcome.out;
    }
};

TEST_F(VocabularyRuns, EveryKeyOfJsonIsAWordOfIt) {
    for (const Arguments& arguments :
         {Arguments{"fit", "made.csv", "--set", "engine=solver", "--cross-check", "--uncertainty", "profile"},
          Arguments{"fit", "made.csv", "--set", "engine=emulator", "--uncertainty", "posterior"},
          Arguments{"inspect", "made.csv"}, Arguments{"simulate", "--set", "engine=solver"},
          Arguments{"sensitivity", "--set", "engine=solver"}, Arguments{"convert", "made.csv"},
          Arguments{"design", "bilirubin_g_per_l", "--set", "engine=solver"},
          Arguments{"gonio", "--wavelengths", "550", "--set", "rays=1000"},
          Arguments{"gonio", "--reciprocity", "--wavelengths", "550", "--set", "rays=1000"}}) {
        Names names;
        add_keys(Json::parse(output_of(arguments, "json")), names);
        EXPECT_FALSE(names.empty());
        EXPECT_THAT(unknown_among(names), testing::IsEmpty()) << testing::PrintToString(arguments);
    }
}

TEST_F(VocabularyRuns, EveryColumnIsAWordOfIt) {
    for (const Arguments& arguments :
         {Arguments{"simulate", "--set", "engine=solver"}, Arguments{"sensitivity", "--set", "engine=solver"},
          Arguments{"gonio", "--wavelengths", "550", "--set", "rays=1000"},
          Arguments{"gonio", "--reciprocity", "--wavelengths", "550", "--set", "rays=1000"}}) {
        const Names names = columns_of(output_of(arguments, "csv"));
        EXPECT_GT(names.size(), 1U);
        EXPECT_THAT(unknown_among(names), testing::IsEmpty()) << testing::PrintToString(arguments);
    }
}

TEST_F(VocabularyRuns, DescribeSaysWhatAnyOfThemMeans) {
    for (const std::string name : {"bilirubin_g_per_l", "engine", "slow_residuals_p_value"}) {
        const Outcome outcome = run({"describe", name});
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_THAT(outcome.out, testing::StartsWith(name + ": ")) << outcome.err;
    }
    EXPECT_EQ(run({"describe", "SUSPECT"}).out, run({"describe", "suspect"}).out);
    const Outcome all = run({"describe"});
    EXPECT_THAT(all.out, testing::AllOf(testing::HasSubstr("bilirubin_g_per_l"), testing::HasSubstr("engine")));
    EXPECT_THAT(run({"describe", "bilirubin_g"}).err, testing::HasSubstr("did you mean \"bilirubin_g_per_l\"?"));
    EXPECT_THAT(run({"describe", "biliruben_g_per_l"}).err, testing::HasSubstr("did you mean \"bilirubin_g_per_l\"?"));
    EXPECT_THAT(run({"describe", "xyzzy"}).err, testing::Not(testing::HasSubstr("did you mean")));
}

TEST_F(VocabularyRuns, DescribeKnowsEverydayWordsAndTheWordsOfTheVerdict) {
    const Outcome melanin = run({"describe", "melanin"});
    EXPECT_EQ(melanin.exit_code, 0);
    EXPECT_THAT(melanin.out, testing::HasSubstr("melanosome_fraction: parameter"));
    const Outcome blood = run({"describe", "blood"});
    EXPECT_THAT(blood.out, testing::AllOf(testing::HasSubstr("papillary_blood_fraction: parameter"),
                                          testing::HasSubstr("reticular_blood_fraction: parameter")));
    for (const Arguments& words :
         {Arguments{"RESIDUALS", "IN", "RUNS"}, Arguments{"RESIDUALS IN RUNS"}, Arguments{"AT BOUND"}, Arguments{"ITA"},
          Arguments{"degrees of freedom"}, Arguments{"degrees", "of", "freedom"}, Arguments{"95 % interval"}}) {
        Arguments arguments = {"describe"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(std::ranges::count(outcome.out, '\n'), 2) << outcome.out;
    }
}

/// What `line` of a report labels: what stands before its first colon.
std::optional<std::string> label_in(const std::string& line) {
    const std::size_t colon = line.find(": ");
    const std::size_t begin = line.find_first_not_of(" -");
    if (colon == std::string::npos || begin > colon) return std::nullopt;
    std::string label = line.substr(begin, colon - begin);
    if (label.starts_with("note ")) label.erase(0, 5);  // of a finding
    const bool is_head_of_table = label.find("  ") != std::string::npos;
    if (is_head_of_table || label.find_first_of("(,;=") != std::string::npos) return std::nullopt;
    return label;
}

TEST_F(VocabularyRuns, DescribeKnowsTheLabelsOfReports) {
    const Arguments fit = {"fit",           "made.csv",  "--set",    "engine=emulator", "--set",  "discrepancy={}",
                           "--uncertainty", "posterior", "--report", "fit.html",        "--quiet"};
    const Outcome outcome = run(fit);
    ASSERT_LE(outcome.exit_code, 1) << outcome.err;
    std::size_t labels = 0;
    for (const std::string_view line : split_lines(outcome.out)) {
        const std::optional<std::string> label = label_in(std::string(line));
        if (!label) continue;
        ++labels;
        EXPECT_TRUE(description_of(*label)) << *label;
    }
    EXPECT_GT(labels, 12U);
    const std::string page = read_file(folder() / "fit.html");
    static const std::regex heading(R"re(<(?:th scope="col"|dt)[^>]*>([^<]+)</)re");
    std::size_t headings = 0;
    for (std::sregex_iterator each(page.begin(), page.end(), heading), end; each != end; ++each) {
        const std::string text = (*each)[1];
        if (text.starts_with('[')) continue;  // a reference
        if (parse_number(text)) continue;     // the number of a row, above the column of its correlations
        ++headings;
        EXPECT_TRUE(description_of(text)) << text;
    }
    EXPECT_GT(headings, 20U);
}

}  // namespace
}  // namespace skinfit::test
