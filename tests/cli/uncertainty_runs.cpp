#include <algorithm>

#include "core/json.hpp"
#include "core/text.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

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
            "fit",      "skin.csv",
            "--column", "reflectance",
            "--set",    "preset=paper",
            "--set",    "rays=1000",
            "--fix",    "reticular_blood_fraction,oxygen_saturation,bilirubin_g_per_l"};
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

// Of NCSU 82 the search for the lower end of the oxygen saturation passes another valley.
TEST_F(UncertaintyRuns, AtTheEndsOfProfilesTheBestRefitHasRisenToTheThreshold) {
    const std::vector<std::string> common = {"fit",      SKINFIT_SOURCE_DIR "/measurements/data/ncsu_082.csv",
                                             "--set",    "preset=paper",
                                             "--set",    "discrepancy={}",
                                             "--set",    "engine=emulator",
                                             "--format", "json"};
    const auto fitted = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = common;
        arguments.insert(arguments.end(), more.begin(), more.end());
        return Json::parse(run(arguments).out);
    };
    const Json json = fitted({"--uncertainty", "profile"});
    int ends = 0;
    for (const auto& [name, curve] : json["uncertainty"]["profile"]["curves"].items()) {
        const Json& row = json["parameters"][name];
        for (const Json& end : row["interval_95"]) {
            if (end == row["lower"] || end == row["upper"]) continue;
            const Json refit = fitted({"--fix", name, "--set", name + "=" + end.dump()});
            // Near a bound the threshold is lower than 1.96 squared.
            const std::vector<double> thresholds = curve["cost_rise_95"];
            const auto [least, most] = std::ranges::minmax(thresholds);
            const double rise = refit["cost"].get<double>() - json["cost"].get<double>();
            EXPECT_GT(rise, 0.97 * least) << name << " " << end;
            EXPECT_LT(rise, 1.03 * most) << name << " " << end;
            ++ends;
        }
    }
    EXPECT_GE(ends, 8);
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

TEST_F(UncertaintyRuns, DesignSaysThatItCountsNoDiscrepancy) {
    std::vector<std::string> design = {"design", "bilirubin_g_per_l", "--wavelengths", "400:700:50",
                                       "--set",  "rays=1000"};
    const std::string said = "of noise alone: the discrepancy is not counted";
    EXPECT_EQ(run(design).out.find(said), std::string::npos);
    design.insert(design.end(), {"--set", "discrepancy={}"});
    EXPECT_NE(run(design).out.find(said), std::string::npos);
}

}  // namespace
}  // namespace skinfit::test
