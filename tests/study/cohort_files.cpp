#include <gtest/gtest.h>

#include <map>

#include "core/file.hpp"
#include "core/text.hpp"
#include "fit/configuration_json.hpp"
#include "fit/prior_json.hpp"
#include "fit/problem.hpp"
#include "measurements/spectrum_file.hpp"
#include "study/cohort_folder.hpp"
#include "study/manifest.hpp"
#include "study/planned_study.hpp"
#include "tests/study/small_cohort.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit::test {
namespace {

class CohortFiles : public TemporaryFolder {
protected:
    /// Simulates `json` into the folder of the test.
    SimulatedCohort write(const Json& json) const {
        const Cohort cohort = cohort_of(json);
        SimulatedCohort simulated = simulate(cohort, without_cache());
        write_cohort(cohort, simulated, in_folder(""));
        return simulated;
    }
    [[nodiscard]] std::string text(const std::string& name) const { return read_file(in_folder(name)); }
    [[nodiscard]] Json json(const std::string& name) const { return parsed_json(text(name), name, ""); }

    /// What keeps the folder from being written; empty where nothing does.
    [[nodiscard]] std::string refusal(const std::filesystem::path& source) const {
        return refusal_of([&] { (void)holds_earlier_cohort(in_folder(""), source); });
    }
};

/// The lines of the manifest, each by column.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& manifest) {
    const std::vector<std::string_view> lines = split_lines(manifest);
    const std::vector<std::string_view> columns = split(lines.front(), ',');
    std::vector<std::map<std::string, std::string>> rows;
    for (std::size_t k = 1; k < lines.size(); ++k) {
        const std::vector<std::string_view> cells = split(lines[k], ',');
        EXPECT_EQ(cells.size(), columns.size()) << lines[k];
        auto& row = rows.emplace_back();
        for (std::size_t i = 0; i < columns.size(); ++i) row[std::string(columns[i])] = cells[i];
    }
    return rows;
}

Json with_repeats() {
    Json json = small_cohort();
    json["repeats"] = 2;
    json["model"] = {{"incidence_deg", 45}, {"specular", "excluded"}, {"bandpass_width_nm", 8}};
    return json;
}

TEST_F(CohortFiles, SpectraReadBackToTheLastBitUnderTheNamesOfTheManifest) {
    const SimulatedCohort simulated = write(with_repeats());
    const SpectrumFile file = read_spectra(in_folder("spectra.csv"));
    EXPECT_EQ(file.format, "rows");
    const auto rows = rows_of(text("manifest.csv"));
    ASSERT_EQ(file.spectra.size(), 14U);
    ASSERT_EQ(rows.size(), 14U);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const Spectrum& spectrum = file.spectra[k];
        EXPECT_EQ(rows[k].at("file"), "spectra.csv");
        EXPECT_EQ(rows[k].at("spectrum"), spectrum.name);
        EXPECT_EQ(rows[k].at("repeat"), std::to_string(k % 2 + 1));
        EXPECT_EQ(spectrum.name, rows[k].at("subject") + "_" + rows[k].at("repeat"));
        EXPECT_EQ(spectrum.wavelength_nm, simulated.wavelength_nm);
        EXPECT_EQ(spectrum.value, simulated.subjects[k / 2].reading[k % 2]);
        EXPECT_EQ(spectrum.geometry.incidence_deg, 45);
        EXPECT_EQ(spectrum.geometry.specular, Specular::excluded);
        EXPECT_EQ(spectrum.quantity, Quantity::reflectance);
        ASSERT_TRUE(spectrum.bandpass.has_value());
        EXPECT_EQ(spectrum.bandpass->width_nm, 8);
    }
}

