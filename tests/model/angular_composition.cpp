#include "model/angular_composition.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "model/angular_solver.hpp"
#include "model/chromophores.hpp"
#include "tests/model/angular_samples.hpp"

namespace skinfit::test {
namespace {

class EveryComposition : public testing::TestWithParam<AngularCase> {};

TEST_P(EveryComposition, HasTheSharesOfTheSolverAtAnyPigments) {
    const AngularCase& angular_case = GetParam();
    const AngularSolver solver(angular_case.sample, {.incidence_rad = angular_case.incidence_rad});
    constexpr double wavelength_nm = 430;
    const AngularComposition composition = solver.composition(wavelength_nm);
    for (const double factor : {0.0, 0.3, 1.0, 8.0}) {
        Skin skin = angular_case.sample.skin;
        skin.melanosome_fraction *= factor;
        skin.papillary_blood_fraction *= 2.0 * factor;
        skin.reticular_blood_fraction *= 3.0 * factor;
        const AngularResponse expected = solver.with(skin).shares(wavelength_nm);
        const PerLayer<double> depth = optical_depth(skin, Extinction::at(wavelength_nm, angular_case.sample.edition));
        const std::vector<UpperDepths> upper = {{depth[0], depth[1]}};
        const std::vector<LowerDepths> lower = {{depth[2], depth[3]}};
        // Two eliminations of the same system, whose condition is moderate: rounding of some hundred unknowns.
        constexpr double rounding = 1e-12;
        EXPECT_NEAR(composition.shares(upper, lower, Heading::up)(0, 0), expected.reflected.share, rounding);
        EXPECT_NEAR(composition.shares(upper, lower, Heading::down)(0, 0), expected.transmitted.share, rounding);
    }
}

INSTANTIATE_TEST_SUITE_P(Angular, EveryComposition, testing::ValuesIn(all_angular_cases()), case_name);

}  // namespace
}  // namespace skinfit::test
