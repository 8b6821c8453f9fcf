#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "core/file.hpp"
#include "fit/configuration_json.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit::test {
namespace {

/// A validator that knows the schema and nothing of the loader.
bool schema_accepts(const std::string& text) {
    const nlohmann::json schema_json = nlohmann::json::parse(configuration_schema().dump());
    const nlohmann::json json = nlohmann::json::parse(text);
    valijson::Schema schema;
    valijson::SchemaParser parser;
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
    valijson::Validator validator;
    return validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(json), nullptr);
}

Configuration loaded(const std::string& text) {
    return configured_by_text(default_configuration(), text, "c.json");
}

/// The message with which the loader refuses `text`; empty where it does not.
std::string refusal(const std::string& text) {
    return refusal_of([&] { (void)loaded(text); });
}

/// Everything different from its default.
Configuration unusual() {
    Configuration c = default_configuration();
    c.edition = Edition::printed;
    c.engine = Engine::walk;
    c.solver = Solver::bobyqa;
    c.layers = 2;
    c.base = Base{.kind = Base::Kind::index, .refractive_index = 1.45};
    c.incidence_deg = 45.5;
    c.specular = Specular::excluded;
    c.instrument = find_instrument("nist_sphere", "instrument");
    c.bandpass_shape = BandpassShape::rectangular;
    c.bandpass_width_nm = 3.5;
    c.quantity = Quantity::transmittance;
    c.column = "2";
    c.unit = Unit::percent;
    c.rays = 10'000'000'000;
    c.seed = 9'007'199'254'740'991;
    c.wavelengths = "450,540,660.5";
    c.wavelength_min_nm = 450.25;
    c.wavelength_max_nm = 650;
    c.noise = 0.1 / 3;
    c.exclude_nm = {{500, 510}, {600.5, 610}};
    c.weights = {{.range_nm = {650, 700}, .weight = 0.1}};
    c.loss = Loss::cauchy;
    c.loss_scale = 3.5;
    c.discrepancy = Discrepancy{.sigma = 0.01, .length_nm = 20, .kernel = Kernel::matern_3_2};
    c.starts = 17;
    c.priors[0] = LogNormalPrior{.median = 0.1 / 3, .sigma_log = 0.7};
    c.priors[1] = NormalPrior{.mean = 80, .sigma = 10};
    c.priors[5] = BetaPrior{.a = 1.5, .b = 3};
    c.derived_priors[0] = NormalPrior{.mean = 0.02, .sigma = 0.01};
    for (const ParameterInfo& row : parameter_table()) {
        const auto i = static_cast<std::size_t>(row.parameter);
        value_of(c.values, row.parameter) = row.lower + (row.upper - row.lower) / 3;
        c.bounds[i] = {row.lower + (row.upper - row.lower) / 7, row.upper - (row.upper - row.lower) / 7};
        c.free[i] = !c.free[i];
    }
    return c;
}

TEST(ConfigurationJson, RoundTripIsTheIdentity) {
    for (const Configuration& configuration : {default_configuration(), unusual()}) {
        const std::string text = to_json(configuration).dump();
        EXPECT_EQ(to_json(loaded(text)).dump(), text);
        EXPECT_TRUE(schema_accepts(text));
    }
}

TEST(ConfigurationJson, RoundTripKeepsEveryField) {
    const Configuration before = unusual();
    const Configuration after = loaded(to_json(before).dump());
    EXPECT_EQ(after.edition, before.edition);
    EXPECT_EQ(after.engine, before.engine);
    EXPECT_EQ(after.solver, before.solver);
    EXPECT_EQ(after.layers, before.layers);
    EXPECT_EQ(after.base, before.base);
    EXPECT_EQ(after.incidence_deg, before.incidence_deg);
    EXPECT_EQ(after.specular, before.specular);
    ASSERT_TRUE(after.instrument);
    EXPECT_EQ(after.instrument->name, before.instrument->name);
    EXPECT_EQ(after.bandpass_shape, before.bandpass_shape);
    EXPECT_EQ(after.bandpass_width_nm, before.bandpass_width_nm);
    EXPECT_EQ(after.quantity, before.quantity);
    EXPECT_EQ(after.column, before.column);
    EXPECT_EQ(after.unit, before.unit);
    EXPECT_EQ(after.rays, before.rays);
    EXPECT_EQ(after.seed, before.seed);
    EXPECT_EQ(after.wavelengths, before.wavelengths);
    EXPECT_EQ(after.noise, before.noise);
    EXPECT_EQ(after.free, before.free);
    for (std::size_t i = 0; i < parameter_count; ++i) {
        EXPECT_EQ(after.bounds[i].lower, before.bounds[i].lower);
        EXPECT_EQ(after.bounds[i].upper, before.bounds[i].upper);
    }
}

TEST(ConfigurationJson, BasesOfEveryKindAndNone) {
    for (const std::string text :
         {R"({"base": "hypodermis"})", R"({"base": "matched"})", R"({"base": 1.33})", R"({"base": null})"}) {
        EXPECT_EQ(to_json(loaded(text))["base"], Json::parse(text)["base"]);
        EXPECT_TRUE(schema_accepts(text));
    }
}

