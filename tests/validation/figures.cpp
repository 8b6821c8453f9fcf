#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "fit/settings.hpp"
#include "tests/support/refusal.hpp"
#include "validation/figure.hpp"
#include "validation/shipped.hpp"

namespace skinfit {
namespace {

const std::filesystem::path configs = SKINFIT_SOURCE_DIR "/configs";

/// A validator that knows the schema and nothing of the reader.
bool schema_accepts(const Json& json) {
    const nlohmann::json schema_json = nlohmann::json::parse(figure_schema().dump());
    const nlohmann::json target = nlohmann::json::parse(json.dump());
    valijson::Schema schema;
    valijson::SchemaParser parser;
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
    valijson::Validator validator;
    return validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(target), nullptr);
}

/// The message with which `json` is refused; empty where it is not.
std::string refusal(const Json& json) {
    return test::refusal_of([&] { (void)parse_figure(json.dump(), "f.json"); });
}

Json good() {
    return Json::parse(read_file(configs / "figure_5.json"));
}

void expect_refusal(const Json& json, const std::string& what) {
    EXPECT_NE(refusal(json).find(what), std::string::npos) << refusal(json);
}

TEST(Figures, EveryConfigurationIsShippedAndFollowsTheSchema) {
    std::set<int> numbers;
    for (const Figure& figure : shipped_figures()) numbers.insert(figure.number);
    EXPECT_EQ(numbers, (std::set<int>{2, 3, 4, 5, 6, 7, 8, 9, 10}));
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(configs)) {
        if (!entry.path().filename().string().starts_with("figure_")) continue;
        ++files;
        EXPECT_TRUE(schema_accepts(Json::parse(read_file(entry.path())))) << entry.path();
    }
    EXPECT_EQ(files, numbers.size());
}

TEST(Figures, SettingsAddUpFromFigureToPanelToSeries) {
    Json json = good();
    json["configuration"]["parameters"] = {{"hemoglobin_g_per_l", 140}};
    json["panels"][0]["configuration"] = {{"incidence_deg", 10}};
    json["sources"]["hemoglobin_g_per_l"] = "chosen: for this test";
    const Figure figure = parse_figure(json.dump(), "f.json");
    const Configuration& first = figure.panels[0].series[2].configuration;
    EXPECT_EQ(first.values.skin.hemoglobin_g_per_l, 140);
    EXPECT_EQ(first.values.skin.melanosome_fraction, 0.1);
    EXPECT_EQ(first.incidence_deg, 10);
    EXPECT_EQ(figure.panels[1].series[0].configuration.incidence_deg, 45);
    ASSERT_EQ(figure.variants.size(), 4U);
    EXPECT_EQ(figure.variants[0].edition, Edition::printed);
    EXPECT_EQ(figure.variants[1].edition, Edition::revised);
    EXPECT_EQ(figure.variants[3].fibril_radius_nm, 1.16);
}

TEST(Figures, UnknownNamesAreRefusedAndTheNearestNamed) {
    EXPECT_EQ(refusal(good()), "");
    Json json = good();
    json["panles"] = json["panels"];
    expect_refusal(json, R"(f.json: unknown name "panles" (it would have no effect); did you mean "panels"?)");
    json = good();
    json["panels"][1]["series"][0]["configuration"]["parameters"] = {{"oxygen_saturatoin", 1}};
    expect_refusal(json, "f.json.panels[1].series[0].configuration: parameters: unknown name \"oxygen_saturatoin\"");
    json = good();
    json["panels"][0]["claims"][0] = "darker";
    expect_refusal(json, "did you mean \"darker_in_order\"?");
    json = good();
    json["kind"] = "spectra";
    expect_refusal(json, "did you mean \"spectrum\"?");
}

TEST(Figures, WhatIsMissingOrMalformedIsNamed) {
    for (const std::string key : {"figure", "title", "shows", "kind", "variants", "panels", "sources"}) {
        Json json = good();
        json.erase(key);
        expect_refusal(json, "no \"" + key + "\"");
        EXPECT_FALSE(schema_accepts(json)) << key;
    }
    Json json = good();
    json["panels"] = Json::array();
    expect_refusal(json, "f.json.panels: [] cannot be used");
    EXPECT_FALSE(schema_accepts(json));
    json = good();
    json["variants"]["fibril_radius_nm"] = {1000};
    expect_refusal(json, "fibril_radius_nm: 1000 cannot be used (out of range)");
    EXPECT_FALSE(schema_accepts(json));
    json = good();
    json["title"] = "";
    expect_refusal(json, "text is needed");
    EXPECT_FALSE(schema_accepts(json));
    try {
        (void)parse_figure("{\n  \"figure\": ,\n}", "f.json");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find("f.json:2: is no JSON"), 0U) << error.what();
    }
}

TEST(Figures, EveryValueHasASource) {
    Json json = good();
    json["sources"].erase("oxygen_saturation");
    expect_refusal(json, "\"oxygen_saturation\" has no source");
    json = good();
    json["sources"]["oxygen_saturation"] = "somewhere";
    expect_refusal(json, "\"oxygen_saturation\" has no source");
    EXPECT_FALSE(schema_accepts(json));
    json = good();
    json["sources"]["scale"] = "chosen: not set at all";
    expect_refusal(json, "unknown name \"scale\"");
}

TEST(Figures, ClaimsMustFitTheirPanel) {
    Json json = good();
    json["panels"][0]["claims"] = {"near_lambertian"};
    expect_refusal(json, "it is about angles");
    json["panels"][0]["claims"] = {"falls_with_wavelength"};
    expect_refusal(json, "it is about pigments");
    json["panels"][0]["claims"] = {"close_to_measured"};
    expect_refusal(json, "it needs a measurement");
    json = good();
    json["panels"][0]["series"].erase(1);
    json["panels"][0]["series"].erase(1);
    json["panels"][0]["series"].erase(1);
    json["panels"][0]["series"].erase(1);
    expect_refusal(json, "it compares series");
}

TEST(Figures, PigmentsAreNamed) {
    Json json = Json::parse(read_file(configs / "figure_2.json"));
    EXPECT_EQ(refusal(json), "");
    json["panels"][1]["series"][0]["name"] = "oxyhaemoglobin";
    expect_refusal(json, "did you mean \"oxyhemoglobin\"?");
}

TEST(MeasuredSpectrum, IsShippedOrSharedOrAbsent) {
    EXPECT_EQ(measured_spectrum("ncsu_113.csv", "/nowhere")->value.size(), 69U);
    EXPECT_FALSE(measured_spectrum("shared/spectra/eyelid_transmittance_bierman_2011.txt", "/nowhere"));
    try {
        (void)measured_spectrum("ncsu_114.csv", "/nowhere");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean \"ncsu_113.csv\"?"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace skinfit
