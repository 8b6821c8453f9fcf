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

TEST_F(ValidationRuns, AStudyByTransportSaysThatItDoesNotKnowTheModelAndARecoveryStudyThatItDoes) {
    put("cohort.json", R"({
        "name": "few", "wavelengths": "500:650:25",
        "transport": {"photons": 1000},
        "population": {"oxygen_saturation": {"kind": "uniform", "lower": 0.3, "upper": 0.9},
                       "dermal_bilirubin_g_per_l": 0},
        "groups": [{"name": "a", "subjects": 6}]
    })");
    const Arguments fixed = {"--fix", "fibril_radius_nm,lateral_loss_per_cm,melanin_slope"};
    Arguments words = {"validate", "inverse",     "--simulate-by", "transport",
                       "--cohort", "cohort.json", "--spectra",     "5"};
    words.insert(words.end(), fixed.begin(), fixed.end());
    const Outcome text = run(words);
    EXPECT_LE(text.exit_code, 1) << text.err;
    EXPECT_TRUE(text.out.starts_with(text.exit_code == 0 ? "verdict: passes\n5 spectra" : "verdict: FAILS\n5 spectra"))
        << text.out;
    EXPECT_NE(text.out.find("The fits do not know what made the spectra"), std::string::npos) << text.out;
    words.insert(words.end(), {"--format", "json", "--port-diameter-mm", "5", "--output", "port"});
    const Outcome port = run(words);
    EXPECT_EQ(port.out, read_file(folder() / "port/summary.json"));
    EXPECT_TRUE(exists("port/transport.csv"));
    const Json json = Json::parse(port.out);
    EXPECT_EQ(json["knows_model"], false);
    EXPECT_EQ(json["simulation"]["transport"]["port_diameter_mm"], 5.0);
    EXPECT_NE(read_file(folder() / "port/transport.csv"), read_file(folder() / "inverse_validation/transport.csv"));
    words.back() = "one";
    words.insert(words.end(), {"--threads", "1"});
    EXPECT_EQ(run(words).out, port.out);
    EXPECT_EQ(read_file(folder() / "one/transport.csv"), read_file(folder() / "port/transport.csv"));

    const Outcome known =
        run({"validate", "inverse", "--spectra", "1", "--simulate-by", "emulator", "--intervals", "covariance", "--fix",
             "papillary_blood_fraction,bilirubin_g_per_l", "--output", "known"});
    EXPECT_NE(known.out.find("The fits know what made the spectra"), std::string::npos) << known.out << known.err;
    EXPECT_EQ(Json::parse(read_file(folder() / "known/summary.json"))["knows_model"], true);
}

TEST_F(ValidationRuns, AStudyByTransportRefusesBadOptions) {
    expect_refusal({"validate", "inverse", "--cohort", "natural"}, "--cohort: cannot be used here");
    expect_refusal({"validate", "inverse", "--port-diameter-mm", "5"}, "--port-diameter-mm: cannot be used here");
    const auto by_transport = [](Arguments more) {
        Arguments words = {"validate", "inverse", "--simulate-by", "transport"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    expect_refusal(by_transport({"--intervals", "profile"}), "--intervals: cannot be used here");
    expect_refusal(by_transport({"--cohort", "natrual"}), "natrual");
    expect_refusal(by_transport({"--port-diameter-mm", "-1"}), "--port-diameter-mm: -1");
    expect_refusal(by_transport({"--set", "viewing_cone_deg=25"}), "viewing_cone_deg");
    put("model.json", R"({"name": "m", "population": {"oxygen_saturation": {"kind": "uniform"}},
                          "groups": [{"name": "a", "subjects": 2}]})");
    expect_refusal(by_transport({"--cohort", "model.json"}), "model.json: is no cohort by transport");
    EXPECT_FALSE(exists("inverse_validation"));
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
