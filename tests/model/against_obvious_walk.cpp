#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/constants.hpp"
#include "model/random_walk.hpp"
#include "tests/model/obvious_walk.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit {
namespace {

const std::vector<double> wavelengths_nm = {440, 546, 660};

test::RayleighRule rule_of(Edition edition) {
    return edition == Edition::printed ? test::RayleighRule::until_bounced : test::RayleighRule::downward;
}

/// Every fate of a ray in the two walks, as a z each.
std::vector<double> compare(const WalkCounts& fast, const test::ObviousCounts& plain, std::uint64_t plain_rays) {
    const auto z = [&](std::uint64_t a, std::uint64_t b) {
        return test::z_between(test::Count{a, fast.rays}, test::Count{b, plain_rays});
    };
    std::vector<double> all = {z(fast.surface_reflected, plain.surface), z(fast.subsurface_reflected, plain.subsurface),
                               z(fast.transmitted, plain.transmitted)};
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
        all.push_back(z(fast.absorbed[layer], plain.absorbed[layer]));
    }
    return all;
}

struct Comparison {
    Sample walked;   ///< by `random_walk`
    Sample obvious;  ///< by the reference
    test::RayleighRule rule;
    double incidence_deg;
    std::uint64_t rays;
};

double p_value(const Comparison& comparison) {
    const double incidence_rad = comparison.incidence_deg * rad_per_deg;
    const std::vector<WalkCounts> spectrum = random_walk(
        comparison.walked, wavelengths_nm, {.incidence_rad = incidence_rad, .rays = 2 * comparison.rays, .seed = 31});
    std::vector<double> z;
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        const test::ObviousCounts plain = test::obvious_walk({.sample = comparison.obvious,
                                                              .wavelength_nm = wavelengths_nm[i],
                                                              .incidence_rad = incidence_rad,
                                                              .rays = comparison.rays,
                                                              .seed = 5 + i,
                                                              .rule = comparison.rule});
        const std::vector<double> fates = compare(spectrum[i], plain, comparison.rays);
        z.insert(z.end(), fates.begin(), fates.end());
    }
    return test::family_wise_p_value(z);
}

struct Case {
    std::string name;
    Sample sample;
};

class AgainstObviousWalk : public testing::TestWithParam<Case> {};

TEST_P(AgainstObviousWalk, EveryFateIsAsProbable) {
    const Sample& sample = GetParam().sample;
    for (const double incidence_deg : {0.0, 45.0, 80.0}) {
        EXPECT_GT(p_value({sample, sample, rule_of(sample.edition), incidence_deg, 200'000}), test::passing_p_value)
            << incidence_deg;
    }
}

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        const std::string name = edition == Edition::printed ? "printed" : "revised";
        all.push_back({name + "_table1", {.skin = {}, .edition = edition, .base = {}}});
        all.push_back({name + "_separated_layers_in_air",
                       {.skin = {}, .edition = edition, .layers = 2, .base = {Base::Kind::index, 1.0}}});
        all.push_back({name + "_matched_base", {.skin = {}, .edition = edition, .base = {Base::Kind::matched}}});
        all.push_back({name + "_base_index_1_44", {.skin = {}, .edition = edition, .base = {Base::Kind::index, 1.44}}});
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(All, AgainstObviousWalk, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

/// Little pigment, so that the dermis decides.
Sample light_skin(Edition edition) {
    Sample sample{.skin = {}, .edition = edition, .base = {Base::Kind::matched}};
    sample.skin.melanosome_fraction = 0.01;
    return sample;
}

TEST(AgainstObviousWalkPerturbed, FibrilsOneNanometreThickerAreSeen) {
    const Sample sample = light_skin(Edition::revised);
    Sample thicker = sample;
    thicker.skin.fibril_radius_nm = 26;
    EXPECT_LT(p_value({sample, thicker, test::RayleighRule::downward, 0, 500'000}), test::passing_p_value);
}

TEST(AgainstObviousWalkPerturbed, TheOtherRayleighRuleIsSeen) {
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        const Sample sample = light_skin(edition);
        const test::RayleighRule other =
            edition == Edition::printed ? test::RayleighRule::downward : test::RayleighRule::until_bounced;
        EXPECT_LT(p_value({sample, sample, other, 0, 200'000}), test::passing_p_value);
    }
}

}  // namespace
}  // namespace skinfit