TEST_F(CohortFiles, TheManifestTellsTheTruthAndLabelsFollowTheirRules) {
    const SimulatedCohort simulated = write(small_cohort());
    const auto rows = rows_of(text("manifest.csv"));
    EXPECT_TRUE(text("manifest.csv")
                    .starts_with("file,spectrum,subject,repeat,group,skin_type,age,site,jaundiced,pale,"
                                 "true_melanosome_fraction,true_oxygen_saturation,true_hemoglobin_g_per_l,"
                                 "true_bilirubin_g_per_l\n"));
    for (std::size_t k = 0; k < rows.size(); ++k) {
        for (const Parameter parameter : {Parameter::melanosome_fraction, Parameter::bilirubin_g_per_l}) {
            const std::optional<double> truth = parse_number(rows[k].at("true_" + std::string(info(parameter).name)));
            EXPECT_EQ(truth, value_of(simulated.subjects[k].values, parameter));
        }
        EXPECT_EQ(rows[k].at("jaundiced"), *parse_number(rows[k].at("true_bilirubin_g_per_l")) > 0.25 ? "yes" : "no");
        EXPECT_EQ(rows[k].at("pale"), *parse_number(rows[k].at("true_melanosome_fraction")) < 0.05 ? "yes" : "no");
    }
    EXPECT_EQ(rows.front().at("group"), "first");
    EXPECT_EQ(rows.front().at("age"), "30");
    EXPECT_EQ(rows.front().at("site"), "");
    EXPECT_EQ(rows.back().at("subject"), "second one_0003");
    EXPECT_EQ(rows.back().at("site"), "cheek");
    EXPECT_EQ(rows.back().at("age"), "");
    EXPECT_EQ(rows.back().at("jaundiced"), "yes");  // 0.3 g/L in all of them
}

TEST(CohortLabels, ALimitBelongsToNeitherSide) {
    ParameterValues values;
    values.skin.bilirubin_g_per_l = 0.2;
    for (const bool above : {false, true}) {
        const CohortLabel label{.name = "", .parameter = Parameter::bilirubin_g_per_l, .above = above, .limit = 0.2};
        EXPECT_FALSE(label.holds(values));
    }
}

TEST_F(CohortFiles, TheResolvedCohortMakesTheSameFiles) {
    write(with_repeats());
    const Json resolved = json("cohort.json");
    EXPECT_EQ(resolved["model"]["engine"], "solver");
    EXPECT_EQ(resolved["model"]["base"], nullptr);
    std::vector<std::string> before;
    for (const char* name : {"spectra.csv", "manifest.csv", "cohort.json", "study.json"}) before.push_back(text(name));
    write(resolved);
    std::vector<std::string> after;
    for (const char* name : {"spectra.csv", "manifest.csv", "cohort.json", "study.json"}) after.push_back(text(name));
    EXPECT_EQ(after, before);
}

TEST_F(CohortFiles, TheStudyFitsItsSpectra) {
    write(with_repeats());
    const Json study = json("study.json");
    EXPECT_EQ(study["inputs"], Json::parse(R"([{"manifest": "manifest.csv"}])"));
    EXPECT_EQ(study["repeats_of"], "subject");
    EXPECT_EQ(study["group_by"], Json::array({"group"}));
    EXPECT_EQ(study["output"], "results");
    EXPECT_EQ(study["indicators"][0],
              Json::parse(R"({"name": "jaundiced", "parameter": "bilirubin_g_per_l", "above": 0.25,
                              "source": "the cohort's label jaundiced"})"));
    EXPECT_EQ(study["assess"][1], Json::parse(R"({"indicator": "pale", "label": "pale", "positive": "yes"})"));
    EXPECT_EQ(study["assess"].size(), 2U + 4U);
    const Configuration fit = configured(default_configuration(), study["fit"], "fit");
    EXPECT_EQ(fit.engine, Engine::emulator);
    EXPECT_EQ(fit.noise, 0.004);
    EXPECT_NO_THROW((void)make_problem(fit, read_spectra(in_folder("spectra.csv")).spectra.front()));
}

