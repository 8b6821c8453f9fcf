#include <cmath>

#include "core/json.hpp"
#include "fit/step_tolerance.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

class InstrumentRuns : public CliTest {
protected:
    [[nodiscard]] Json json_of(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"--format", "json"});
        const Outcome outcome = run(arguments);
        EXPECT_LE(outcome.exit_code, 1) << outcome.err;
        return Json::parse(outcome.out);
    }
};

TEST_F(InstrumentRuns, AFitFindsTheSkinThatWasSimulatedThroughItsBandpass) {
    const Outcome simulated = run({"simulate", "--engine", "solver", "--wavelengths", "450:650:10", "--set",
                                   "bandpass_width_nm=20", "--set", "oxygen_saturation=0.9", "--out", "skin.csv"});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
    const std::vector<std::string> fit = {
        "fit",   "skin.csv", "--column", "reflectance",       "--set", "engine=solver", "--set", "noise=0.001",
        "--set", "starts=1", "--fix",    "bilirubin_g_per_l", "--set", "preset=paper"};
    const Json convolved = json_of(fit);  // the file states the bandpass
    EXPECT_EQ(convolved["configuration"]["bandpass_width_nm"], 20.0);
    // The same solver over the same bands, and all digits in the file: what is left is the step tolerance of the fit,
    // 1e-9 of the bounds, which are 0 and 1.
    EXPECT_NEAR(convolved["parameters"]["oxygen_saturation"]["value"].get<double>(), 0.9, step_tolerance);
    std::vector<std::string> without = fit;
    without.insert(without.end(), {"--set", "bandpass_width_nm=0"});
    const Json unconvolved = json_of(without);
    EXPECT_GT(unconvolved["rmse"].get<double>(), 1000.0 * convolved["rmse"].get<double>());
}

TEST_F(InstrumentRuns, ANamedInstrumentIsPartOfTheResult) {
    const Json json = json_of({"fit", SKINFIT_SOURCE_DIR "/measurements/data/ncsu_113.csv", "--set", "rays=2000",
                               "--set", "instrument=nist_sphere"});
    EXPECT_EQ(json["configuration"]["instrument"], "nist_sphere");
    EXPECT_EQ(json["configuration"]["incidence_deg"], 8.0);
    const Outcome outcome = run({"simulate", "--set", "instrument=nist"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("there is no instrument \"nist\""), std::string::npos) << outcome.err;
}

TEST_F(InstrumentRuns, BandsMustLieWithinTheTables) {
    const Outcome outcome =
        run({"fit", SKINFIT_SOURCE_DIR "/measurements/data/ncsu_113.csv", "--set", "wavelength_max_nm=730", "--set",
             "bandpass_width_nm=100", "--set", "bandpass_shape=gaussian"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("error: bandpass_width_nm: the bands of the readings reach to "), std::string::npos)
        << outcome.err;
}

}  // namespace
}  // namespace skinfit::test