TEST(ConfigurationJson, CommentsAreAllowed) {
    EXPECT_EQ(loaded("{ // why\n\"seed\": 7 /* because */ }").seed, 7U);
}

TEST(ConfigurationJson, FreeReplacesTheList) {
    const Configuration configuration = loaded(R"({"free": ["scale"]})");
    EXPECT_EQ(free_parameters(configuration), std::vector{Parameter::scale});
    EXPECT_TRUE(free_parameters(loaded(R"({"free": []})")).empty());
}

TEST(ConfigurationJson, NamesWithASignChangeTheList) {
    const std::string text = R"({"free": ["+scale", "-bilirubin_g_per_l"], "own": ["+oxygen_saturation"]})";
    Configuration expected = default_configuration();
    expected.free[static_cast<std::size_t>(Parameter::scale)] = true;
    expected.free[static_cast<std::size_t>(Parameter::bilirubin_g_per_l)] = false;
    EXPECT_EQ(loaded(text).free, expected.free);
    EXPECT_TRUE(loaded(text).own[static_cast<std::size_t>(Parameter::oxygen_saturation)]);
    EXPECT_TRUE(schema_accepts(text));
    EXPECT_EQ(configured_by_text(loaded(R"({"free": ["scale"]})"), R"({"free": ["+offset"]})", "c.json").free,
              loaded(R"({"free": ["scale", "offset"]})").free);
    EXPECT_EQ(configured_by_assignment(default_configuration(), "free=+scale,-bilirubin_g_per_l").free, expected.free);
    EXPECT_EQ(configured_by_assignment(default_configuration(), "free=scale, offset").free,
              loaded(R"({"free": ["scale", "offset"]})").free);
    EXPECT_EQ(configured_by_assignment(default_configuration(), R"(free=["+scale","-bilirubin_g_per_l"])").free,
              expected.free);
    EXPECT_NE(refusal(R"({"free": ["+scale", "-scale"]})").find("names scale twice"), std::string::npos);
}

TEST(ConfigurationJson, TheShippedOnesFreeTheSkin) {
    const Configuration with_scale =
        configured_by_text(default_configuration(), read_file(SKINFIT_SOURCE_DIR "/configs/fit_with_scale.json"), "c");
    EXPECT_EQ(with_scale.free, with_freedom(default_configuration(), "scale", true, "--free").free);
}

TEST(ConfigurationJson, AParameterIsANumberOrAnObject) {
    EXPECT_EQ(loaded(R"({"parameters": {"scale": 1.5}})").values.instrument.scale, 1.5);
    const Configuration configuration =
        loaded(R"({"parameters": {"scale": {"value": 1.2, "lower": 1, "upper": 1.3}}})");
    EXPECT_EQ(configuration.values.instrument.scale, 1.2);
    EXPECT_EQ(configuration.bounds[static_cast<std::size_t>(Parameter::scale)].upper, 1.3);
}

TEST(ConfigurationJson, MisuseIsRefusedByLoaderAndSchema) {
    for (const std::string text : {"[]",
                                   "7",
                                   "\"text\"",
                                   R"({"sead": 1})",
                                   R"({"seed": -1})",
                                   R"({"seed": 1.5})",
                                   R"({"seed": "1"})",
                                   R"({"rays": 999})",
                                   R"({"rays": 1e11})",
                                   R"({"rays": null})",
                                   R"({"edition": "Revised"})",
                                   R"({"edition": null})",
                                   R"({"edition": 1})",
                                   R"({"engine": "ray"})",
                                   R"({"solver": ["ceres"]})",
                                   R"({"layers": 3})",
                                   R"({"layers": "4"})",
                                   R"({"base": "air"})",
                                   R"({"base": 0.9})",
                                   R"({"base": true})",
                                   R"({"incidence_deg": 86})",
                                   R"({"incidence_deg": "8"})",
                                   R"({"specular": true})",
                                   R"({"quantity": "R"})",
                                   R"({"column": 1.5})",
                                   R"({"column": []})",
                                   R"({"unit": "%"})",
                                   R"({"wavelengths": true})",
                                   R"({"wavelength_min_nm": -1})",
                                   R"({"wavelength_max_nm": "x"})",
                                   R"({"noise": 0})",
                                   R"({"noise": 2})",
                                   R"({"starts": 0})",
                                   R"({"loss": "huge"})",
                                   R"({"loss_scale": 0})",
                                   R"({"exclude_nm": [500, 510]})",
                                   R"({"exclude_nm": [[500]]})",
                                   R"({"weights": [[500, 510]]})",
                                   R"({"weights": [[500, 510, 0]]})",
                                   R"({"discrepancy": 0.005})",
                                   R"({"discrepancy": {"sigma": 0}})",
                                   R"({"discrepancy": {"length": 30}})",
                                   R"({"discrepancy": {"kernel": "matern"}})",
                                   R"({"priors": "physical"})",
                                   R"({"priors": 1})",
                                   R"({"priors": {"scal": {"kind": "uniform"}}})",
                                   R"({"priors": {"scale": 1}})",
                                   R"({"priors": {"scale": {}}})",
                                   R"({"priors": {"scale": {"kind": "gauss"}}})",
                                   R"({"priors": {"scale": {"kind": "normal", "mean": 1}}})",
                                   R"({"priors": {"scale": {"kind": "normal", "mean": 1, "sigma": 0}}})",
                                   R"({"priors": {"scale": {"kind": "normal", "mean": 1, "sigma": 1, "a": 1}}})",
                                   R"({"priors": {"scale": {"kind": "uniform", "lower": 1}}})",
                                   R"({"priors": {"oxygen_saturation": {"kind": "beta", "a": 1, "b": 2}}})",
                                   R"({"free": "scale"})",
                                   R"({"free": [1]})",
                                   R"({"free": ["scal"]})",
                                   R"({"free": {}})",
                                   R"({"free": ["scale", "scale"]})",
                                   R"({"free": ["scale", "+offset"]})",
                                   R"({"free": ["+scal"]})",
                                   R"({"free": ["scale,offset"]})",
                                   R"({"parameters": []})",
                                   R"({"parameters": {"scal": 1}})",
                                   R"({"parameters": {"scale": 0}})",
                                   R"({"parameters": {"scale": null}})",
                                   R"({"parameters": {"scale": "1"}})",
                                   R"({"parameters": {"scale": {"valu": 1}}})",
                                   R"({"parameters": {"scale": {"lower": -1}}})",
                                   R"({"parameters": {"melanosome_fraction": 1.01}})"}) {
        EXPECT_NE(refusal(text), "") << text;
        EXPECT_FALSE(schema_accepts(text)) << text;
    }
}

