#include "core/json.hpp"
#include "fit/step_tolerance.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

using Arguments = std::vector<std::string>;
class ViewingRuns : public CliTest {};

TEST_F(ViewingRuns, TheConeGoesFromTheSimulationThroughItsFileIntoTheReport) {
    const Outcome simulated = run({"simulate", "--engine", "solver", "--set", "viewing_cone_deg=5", "--set",
                                   "melanosome_fraction=0.03", "--out", "seen.csv"});
    EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
    const std::string text = read_file(folder() / "seen.csv");
    for (const char* line : {"# incidence_deg: 45", "# specular: excluded", "# viewing_cone_deg: 5"}) {
        EXPECT_NE(text.find(line), std::string::npos) << line;
    }
    const Arguments fit = {"fit",   "seen.csv",     "--column", "reflectance",
                           "--set", "preset=paper", "--set",    "engine=solver"};
    EXPECT_NE(run(fit).out.find("specular excluded, viewing cone 5 deg"), std::string::npos);
    Arguments as_json = fit;
    as_json.insert(as_json.end(), {"--format", "json"});
    const Json json = Json::parse(run(as_json).out);
    EXPECT_EQ(json["configuration"]["viewing_cone_deg"], 5.0);
    // All digits are in the file: what is left is the step tolerance of the search.
    const Json& found = json["parameters"]["melanosome_fraction"];
    const double width = found["upper"].get<double>() - found["lower"].get<double>();
    EXPECT_NEAR(found["value"].get<double>(), 0.03, step_tolerance * width);
}

TEST_F(ViewingRuns, EnginesThatCannotAreRefused) {
    const Outcome outcome = run({"simulate", "--set", "viewing_cone_deg=5"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("set engine=solver, or engine=walk for a simulation"), std::string::npos) << outcome.err;
    const Outcome included =
        run({"simulate", "--engine", "solver", "--set", "viewing_cone_deg=5", "--set", "specular=included"});
    EXPECT_EQ(included.exit_code, 2);
    EXPECT_NE(included.err.find("set specular=excluded"), std::string::npos) << included.err;
    EXPECT_EQ(run({"simulate", "--engine", "solver", "--set", "viewing_cone_deg=0"}).exit_code, 2);
}

TEST_F(ViewingRuns, TheWalkSeesThroughTheCone) {
    const Arguments simulate = {"simulate", "--set",   "viewing_cone_deg=30", "--wavelengths", "550", "--format",
                                "json",     "--engine"};
    const auto reading = [&](const std::string& engine) {
        Arguments arguments = simulate;
        arguments.push_back(engine);
        return Json::parse(run(arguments).out);
    };
    const Json walk = reading("walk");
    const Json solver = reading("solver");
    const double error = walk["reflectance_model_error"][0].get<double>();
    EXPECT_GT(error, 0.0);
    // Beyond 4.9 standard errors lies a millionth of the normal law.
    EXPECT_NEAR(walk["reflectance"][0].get<double>(), solver["reflectance"][0].get<double>(), 4.9 * error);
}

TEST_F(ViewingRuns, TheShippedConfigurationFitsTheShippedSpecimen) {
    const std::string source = SKINFIT_SOURCE_DIR;
    const Outcome outcome =
        run({"fit", source + "/measurements/data/ncsu_113.csv", "--config", source + "/configs/ncsu_45_0.json", "--set",
             "preset=paper", "--set", "wavelength_max_nm=600"});
    EXPECT_LE(outcome.exit_code, 1) << outcome.err;
    EXPECT_NE(outcome.out.find("viewing cone 5 deg"), std::string::npos);
}

}  // namespace
}  // namespace skinfit::test
