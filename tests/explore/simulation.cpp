#include "explore/simulation.hpp"

#include "explore/configuration_request.hpp"
#include "fit/configuration_json.hpp"
#include "fit/measurement.hpp"
#include "tests/explore/asking.hpp"

namespace skinfit {
namespace {

using test::Answer;
using Simulating = test::Asking;

std::vector<Reading> readings_of(const Configuration& configuration, const std::vector<double>& wavelengths_nm) {
    return read_by_solver(make_experiment(configuration), wavelengths_nm);
}

TEST_F(Simulating, IsTheReadingOfTheAngularSolver) {
    for (const char* edition : {"revised", "printed"}) {
        const Json json = {{"edition", edition}, {"parameters", {{"melanosome_fraction", 0.1}, {"scale", 0.9}}}};
        const Answer answer = simulate(json);
        ASSERT_EQ(answer.status, 200) << answer.json;
        const auto wavelengths_nm = answer.json["wavelength_nm"].get<std::vector<double>>();
        ASSERT_EQ(wavelengths_nm.size(), 151U);
        const auto expected = readings_of(configured(explore_configuration(), json, "test"), wavelengths_nm);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_DOUBLE_EQ(answer.json["reading"][i].get<double>(), expected[i].reflectance);
        }
    }
}

TEST_F(Simulating, AnotherSkinInTheSameGeometryIsNoOther) {
    // The solver is kept from one simulation to the next; what it gives must not depend on that.
    const Json darker = {{"parameters", {{"melanosome_fraction", 0.3}, {"epidermis_refractive_index", 1.42}}}};
    const Json fresh = simulate(darker).json;
    (void)simulate({{"parameters", {{"fibril_radius_nm", 40}}}});
    (void)simulate({{"edition", "printed"}});
    (void)simulate({{"incidence_deg", 45}});
    EXPECT_EQ(simulate(darker).json, fresh);
}

TEST_F(Simulating, LightEndsSomewhere) {
    for (const Json& configuration :
         {Json::object(), Json{{"base", "matched"}}, Json{{"layers", 2}}, Json{{"edition", "printed"}}}) {
        const Json shares = simulate(configuration).json["shares"];
        for (std::size_t i = 0; i < shares["surface"].size(); ++i) {
            double sum = 0.0;
            for (const auto& [name, share] : shares.items()) sum += share[i].get<double>();
            // The model's shares add up to 1 to rounding; nine of them, each of a system of hundreds of unknowns.
            EXPECT_NEAR(sum, 1.0, 1e-10) << configuration;
        }
    }
}

TEST_F(Simulating, ASpectrumOfOneHalfIsGrey) {
    // A scale of (nearly) 0 and an offset leave the perfect grey, which has L* = 116 / 2^(1/3) - 16.
    const Json colour =
        simulate({{"parameters", {{"scale", 0.01}, {"offset", 0.5}, {"melanosome_fraction", 1}}}}).json["colour"];
    const double expected_l = 116 * std::cbrt(0.5) - 16;
    // The scaled reflectance, at most 0.01, adds at most 116 (cbrt(0.51) - cbrt(0.5)).
    EXPECT_NEAR(colour["lab"][0].get<double>(), expected_l, 116 * (std::cbrt(0.51) - std::cbrt(0.5)));
    EXPECT_TRUE(colour["in_gamut"].get<bool>());
}

/// Between 525 and 620 nm: below, where the tables' lines meet, the curve is level to 1e-7.
std::vector<double> dips_nm(const Json& simulation) {
    const auto nm = simulation["wavelength_nm"].get<std::vector<double>>();
    const auto reading = simulation["reading"].get<std::vector<double>>();
    std::vector<double> dips;
    for (std::size_t i = 1; i + 1 < nm.size(); ++i) {
        const bool is_dip = reading[i] < reading[i - 1] && reading[i] < reading[i + 1];
        if (is_dip && nm[i] > 525 && nm[i] < 620) dips.push_back(nm[i]);
    }
    return dips;
}

TEST_F(Simulating, BothDipsOfOxygenatedBloodAreDrawnWhereTheyAre) {
    Json blood = {{"parameters", {{"oxygen_saturation", 0.95}, {"papillary_blood_fraction", 0.05}}}};
    const std::vector<double> drawn = dips_nm(simulate(blood).json);
    blood["wavelengths"] = "520:620:0.5";
    const std::vector<double> fine = dips_nm(simulate(blood).json);
    ASSERT_EQ(drawn.size(), 2U);
    ASSERT_EQ(fine.size(), 2U);
    // The bands at 542 and 577 nm, on either side of the gap at 560 nm [PRAHL98]; pigments with a slope move the dips.
    EXPECT_LT(drawn[0], 560);
    EXPECT_GT(drawn[1], 560);
    // A step of 2 nm, and one of 0.5 nm.
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(drawn[i], fine[i], 2.5);
}

TEST_F(Simulating, WavelengthsThatReachNoColourAreTold) {
    const Json answer = simulate({{"wavelengths", "500:600:10"}}).json;
    EXPECT_EQ(answer["reading"].size(), 11U);
    EXPECT_TRUE(answer["colour"].contains("unknown"));
}

TEST_F(Simulating, WhatCannotBeSimulatedIsAnErrorThatNamesIt) {
    const auto message = [&](const Json& configuration) {
        const Answer answer = simulate(configuration);
        EXPECT_EQ(answer.status, 400);
        return answer.json["error"].get<std::string>();
    };
    EXPECT_NE(message({{"parameters", {{"melanosom_fraction", 0.1}}}}).find("melanosome_fraction"), std::string::npos);
    EXPECT_NE(message({{"parameters", {{"melanosome_fraction", 7}}}}).find("out of range"), std::string::npos);
    EXPECT_NE(message({{"wavelengths", "400:700:0.1"}}).find("3001"), std::string::npos);
    EXPECT_NE(message({{"wavelengths", "100:700:10"}}).find("100"), std::string::npos);
    EXPECT_NE(message({{"editon", "printed"}}).find("edition"), std::string::npos);
    EXPECT_NE(message({{"viewing_cone_deg", 8}, {"specular", "included"}}).find("viewing_cone_deg"), std::string::npos);
}

}  // namespace
}  // namespace skinfit
