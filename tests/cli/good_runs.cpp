#include <algorithm>
#include <csignal>

#include "core/json.hpp"
#include "core/text.hpp"
#include "fit/step_tolerance.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

using Arguments = std::vector<std::string>;
const std::string specimen = SKINFIT_SOURCE_DIR "/measurements/data/ncsu_113.csv";

class GoodRuns : public CliTest {
protected:
    /// Expects success without a word on stderr; stdout.
    [[nodiscard]] std::string output_of(const Arguments& arguments, int exit_code = 0) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return outcome.out;
    }
};

Arguments joined(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

const Arguments quick_fit = {"fit", specimen, "--set", "rays=2000", "--free", "scale", "--set", "noise=0.01"};

TEST_F(GoodRuns, HelpAndVersion) {
    EXPECT_NE(output_of({"--help"}).find("not a medical device"), std::string::npos);
    EXPECT_EQ(std::ranges::count(output_of({"--version"}), '.'), 2);
    for (const std::string command : {"fit", "inspect", "simulate", "config"})
        EXPECT_NE(output_of({command, "--help"}), "");
}

TEST_F(GoodRuns, ConfigurationsShowCheckAndSchema) {
    const std::string shown = output_of({"config", "show"});
    EXPECT_EQ(Json::parse(shown)["seed"], 1);
    put("c.json", shown);
    EXPECT_EQ(output_of({"config", "check", "c.json"}), "c.json: good\n");
    EXPECT_EQ(Json::parse(output_of({"config", "schema"}))["title"], "skinfit configuration");
}

TEST_F(GoodRuns, ExitCodeFollowsTheVerdict) {
    // Of noise much larger than the misfit nothing is suspect; of far too small noise the misfit is.
    Arguments arguments = {"fit",       specimen, "--set",
                           "rays=2000", "--fix",  "reticular_blood_fraction,oxygen_saturation,bilirubin_g_per_l"};
    EXPECT_NE(output_of(joined(arguments, {"--set", "noise=0.1"})).find("verdict: consistent"), std::string::npos);
    EXPECT_NE(output_of(joined(arguments, {"--set", "noise=0.0001"}), 1).find("verdict: SUSPECT"), std::string::npos);
}

TEST_F(GoodRuns, JsonIsPureAndItsConfigurationGivesItAgain) {
    const Outcome first = run(joined(quick_fit, {"--format", "json"}));
    EXPECT_LE(first.exit_code, 1);
    EXPECT_EQ(first.err, "");
    const Json json = Json::parse(first.out);
    EXPECT_EQ(json["verdict"] == "consistent", first.exit_code == 0);
    put("result.json", first.out);
    EXPECT_EQ(run({"fit", specimen, "--config", "result.json", "--format", "json"}).out, first.out);
    put("configuration.json", json["configuration"].dump());
    EXPECT_EQ(run({"fit", specimen, "--config", "configuration.json", "--format", "json"}).out, first.out);
}

TEST_F(GoodRuns, OutputIsTheSameInAFileAndWithOrWithoutTheCache) {
    const std::string shown = run(quick_fit).out;
    EXPECT_EQ(run(quick_fit).out, shown);  // from the cache
    EXPECT_EQ(run(joined(quick_fit, {"--no-cache"})).out, shown);
    const Outcome silent = run(joined(quick_fit, {"--out", "report.txt"}));
    EXPECT_EQ(silent.out, "");
    EXPECT_EQ(read_file(folder() / "report.txt"), shown);
}

TEST_F(GoodRuns, ThreadsDoNotChangeAByte) {
    for (const Arguments& arguments :
         {joined(quick_fit, {"--format", "json", "--no-cache"}),
          Arguments{"simulate", "--rays", "2000", "--wavelengths", "400:700:50", "--no-cache"},
          Arguments{"simulate", "--rays", "2000", "--wavelengths", "400:700:50", "--engine", "walk"}}) {
        const std::string one = run(joined(arguments, {"--threads", "1"})).out;
        EXPECT_NE(one, "");
        EXPECT_EQ(run(joined(arguments, {"--threads", "2"})).out, one);
    }
}

/// The errors of a simulation are none of a measurement.
TEST_F(GoodRuns, AFitOfASimulationTakesTheNoiseOfItsSettings) {
    for (const std::string engine : {"paths", "solver"}) {
        ASSERT_EQ(run({"simulate", "--engine", engine, "--rays", "1000", "--out", "skin.csv"}).exit_code, 0);
        const Json fit = Json::parse(run({"fit", "skin.csv", "--column", "reflectance", "--set", "noise=0.004", "--set",
                                          "engine=emulator", "--format", "json"})
                                         .out);
        EXPECT_EQ(fit["spectrum"]["sigma_source"], "0.004 at every wavelength (setting noise)");
    }
}

TEST_F(GoodRuns, SimulationHasItsColumns) {
    for (const std::string engine : {"walk", "paths"}) {
        const std::string text = output_of(
            {"simulate", "--engine", engine, "--rays", "1000", "--wavelengths", "450,550", "--set", "layers=2"});
        std::vector<std::string_view> rows;
        for (const std::string_view line : split_lines(text)) {
            if (!line.starts_with('#')) rows.push_back(line);
        }
        ASSERT_EQ(rows.size(), 3U);
        EXPECT_EQ(rows[0],
                  "wavelength_nm,reflectance,reflectance_model_error,transmittance,transmittance_model_error,"
                  "surface_reflectance");
        for (const std::string_view row : {rows[1], rows[2]}) {
            const std::vector<std::string_view> fields = split(row, ',');
            ASSERT_EQ(fields.size(), 6U);
            for (const std::string_view field : fields) EXPECT_TRUE(parse_number(field)) << field;
        }
        const Json json = Json::parse(output_of(
            {"simulate", "--engine", engine, "--rays", "1000", "--wavelengths", "450,550", "--format", "json"}));
        EXPECT_EQ(json["wavelength_nm"], Json({450.0, 550.0}));
        EXPECT_EQ(json["reflectance"].size(), 2U);
        EXPECT_EQ(json["engine"], engine);
    }
}

TEST_F(GoodRuns, WhatIsSimulatedIsFound) {
    const Arguments geometry = {"--set", "rays=2000", "--set", "incidence_deg=45", "--set", "specular=excluded"};
    (void)output_of(joined({"simulate", "--set", "melanosome_fraction=0.1", "--set", "oxygen_saturation=0.6", "--set",
                            "bilirubin_g_per_l=0.4", "--out", "skin.csv"},
                           geometry));
    // Geometry comes from the comments of the file.
    const Outcome fit = run({"fit", "skin.csv", "--column", "reflectance", "--set", "preset=paper", "--set",
                             "rays=2000", "--format", "json"});
    const Json json = Json::parse(fit.out);
    EXPECT_EQ(json["configuration"]["incidence_deg"], 45.0);
    EXPECT_EQ(json["configuration"]["specular"], "excluded");
    // The same walks, and all digits in the file: what is left is the step tolerance of the search.
    for (const auto& [name, value] :
         {std::pair{"melanosome_fraction", 0.1}, std::pair{"oxygen_saturation", 0.6},
          std::pair{"bilirubin_g_per_l", 0.4}, std::pair{"papillary_blood_fraction", 0.012}}) {
        const Json& found = json["parameters"][name];
        const double width = found["upper"].get<double>() - found["lower"].get<double>();
        EXPECT_NEAR(found["value"].get<double>(), value, step_tolerance * width) << name;
    }
}

TEST_F(GoodRuns, CrossCheckReportsBothSolvers) {
    const Json json = Json::parse(run(joined(quick_fit, {"--cross-check", "--format", "json"})).out);
    ASSERT_EQ(json["cross_check"].size(), 4U);
    EXPECT_EQ(json["cross_check"][0]["solver"], "bobyqa");
}

TEST_F(GoodRuns, BytesThatAreNoUtf8DoNoHarm) {
    const Outcome outcome =
        run({"simulate", "--rays", "1000", "--wavelengths", "500", "--format", "json", "--set", "column=\xff"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(Json::accept(outcome.out));
}

TEST_F(GoodRuns, AReaderThatLeavesDoesNotCrashTheProgram) {
    for (const Arguments& arguments : {Arguments{"config", "show"}, Arguments{"--help"},
                                       Arguments{"simulate", "--rays", "1000", "--wavelengths", "500"}}) {
        const Outcome outcome = run(arguments, Stdout::closed_pipe);
        // As any filter: ended by SIGPIPE, or with a message where the caller ignores that signal.
        EXPECT_TRUE(outcome.signal == SIGPIPE || outcome.exit_code == 2) << outcome.signal << outcome.err;
    }
}

}  // namespace
}  // namespace skinfit::test
