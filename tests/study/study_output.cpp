#include "study/study_output.hpp"
#include "study/study_csv.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "measurements/cells.hpp"
#include "tests/study/example_ledger.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using test::example_answer;
using test::example_estimate;
using test::example_row;

std::vector<std::vector<std::string>> table_in(const std::string& csv) {
    std::vector<std::vector<std::string>> table;
    CellCutter cutter(',');
    std::string_view rest = csv;
    while (!rest.empty()) {
        table.emplace_back();
        const std::size_t end = rest.find('\n');
        for (const std::string_view cell : cutter.cut(rest.substr(0, end))) table.back().push_back(unescaped(cell));
        rest.remove_prefix(end + 1);
    }
    return table;
}

std::string cell(const std::vector<std::vector<std::string>>& table, std::size_t row, const std::string& column) {
    const auto found = std::ranges::find(table[0], column);
    return found == table[0].end() ? "no such column"
                                   : table[row].at(static_cast<std::size_t>(found - table[0].begin()));
}

Study asking() {
    Study study;
    study.name = "example";
    study.indicators = {{.name = "low",
                         .quantity = "oxygen_saturation",
                         .above = false,
                         .threshold = 0.4,
                         .reference = {},
                         .source = "the example"}};
    return study;
}

std::vector<LedgerRow> rows() {
    LedgerRow first = example_row("one, \"two\"", {{"subject", "s;1"}, {"site", "arm"}},
                                  example_estimate("oxygen_saturation", 0.1 + 0.2, 1.0 / 3.0));
    LedgerRow second = example_row("three", {{"visit", "2"}}, example_estimate("melanosome_fraction", 0.5, 0.1));
    second.studied = example_answer();
    LedgerRow third = second;
    third.studied = {.status = FitStatus::failed, .reason = "a.csv: cannot\nbe read (x); y"};
    return {first, second, third};
}

TEST(StudyCsv, EveryRowHasTheSameColumns) {
    const auto table = table_in(study_csv(asking(), answered(asking(), rows())));
    ASSERT_EQ(table.size(), 4U);
    for (const auto& row : table) EXPECT_EQ(row.size(), table[0].size());
    EXPECT_EQ(std::set(table[0].begin(), table[0].end()).size(), table[0].size());
    const std::vector<std::string> expected = {"source",
                                               "number",
                                               "spectrum",
                                               "status",
                                               "verdict",
                                               "reason",
                                               "subject",
                                               "site",
                                               "visit",
                                               "oxygen_saturation",
                                               "oxygen_saturation_sigma",
                                               "oxygen_saturation_lower_95",
                                               "oxygen_saturation_upper_95",
                                               "oxygen_saturation_status",
                                               "oxygen_saturation_decided_by_prior",
                                               "oxygen_saturation_split_by_model",
                                               "melanosome_fraction"};
    EXPECT_TRUE(std::ranges::equal(expected, std::vector(table[0].begin(), table[0].begin() + 17)));
    EXPECT_EQ(table[0].back(), "seconds");
}