TEST(ConfigurationJson, WhatNoSchemaCanSayTheLoaderRefuses) {
    EXPECT_NE(refusal(R"({"parameters": {"scale": {"lower": 1.5, "upper": 1.5}}})").find("not below"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"wavelengths": "400:300:10"})"), "");
}

TEST(ConfigurationJson, UnknownKeysNameTheNearest) {
    for (const auto& [text, nearest] :
         {std::pair{R"({"sead": 1})", "\"seed\""}, std::pair{R"({"wavelength": 1})", "\"wavelengths\""},
          std::pair{R"({"free": ["melanosome"]})", "\"melanosome_fraction\""},
          std::pair{R"({"free": ["+melanosome"]})", "\"melanosome_fraction\""},
          std::pair{R"({"parameters": {"blood": 1}})", "\"papillary_blood_fraction\" or \"reticular_blood_fraction\""},
          std::pair{R"({"parameters": {"oxygen_saturaton": 1}})", "\"oxygen_saturation\""},
          std::pair{R"({"parameters": {"scale": {"max": 1}}})", "give one of value, lower, upper"}}) {
        EXPECT_NE(refusal(text).find(nearest), std::string::npos) << refusal(text);
    }
}

TEST(ConfigurationJson, MalformedTextNamesItsLine) {
    EXPECT_TRUE(refusal("{\"seed\": 1,\n\"rays\" 1}").starts_with("c.json:2: "))
        << refusal("{\"seed\": 1,\n\"rays\" 1}");
    EXPECT_TRUE(refusal("{\"seed\": 1,\n\n}").starts_with("c.json:3: "));
    EXPECT_TRUE(refusal("").starts_with("c.json:1: "));
    EXPECT_TRUE(refusal("{\n\"seed\": 1").starts_with("c.json:2: "));
    EXPECT_TRUE(refusal(R"({"noise": 1e999})").starts_with("c.json")) << refusal(R"({"noise": 1e999})");
}

TEST(ConfigurationJson, PriorsAddToASetOrReplaceIt) {
    const Configuration physiological = loaded(R"({"priors": "physiological"})");
    EXPECT_TRUE(physiological.priors[static_cast<std::size_t>(Parameter::melanosome_fraction)].has_value());
    const Configuration changed =
        configured_by_text(physiological, R"({"priors": {"melanosome_fraction": {"kind": "uniform"}}})", "c.json");
    EXPECT_FALSE(changed.priors[static_cast<std::size_t>(Parameter::melanosome_fraction)].has_value());
    EXPECT_TRUE(changed.priors[static_cast<std::size_t>(Parameter::oxygen_saturation)].has_value());
    EXPECT_EQ(to_json(configured_by_text(changed, R"({"priors": "uniform"})", "c.json")),
              to_json(default_configuration()));
    EXPECT_EQ(to_json(configured_by_assignment(default_configuration(), "priors=physiological")),
              to_json(physiological));
}

TEST(ConfigurationJson, AResultIsAConfiguration) {
    EXPECT_EQ(loaded(R"({"verdict": "suspect", "configuration": {"seed": 9}, "seed": 1})").seed, 9U);
    EXPECT_NE(refusal(R"({"configuration": {"sead": 9}})"), "");
}

}  // namespace
}  // namespace skinfit::test
