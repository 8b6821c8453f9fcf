#include "core/json.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

using Arguments = std::vector<std::string>;
class ValidationRuns : public CliTest {
protected:
    [[nodiscard]] bool exists(const std::string& name) const { return std::filesystem::exists(folder() / name); }
};

TEST_F(ValidationRuns, AFigureIsATableTwoPicturesAndVerdictsInAnyFolder) {
    const Outcome outcome = run({"validate", "forward", "--figures", "5", "--output", "new/folder"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("Figure 5"), std::string::npos);
    for (const std::string name : {"figure_5.csv", "figure_5.svg", "figure_5.png", "summary.json"}) {
        EXPECT_TRUE(exists("new/folder/" + name)) << name;
    }
    EXPECT_FALSE(exists("new/folder/figure_3.csv"));
    EXPECT_TRUE(read_file(folder() / "new/folder/figure_5.png").starts_with("\x89PNG"));
    EXPECT_NE(read_file(folder() / "new/folder/figure_5.svg").find("</svg>"), std::string::npos);
}

TEST_F(ValidationRuns, JsonIsTheSummaryAndEveryClaimHasItsVariants) {
    const Outcome outcome = run({"validate", "forward", "--figures", "9,8", "--format", "json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, read_file(folder() / "forward_validation/summary.json"));
    const Json json = Json::parse(outcome.out);
    ASSERT_EQ(json["figures"].size(), 2U);
    EXPECT_EQ(json["figures"][0]["figure"], 9);
    const Json& claims = json["figures"][0]["claims"];
    ASSERT_EQ(claims.size(), 4U);
    for (const Json& claim : claims) {
        EXPECT_EQ(claim["claim"], "yellower_in_order");
        EXPECT_TRUE(claim["verdict"] == "reproduced" || claim["verdict"] == "not reproduced");
        EXPECT_TRUE(claim["number"].is_number());
        EXPECT_NE(claim["why"], "");
    }
}

TEST_F(ValidationRuns, AnAbsentMeasurementIsNotedOnStderr) {
    const Outcome outcome = run({"validate", "forward", "--figures", "10", "--shared", "nowhere"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(
        outcome.err.find("note: figure 10: no comparison with shared/spectra/eyelid_transmittance_bierman_2011.txt, "
                         "which is not shipped and not in nowhere; --shared names its folder"),
        std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.out.find("skipped"), std::string::npos);
}

TEST_F(ValidationRuns, ARecoveryStudyIsATableTwoPicturesAndASummary) {
    const Outcome outcome =
        run({"validate", "inverse", "--spectra", "3", "--simulate-by", "emulator", "--intervals", "profile", "--fix",
             "papillary_blood_fraction,bilirubin_g_per_l", "--format", "json", "--output", "study"});
    EXPECT_LE(outcome.exit_code, 1) << outcome.err;
    for (const std::string name : {"recovery.csv", "recovery.svg", "recovery.png", "summary.json"}) {
        EXPECT_TRUE(exists("study/" + name)) << name;
    }
    EXPECT_EQ(outcome.out, read_file(folder() / "study/summary.json"));
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json["spectra"], 3);
    EXPECT_EQ(json["parameters"].size(), 3U);
    EXPECT_EQ(json["passes"], outcome.exit_code == 0);
    EXPECT_TRUE(json["parameters"]["oxygen_saturation"]["coverage"].contains("profile"));
    EXPECT_FALSE(json["parameters"]["oxygen_saturation"]["coverage"].contains("posterior"));
}

TEST_F(ValidationRuns, ARecoveryStudyRefusesBadOptions) {
    expect_refusal({"validate", "inverse", "--intervals", "profiles"}, "--intervals profiles");
    expect_refusal({"validate", "inverse", "--spectra", "0"}, "--spectra");
    expect_refusal({"validate", "inverse", "--simulate-by", "hand"}, "--simulate-by");
    expect_refusal({"validate", "inverse", "--set", "discrepancy={}"}, "discrepancy: no recovery study with one");
}

TEST_F(ValidationRuns, BadOptionsAreRefusedBeforeTheWork) {
    expect_refusal({"validate", "forward", "--figures", "5,1"}, "no figure \"1\" (there are figures 2 to 10)");
    expect_refusal({"validate", "forward", "--figures", "five"}, "no figure \"five\"");
    expect_refusal({"validate", "forward", "--rays", "-1"}, "--rays");
    expect_refusal({"validate", "forward", "--figure", "5"}, "did you mean --figures?");
    put("file", "");
    expect_refusal({"validate", "forward", "--output", "file"}, "--output file: no folder that can be written");
    EXPECT_FALSE(exists("forward_validation"));
}

}  // namespace
}  // namespace skinfit::test