TEST(StudyCsv, HoldsNumbersToTheLastBit) {
    const auto table = table_in(study_csv(asking(), answered(asking(), rows())));
    EXPECT_EQ(cell(table, 1, "spectrum"), "one, \"two\"");
    EXPECT_EQ(cell(table, 1, "subject"), "s;1");
    EXPECT_EQ(std::stod(cell(table, 1, "oxygen_saturation")), 0.1 + 0.2);
    EXPECT_EQ(std::stod(cell(table, 1, "oxygen_saturation_sigma")), 1.0 / 3.0);
    EXPECT_EQ(cell(table, 1, "oxygen_saturation_status"), "free");
    EXPECT_EQ(cell(table, 1, "melanosome_fraction"), "");
    EXPECT_EQ(std::stod(cell(table, 1, "p_low")), answered(asking(), rows())[0].indicators[0].probability.value());
    EXPECT_EQ(std::stod(cell(table, 2, "correlation_oxygen_saturation_melanosome_fraction")), -2.0 / 3.0);
    EXPECT_EQ(cell(table, 1, "correlation_oxygen_saturation_melanosome_fraction"), "");
    EXPECT_EQ(cell(table, 2, "melanosome_fraction_split_by_model"), "yes");
    EXPECT_EQ(std::stod(cell(table, 2, "dermal_hemoglobin_umol_per_l")), 100.0 / 7.0);
    EXPECT_EQ(std::stod(cell(table, 2, "dermal_hemoglobin_umol_per_l_lower_95")), 10.0 / 7.0);
    EXPECT_EQ(std::stod(cell(table, 2, "dermal_hemoglobin_umol_per_l_upper_95")), 1000.0 / 7.0);
    EXPECT_EQ(cell(table, 2, "tissue_bilirubin_mg_per_dl"), "0");
    EXPECT_EQ(cell(table, 2, "tissue_bilirubin_mg_per_dl_lower_95"), "") << "no interval";
    EXPECT_EQ(cell(table, 1, "dermal_hemoglobin_umol_per_l"), "");
    EXPECT_EQ(cell(table, 1, "skin_colour"), "");
    EXPECT_EQ(std::stod(cell(table, 2, "melanin_index")), 100.0 / 3.0);
    EXPECT_EQ(std::stod(cell(table, 2, "chi2")), example_answer().chi2.value());
    EXPECT_EQ(cell(table, 2, "p_value"), "");
    EXPECT_EQ(cell(table, 2, "input_hash"), "input");
    EXPECT_EQ(cell(table, 3, "status"), "failed");
    EXPECT_EQ(cell(table, 3, "reason"), R"(a.csv: cannot\nbe read (x); y)");
    EXPECT_EQ(cell(table, 3, "oxygen_saturation"), "");
    EXPECT_EQ(cell(table, 3, "p_low"), "");
}

TEST(StudyCsv, SaysWhatItsPriorDecides) {
    std::vector<LedgerRow> two = {rows()[0], rows()[0]};
    two[1].studied.parameters[0].decided_by_prior = true;
    const auto table = table_in(study_csv(asking(), answered(asking(), two)));
    EXPECT_EQ(cell(table, 1, "oxygen_saturation_decided_by_prior"), "no");
    EXPECT_EQ(cell(table, 2, "oxygen_saturation_decided_by_prior"), "yes");
    EXPECT_EQ(cell(table, 1, "p_low_decided_by_prior"), "no");
    EXPECT_EQ(cell(table, 2, "p_low_decided_by_prior"), "yes");
}

/// Of the pairs of three parameters of which another spectrum has two, in another order of columns.
TEST(StudyCsv, CorrelationsBelongToTheirPairs) {
    std::vector<LedgerRow> two = {rows()[0], rows()[0]};
    two[0].studied.parameters = {example_estimate("a", 0.5, 0.1), example_estimate("b", 0.5, 0.1),
                                 example_estimate("c", 0.5, 0.1)};
    two[0].studied.correlation = {0.21, 0.31, 0.32};
    two[1].studied.parameters = {example_estimate("a", 0.5, 0.1), example_estimate("c", 0.5, 0.1)};
    two[1].studied.correlation = {-0.31};
    const auto table = table_in(study_csv(Study(), answered(Study(), two)));
    EXPECT_EQ(cell(table, 1, "correlation_b_a"), "0.21");
    EXPECT_EQ(cell(table, 1, "correlation_c_a"), "0.31");
    EXPECT_EQ(cell(table, 1, "correlation_c_b"), "0.32");
    EXPECT_EQ(cell(table, 2, "correlation_b_a"), "");
    EXPECT_EQ(cell(table, 2, "correlation_c_a"), "-0.31");
    EXPECT_EQ(cell(table, 2, "correlation_c_b"), "");
}

TEST(StudyCsv, MetadataDoNotHideOtherColumns) {
    std::vector<LedgerRow> one = {rows()[0]};
    one[0].metadata = {{"status", "married"}, {"oxygen_saturation", "0.97"}, {"p_low", "x"}, {"age", "3"}};
    const auto table = table_in(study_csv(asking(), answered(asking(), one)));
    EXPECT_EQ(std::set(table[0].begin(), table[0].end()).size(), table[0].size());
    EXPECT_EQ(cell(table, 1, "metadata_status"), "married");
    EXPECT_EQ(cell(table, 1, "status"), "fitted");
    EXPECT_EQ(cell(table, 1, "metadata_oxygen_saturation"), "0.97");
    EXPECT_EQ(cell(table, 1, "metadata_p_low"), "x");
    EXPECT_EQ(cell(table, 1, "age"), "3");
}

