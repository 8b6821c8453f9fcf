#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/file.hpp"
#include "core/version.hpp"
#include "fit/configuration_json.hpp"
#include "fit/report.hpp"
#include "tests/fit/example_result.hpp"

namespace skinfit::test {
namespace {

/// Compares `text`, its version replaced, with tests/fit/golden/<name>. With SKINFIT_UPDATE_GOLDEN=1 in the environment
/// the file is written instead: run this test once so after a change of the report, and read the difference.
void expect_golden(std::string text, const std::string& name) {
    const std::string number(version);
    for (std::size_t at = text.find(number); at != std::string::npos; at = text.find(number, at)) {
        text.replace(at, number.size(), "VERSION");
    }
    const std::filesystem::path path = std::filesystem::path(SKINFIT_SOURCE_DIR) / "tests/fit/golden" / name;
    const char* const update = std::getenv("SKINFIT_UPDATE_GOLDEN");
    if (update != nullptr && std::string(update) == "1") write_file_atomically(path, text);
    EXPECT_EQ(text, read_file(path));
}

TEST(TextReport, ShowsEveryStatus) {
    expect_golden(text_report(example_result()), "suspect.txt");
}

TEST(TextReport, SaysLittleWhereAllIsWell) {
    expect_golden(text_report(good_result()), "consistent.txt");
}

TEST(TextReport, ShowsHowThePosteriorWasSampled) {
    expect_golden(text_report(sampled_result()), "sampled.txt");
}

TEST(TextReport, SaysWhereTheSpectrumSpreadsAParameter) {
    FitResult result = sampled_result();
    EXPECT_EQ(text_report(result).find("further apart"), std::string::npos);
    result.identifiability.shrinkage.front() = -0.25;
    EXPECT_NE(text_report(result).find("   -25.0 %  melanosome_fraction  (values lie further apart than before)\n"),
              std::string::npos)
        << text_report(result);
}

TEST(TextReport, SaysWhichMinimaWereLeftOut) {
    FitResult result = example_result();
    EXPECT_EQ(search_words(result), "8 starts, which ended at 2 minima");
    result.searches.rough_minima = 7;
    result.searches.finished = 6;
    EXPECT_EQ(search_words(result), "8 starts, 7 minima; the best 6 were finished, and ended at 2 minima");
    EXPECT_EQ(json_report(result)["searches"], Json::parse(R"({"starts": 8, "minima": 7, "finished": 6})"));
    result.searches = {.minima = {{.minimum = result.answer.minimum, .searches = 0},
                                  {.minimum = result.answer.minimum, .searches = 1}},
                       .starts = 1,
                       .rough_minima = 1,
                       .finished = 1};
    EXPECT_EQ(search_words(result), "1 start, which ended at 1 minimum; profiling met one more");
}

TEST(TextReport, SaysWhatACostIs) {
    FitResult result = example_result();
    EXPECT_EQ(cost_name(result), "cost");
    EXPECT_EQ(cost_words(result), "chi2 with loss huber, plus what 1 prior adds");
    result.configuration.weights.resize(2);
    result.priors.clear();
    EXPECT_EQ(cost_words(result), "chi2 with loss huber, with weights in 2 ranges");
    EXPECT_EQ(cost_name(good_result()), "chi2");
}

TEST(TextReport, LinesEndWithoutBlanks) {
    EXPECT_EQ(text_report(example_result()).find(" \n"), std::string::npos);
}

TEST(JsonReport, HasEveryKey) {
    const Json json = Json::parse(json_report(example_result()).dump());
    for (const char* key :
         {"verdict",     "reasons",       "rmse",     "chi2",    "degrees_of_freedom", "p_value",    "parameters",
          "correlation", "wavelength_nm", "measured", "sigma",   "modelled",           "residual",   "edition",
          "engine",      "seed",          "rays",     "version", "configuration",      "cross_check"}) {
        EXPECT_TRUE(json.contains(key)) << key;
    }
    ASSERT_EQ(json["parameters"].size(), parameter_count);
    for (const auto& [name, parameter] : json["parameters"].items()) {
        for (const char* key : {"value", "sigma", "lower", "upper", "start", "status"}) {
            EXPECT_TRUE(parameter.contains(key)) << name << " " << key;
        }
    }
}

TEST(JsonReport, HoldsWhatIsKnownOfTheUncertainty) {
    const Json plain = json_report(example_result())["uncertainty"];
    EXPECT_EQ(plain["intervals"], "covariance");
    EXPECT_EQ(plain["inflation"], 1.0786);
    EXPECT_EQ(plain["directions"].size(), 5U);
    EXPECT_EQ(plain["directions"][3]["words"], "papillary_blood_fraction trades against melanosome_fraction");
    EXPECT_EQ(plain["directions"][4]["weak"], true);
    EXPECT_EQ(plain["shrinkage"]["bilirubin_g_per_l"], 0.99);
    EXPECT_FALSE(plain.contains("posterior"));
    const Json sampled = json_report(sampled_result())["uncertainty"];
    EXPECT_EQ(sampled["intervals"], "posterior");
    EXPECT_EQ(sampled["posterior"]["divergences"], 1);
    EXPECT_EQ(sampled["posterior"]["draws_per_chain"], 2);
    EXPECT_EQ(sampled["posterior"]["parameters"]["melanosome_fraction"]["r_hat"], 1.0012);
}

TEST(JsonReport, RepeatsTheResult) {
    const FitResult result = example_result();
    const Json json = json_report(result);
    EXPECT_EQ(json["verdict"], "suspect");
    EXPECT_EQ(json["reasons"].get<std::vector<std::string>>(), result.reasons);
    EXPECT_EQ(json["version"], version);
    EXPECT_EQ(json["parameters"]["melanosome_fraction"]["sigma"], 0.00123);
    EXPECT_EQ(json["parameters"]["melanosome_fraction"]["status"], "free");
    EXPECT_TRUE(json["parameters"]["bilirubin_g_per_l"]["sigma"].is_null());
    EXPECT_EQ(json["parameters"]["bilirubin_g_per_l"]["status"], "at_lower_bound");
    EXPECT_EQ(json["parameters"]["bilirubin_g_per_l"]["interval_95"], Json({0.0, 0.214}));
    EXPECT_EQ(json["parameters"]["oxygen_saturation"]["status"], "at_upper_bound");
    EXPECT_EQ(json["parameters"]["dermis_carotene_g_per_l"]["status"], "not_identifiable");
    EXPECT_EQ(json["parameters"]["scale"]["status"], "fixed");
    EXPECT_EQ(json["correlation"]["parameters"].size(), 5U);
    EXPECT_EQ(json["correlation"]["matrix"][0][1], -0.934);
    const FittedSpectrum& spectrum = result.spectra.front();
    for (std::size_t i = 0; i < spectrum.measured.size(); ++i) {
        EXPECT_EQ(json["residual"][i], spectrum.modelled[i] - spectrum.measured[i]);
    }
    EXPECT_EQ(json["configuration"], to_json(result.configuration));
}

TEST(JsonReport, IsAConfiguration) {
    const FitResult result = example_result();
    const Configuration again = configured(default_configuration(), json_report(result), "result.json");
    EXPECT_EQ(to_json(again), to_json(result.configuration));
}

TEST(Reports, SayWhereTheModelSplitsAnAmount) {
    const FitResult result = split_result();
    const Json json = json_report(result);
    ASSERT_EQ(json["split_by_model"].size(), 1U);
    const Json& split = json["split_by_model"][0];
    EXPECT_EQ(split["parameters"], Json({"papillary_blood_fraction", "reticular_blood_fraction"}));
    EXPECT_EQ(split["use"], "dermal_hemoglobin_umol_per_l");
    const std::string message = split["message"];
    EXPECT_NE(text_report(result).find("  " + message + "\n"), std::string::npos) << message;
    EXPECT_EQ(json_report(good_result())["split_by_model"], Json::array());
    EXPECT_EQ(json["tissue"][0]["name"], "dermal_hemoglobin_umol_per_l");
    EXPECT_EQ(json["tissue"][0]["calibrated"], false);
}

}  // namespace
}  // namespace skinfit::test
