#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

using Json = nlohmann::ordered_json;

class UncertaintyRuns : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        const Outcome simulated =
            run({"simulate", "--set", "wavelengths=400:700:50", "--set", "rays=1000", "--out", "skin.csv"});
        ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
    }

    [[nodiscard]] Outcome fit(std::vector<std::string> more) const {
        std::vector<std::string> arguments = {
            "fit",   "skin.csv",  "--column", "reflectance",
            "--set", "rays=1000", "--fix",    "reticular_blood_fraction,oxygen_saturation,bilirubin_g_per_l"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
};

TEST_F(UncertaintyRuns, IntervalsAreOfTheKindAskedFor) {
    for (const std::string kind : {"covariance", "profile", "posterior"}) {
        const Json json = Json::parse(fit({"--uncertainty", kind, "--format", "json"}).out);
        EXPECT_EQ(json["uncertainty"]["intervals"], kind);
        EXPECT_EQ(json["configuration"]["uncertainty"], kind);
        EXPECT_EQ(json["uncertainty"].contains("posterior"), kind == "posterior");
    }
}

TEST_F(UncertaintyRuns, SamplesAreWrittenAndTheSameOnAnyNumberOfThreads) {
    EXPECT_LE(fit({"--uncertainty", "posterior", "--samples", "one.csv", "--threads", "1"}).exit_code, 1);
    EXPECT_LE(fit({"--uncertainty", "posterior", "--samples", "two.csv", "--threads", "2"}).exit_code, 1);
    const std::string text = read_file(folder() / "one.csv");
    EXPECT_EQ(text, read_file(folder() / "two.csv"));
    EXPECT_EQ(split_lines(text).front(), "chain,draw,melanosome_fraction,papillary_blood_fraction");
}

TEST_F(UncertaintyRuns, SamplesNeedAPosterior) {
    const Outcome outcome = fit({"--samples", "one.csv"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("--uncertainty posterior"), std::string::npos) << outcome.err;
}

TEST_F(UncertaintyRuns, DesignNamesTheBestWavelengths) {
    const Outcome outcome = run({"design", "bilirubin_g_per_l", "--wavelengths", "400:700:50", "--best", "3", "--set",
                                 "rays=1000", "--format", "json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out)["best_nm"].size(), 3U);
    EXPECT_EQ(run({"design", "bilirubin"}).exit_code, 2);
}

}  // namespace
}  // namespace skinfit::test