TEST(StudyCsv, NamesTheMostProbableColour) {
    std::vector<LedgerRow> dark = {rows()[0]};
    dark[0].studied.indices = {{.name = "individual_typology_angle_deg", .value = -30.0, .sigma = 5.0},
                               {.name = "melanin_index", .value = 60.0, .sigma = 1.0}};
    const auto table = table_in(study_csv(asking(), answered(asking(), dark)));
    EXPECT_EQ(cell(table, 1, "skin_colour"), "brown");
    EXPECT_NEAR(std::stod(cell(table, 1, "p_skin_colour")), 0.5, 1.0 / 200);  // one slice of the distribution
}

TEST(StudyCsv, OfNoSpectrumIsAHeader) {
    EXPECT_EQ(table_in(study_csv(asking(), {})).size(), 1U);
}

TEST(StudyStatus, SaysHowManyOfEachKindThereAre) {
    StudyCounts counts;
    counts.spectra = {1, 2, 3, 4, 5, 0};
    EXPECT_EQ(status_text(counts), "15 spectra: 1 pending, 2 fitted, 3 suspect, 4 rejected, 5 failed\n");
    counts.spectra = {0, 1, 0, 0, 0, 0};
    counts.cubes = 1;
    counts.tiles = 8;
    counts.tiles_done = 3;
    counts.pixels = {0, 90, 0, 0, 0, 10};
    counts.unread_cubes = {{"foot.hdr", "no bands"}};
    EXPECT_EQ(status_text(counts),
              "1 spectrum: 0 pending, 1 fitted, 0 suspect, 0 rejected, 0 failed\n"
              "1 cube, 0 with a map; 3 of 8 tiles done; pixels of these: 0 pending, 90 fitted, 0 suspect, 0 rejected, "
              "0 failed, 10 masked\n"
              "foot.hdr: FAILED: no bands\n");
    const Json json = status_json(counts);
    EXPECT_EQ(json["fitted"], 1);
    EXPECT_EQ(json["pixels"]["masked"], 10);
    EXPECT_EQ(json["cubes"], 1);
    EXPECT_EQ(json["tiles"]["pending"], 5);
}

class StudyJson : public test::TemporaryFolder {};

TEST_F(StudyJson, HoldsAnswersAndDefinitions) {
    Ledger ledger(in_folder("ledger.sqlite"), Ledger::Access::write);
    (void)ledger.take(test::example_roster(2), "settings");
    ledger.store(test::example_answers(test::example_roster(1)));
    ledger.set_note(
        "configuration",
        R"({"edition": "revised", "engine": "emulator", "uncertainty": "covariance", "noise": 0.004, "seed": 1})");
    ledger.set_note("version", "1.2.3");
    const Json json = results_json(asking(), ledger, answered(asking(), ledger.rows()));
    EXPECT_EQ(json["study"], "example");
    EXPECT_EQ(json["version"], "1.2.3");
    EXPECT_EQ(json["configuration"]["noise"], 0.004);
    EXPECT_EQ(json["counts"]["pending"], 1);
    EXPECT_EQ(json["indicators"][0]["below"], 0.4);
    EXPECT_EQ(json["indicators"][0]["source"], "the example");
    EXPECT_EQ(json["indices"].size(), index_table().size());
    ASSERT_EQ(json["spectra"].size(), 2U);
    const Json& first = json["spectra"][0];
    EXPECT_EQ(to_json(studied_from_json(first)).dump(), to_json(example_answer()).dump());
    EXPECT_EQ(first["metadata"]["subject"], "s1");
    EXPECT_TRUE(first["indicators"]["low"].contains("probability"));
    EXPECT_EQ(json["spectra"][1]["indicators"]["low"]["none"], "pending");
}

}  // namespace
}  // namespace skinfit