TEST(PlannedFit, HasThePriorsOfASinglePopulation) {
    Json json = small_cohort();
    json["groups"].erase(1);
    json["population"]["total_blood_fraction"] = {{"kind", "log_normal"}, {"median", 0.01}, {"sigma_log", 0.5}};
    json["discrepancy"] = Json::object();
    const Cohort cohort = cohort_of(json);
    const Configuration fit = planned_fit(cohort);
    const Configuration& population = cohort.groups.front().configuration;
    EXPECT_EQ(write_priors(fit), write_priors(population));
    EXPECT_EQ(write_priors(fit).size(), 1U + 4U);  // set, three parameters and the derived quantity
    EXPECT_EQ(fit.free, population.free);
    EXPECT_TRUE(fit.discrepancy.has_value());
    const auto melanosomes = static_cast<std::size_t>(Parameter::melanosome_fraction);
    EXPECT_EQ(fit.bounds[melanosomes].lower, 0.01);
    EXPECT_EQ(fit.bounds[melanosomes].upper, 0.1);
}

TEST(PlannedFit, IsUniformOverAllGroupsWhereTheyDiffer) {
    const Configuration fit = planned_fit(cohort_of(small_cohort()));
    const auto melanosomes = static_cast<std::size_t>(Parameter::melanosome_fraction);
    EXPECT_EQ(fit.bounds[melanosomes].lower, 0.01);
    EXPECT_EQ(fit.bounds[melanosomes].upper, 0.4);
    EXPECT_FALSE(fit.priors[static_cast<std::size_t>(Parameter::bilirubin_g_per_l)].has_value());
    EXPECT_TRUE(fit.priors[static_cast<std::size_t>(Parameter::oxygen_saturation)].has_value());
}

TEST(PlannedFit, IsBySolverWhereNoEmulatorCanBe) {
    Json json = small_cohort();
    json["population"]["fibril_radius_nm"] = {{"kind", "normal"}, {"mean", 25}, {"sigma", 3}};
    EXPECT_EQ(planned_fit(cohort_of(json)).engine, Engine::emulator);
    json["population"]["epidermis_refractive_index"] = {{"kind", "normal"}, {"mean", 1.4}, {"sigma", 0.01}};
    EXPECT_EQ(planned_fit(cohort_of(json)).engine, Engine::solver);
    json = small_cohort();
    json["model"] = {{"viewing_cone_deg", 5}};
    EXPECT_EQ(planned_fit(cohort_of(json)).engine, Engine::solver);
}

TEST(PlannedFit, HoldsWhatEveryGroupHolds) {
    Json json = small_cohort();
    json["population"]["papillary_blood_fraction"] = 0.03;
    const Configuration fit = planned_fit(cohort_of(json));
    EXPECT_FALSE(fit.free[static_cast<std::size_t>(Parameter::papillary_blood_fraction)]);
    EXPECT_EQ(fit.values.skin.papillary_blood_fraction, 0.03);
}

TEST_F(CohortFiles, AnEarlierCohortIsReplacedAndNothingElseIs) {
    EXPECT_FALSE(holds_earlier_cohort(in_folder(""), "cohort.json"));
    write(small_cohort());
    EXPECT_TRUE(holds_earlier_cohort(in_folder(""), "cohort.json"));
    EXPECT_NE(refusal(in_folder("cohort.json")).find("is the cohort that is read"), std::string::npos);
    write_file_atomically(in_folder("notes.txt"), "mine");
    EXPECT_NE(refusal("cohort.json").find("holds notes.txt"), std::string::npos);
    std::filesystem::remove(in_folder("notes.txt"));
    write_file_atomically(in_folder("spectra.csv"), "id,400,500,600\na,0.1,0.2,0.3\n");
    EXPECT_NE(refusal("cohort.json").find("no spectra.csv of an earlier simulation"), std::string::npos);
    std::filesystem::remove(in_folder("spectra.csv"));
    EXPECT_NE(refusal("cohort.json").find("no spectra.csv of an earlier simulation"), std::string::npos);
}

}  // namespace
}  // namespace skinfit::test
