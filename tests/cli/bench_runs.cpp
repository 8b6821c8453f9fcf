#include "core/json.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

class BenchRuns : public CliTest {};

TEST_F(BenchRuns, EveryRungAndRatioIsMeasured) {
    const Outcome outcome = run({"bench", "--spectra", "3", "--solver-spectra", "1", "--bulk-spectra", "3", "--rays",
                                 "3200", "--brute-force-evaluations", "2", "--format", "json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json["spectra"], 3);
    for (const std::string ratio : {"paths_over_brute_force", "emulator_over_paths"}) {
        EXPECT_GT(json["ratios"][ratio].get<double>(), 1.0) << ratio;
    }
    EXPECT_GT(json["bulk_spectra_per_s"].get<double>(), 0.0);
    EXPECT_LE(json["emulator"]["certified_error"].get<double>(), 2e-4);
    for (const std::string name : {"record", "respond", "bulk"}) {
        EXPECT_TRUE(json["two_threads_over_one"][name].is_number()) << name;
    }
    EXPECT_EQ(json["rungs"].size(), 6);
    EXPECT_EQ(json["brute_force"]["timed_evaluations"], 2);
}

TEST_F(BenchRuns, TooFewRaysAreRefused) {
    EXPECT_EQ(run({"bench", "--rays", "10"}).exit_code, 2);
}

}  // namespace
}  // namespace skinfit::test
