#include <gtest/gtest.h>

#include <set>

#include "core/file.hpp"
#include "tests/study/small_cohort.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit::test {
namespace {

std::string refusal(const Json& json) {
    return refusal_of([&] { (void)cohort_of(json); });
}

/// A change of the small cohort and a part of what is said about it.
struct BadCohort {
    const char* patch;  ///< RFC 7396: a name with null is removed
    const char* message;
};

const std::vector<BadCohort> bad_cohorts = {
    {R"({"nane": 1})", R"(cohort.json: unknown name "nane" (it would have no effect); did you mean "name"?)"},
    {R"({"patients": 3})", "unknown name \"patients\" (it would have no effect); configs/cohort_power.json"},
    {R"({"name": null})", R"(cohort.json: no "name")"},
    {R"({"name": "a,b"})", "cohort.json: name: \"a,b\" cannot be used (it is to be a cell of a table)"},
    {R"({"name": ""})", "cohort.json: name"},
    {R"({"groups": []})", "cohort.json: groups: [] cannot be used (a list of at least one group is needed)"},
    {R"({"noise": 0})", "cohort.json: noise: 0 cannot be used (out of range)"},
    {R"({"noise": "low"})", "cohort.json: noise"},
    {R"({"seed": 1.5})", "cohort.json: seed"},
    {R"({"repeats": 0})", "cohort.json: repeats: 0 cannot be used (out of range)"},
    {R"({"wavelengths": "400:700"})", "cohort.json: wavelengths"},
    {R"({"wavelengths": "450,500"})", "a table of spectra needs at least three"},
    {R"({"wavelengths": "100:700:50"})", "reaches outside the tables"},
    {R"({"discrepancy": {"sigmaa": 1}})", "cohort.json: discrepancy"},
    {R"({"model": []})", "cohort.json: model"},
    {R"({"model": {"noise": 0.1}})", "cohort.json: model.noise: cannot stand here"},
    {R"({"model": {"free": []}})", "cohort.json: model.free: cannot stand here"},
    {R"({"model": {"starts": 3}})", "cohort.json: model.starts: cannot stand here (a simulation has no use for it)"},
    {R"({"model": {"engin": "solver"}})", "did you mean \"engine\"?"},
    {R"({"model": {"engine": "walk"}})", "cohort.json: model.engine: \"walk\" cannot be used"},
    {R"({"model": {"viewing_cone_deg": 5, "engine": "emulator"}})", "viewing_cone_deg: 5 cannot be used"},
    {R"({"population": {"melanosome_fractoin": 0.1}})", "did you mean \"melanosome_fraction\"?"},
    {R"({"population": {"set": "uniform"}})", "cohort.json: population: unknown name \"set\""},
    {R"({"population": {"bilirubin_g_per_l": 31}})", "cohort.json: population: parameters.bilirubin_g_per_l: 31"},
    {R"({"population": {"bilirubin_g_per_l": "much"}})", "cohort.json: population: priors.bilirubin_g_per_l"},
    {R"({"population": {"bilirubin_g_per_l": {"kind": "log_norml"}}})", "did you mean log_normal?"},
    {R"({"population": {"bilirubin_g_per_l": {"meadian": 1}}})",
     R"(unknown name "meadian" (it would have no effect); did you mean "median"?)"},
    {R"({"population": {"bilirubin_g_per_l": {"lower": 2, "upper": 1}}})", "lower bound 2 is not below upper bound 1"},
    {R"({"population": {"bilirubin_g_per_l": {"median": 9, "sigma_log": 0.1}}})", "outside the bounds"},
    {R"({"population": {"total_blood_fraction": 0.1}})", "cohort.json: population: priors.total_blood_fraction"},
    {R"({"population": {"fold_aspect_ratio": {"kind": "uniform"}}})", "fold_aspect_ratio: has no effect"},
    {R"({"labels": {"group": {"parameter": "bilirubin_g_per_l", "above": 1}}})", "a column of that name already"},
    {R"({"labels": {"true_x": {"parameter": "bilirubin_g_per_l", "above": 1}}})", "a column of that name already"},
    {R"({"labels": {"skin_type": {"parameter": "bilirubin_g_per_l", "above": 1}}})", "metadata of that name"},
    {R"({"labels": {"jaundiced": {"below": 1}}})", "one of above and below is needed"},
    {R"({"labels": {"jaundiced": {"above": "high"}}})", "labels.jaundiced.above: \"high\" cannot be used"},
    {R"({"labels": {"jaundiced": {"parameter": "papillary_blood_fraction"}}})", "labels.jaundiced.parameter"},
    {R"({"labels": {"jaundiced": {"parameter": "bilirubin"}}})", "labels.jaundiced.parameter"},
    {R"({"study": {"outputs": 1}})", "cohort.json: study: unknown name \"outputs\""},
    {R"({"study": {"fit": {"noize": 1}}})", "cohort.json: study.fit"},
    {R"({"study": {"indicators": []}})", "cohort.json: study: indicators without \"assess\""},
    {R"({"study": {"group_by": "group"}})", "cohort.json: study.group_by: \"group\" cannot be used (a list is needed)"},
    {R"({"study": {"group_by": ["skintype"]}})", "did you mean skin_type?"},
    {R"({"sources": {"noise": 1}})", "cohort.json: sources.noise"},
};

TEST(CohortReading, BadCohortsAreRefusedByWhatIsWrongWithThem) {
    for (const BadCohort& bad : bad_cohorts) {
        Json json = small_cohort();
        json.merge_patch(Json::parse(bad.patch));
        EXPECT_NE(refusal(json).find(bad.message), std::string::npos) << bad.patch << "\n" << refusal(json);
    }
    EXPECT_EQ(refusal(small_cohort()), "");
}

TEST(CohortReading, BadGroupsAreNamedByTheirNumber) {
    const auto expect = [](const char* patch, const char* message) {
        Json json = small_cohort();
        json["groups"][1].merge_patch(Json::parse(patch));
        const std::string found = refusal(json);
        EXPECT_NE(found.find("cohort.json: groups[1]"), std::string::npos) << found;
        EXPECT_NE(found.find(message), std::string::npos) << found;
    };
    expect(R"({"name": "first"})", "another group has it");
    expect(R"({"name": "a;b"})", "a cell of a table");
    expect(R"({"subjects": 0})", "out of range");
    expect(R"({"subjects": null})", "no \"subjects\"");
    expect(R"({"size": 3})", "unknown name \"size\"");
    expect(R"({"population": {"oxygen": 1}})", "did you mean \"oxygen_saturation\"?");
    expect(R"({"population": {"melanosome_fraction": 0.1, "hemoglobin_g_per_l": 150, "oxygen_saturation": 0.5}})",
           "nothing is drawn");
    expect(R"({"metadata": {"repeat": "x"}})", "a column of that name already");
    expect(R"({"metadata": {"site": "cheek, left"}})", "a cell of a table");
    expect(R"({"metadata": 3})", "is no object");
}

TEST(CohortReading, GroupsReplaceEntriesOfThePopulationWholly) {
    Json json = small_cohort();
    json["groups"][1]["population"]["melanosome_fraction"] = {{"kind", "normal"}, {"mean", 0.2}, {"sigma", 0.1}};
    const Cohort cohort = cohort_of(json);
    const auto place = static_cast<std::size_t>(Parameter::melanosome_fraction);
    EXPECT_EQ(cohort.groups[0].configuration.bounds[place].upper, 0.1);
    EXPECT_FALSE(cohort.groups[0].configuration.priors[place].has_value());
    EXPECT_EQ(cohort.groups[1].configuration.bounds[place].upper, 0.5);
    EXPECT_TRUE(cohort.groups[1].configuration.priors[place].has_value());
    EXPECT_FALSE(cohort.groups[1].configuration.free[static_cast<std::size_t>(Parameter::bilirubin_g_per_l)]);
}

TEST(ShippedCohorts, LoadAndSayWhereEveryNumberComesFrom) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(SKINFIT_SOURCE_DIR "/configs")) {
        const std::string file = entry.path().filename().string();
        if (!file.starts_with("cohort_")) continue;
        const Json json = parsed_json(read_file(entry.path()), file, "");
        const Cohort cohort = read_cohort(json, file);
        names.insert(cohort.name);
        std::vector<std::string> needed = {"wavelengths", "noise"};
        for (const Parameter parameter : varying_parameters(cohort)) needed.emplace_back(info(parameter).name);
        for (const CohortLabel& label : cohort.labels) needed.push_back(label.name);
        for (const std::string& key : needed) {
            ASSERT_TRUE(json["sources"].contains(key)) << file << ": " << key;
            const std::string source = json["sources"][key];
            EXPECT_TRUE(source.find('[') != std::string::npos || source.starts_with("chosen: ")) << file << ": " << key;
        }
        EXPECT_EQ(read_cohort(cohort.resolved, "again").resolved, cohort.resolved) << file;
    }
    EXPECT_EQ(names, (std::set<std::string>{"factorial", "jaundice", "natural", "power", "skin types"}));
}

}  // namespace
}  // namespace skinfit::test
