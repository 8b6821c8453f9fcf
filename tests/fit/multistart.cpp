#include "fit/multistart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/configuration_json.hpp"
#include "fit/fit.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(FitScale, IsLogarithmicWhereItsMiddleIsBelowThatOfTheBounds) {
    FitProblem problem;
    for (const ParameterInfo& row : parameter_table()) {
        problem.free.push_back({.parameter = row.parameter, .start = row.lower, .bounds = {row.lower, row.upper}});
    }
    const std::vector<double> middles = from_unit_box(problem, std::vector<double>(problem.free.size(), 0.5));
    for (const ParameterInfo& row : parameter_table()) {
        const double middle = row.lower + 0.5 * (row.upper - row.lower);
        EXPECT_EQ(middles[static_cast<std::size_t>(row.parameter)] < middle, has_logarithmic_scale(row.parameter))
            << row.name;
    }
}

TEST(FitScale, GoesThereAndBackHitsTheBoundsAndHasTheSlopeOfItsInverse) {
    Configuration configuration = quick_configuration();
    configuration.engine = Engine::solver;
    configuration = with_freedom(configuration, "fibril_radius_nm,epidermis_thickness_cm,scale,offset", true, "test");
    const Spectrum spectrum = modelled_spectrum(quick_configuration(), grid_nm(400, 700, 20));
    const FitProblem problem = make_problem(resolved(configuration, spectrum), spectrum);
    const std::vector<double> lowest(problem.free.size(), 0.0);
    const std::vector<double> highest(problem.free.size(), 1.0);
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        const Bounds& bounds = problem.free[i].bounds;
        EXPECT_EQ(from_unit_box(problem, lowest)[i], bounds.lower);
        EXPECT_EQ(from_unit_box(problem, highest)[i], bounds.upper);
        EXPECT_EQ(to_unit_box(problem, from_unit_box(problem, lowest))[i], 0.0);
        EXPECT_EQ(to_unit_box(problem, from_unit_box(problem, highest))[i], 1.0);
    }
    for (const double position : {0.0, 0.01, 0.3, 0.7, 1.0}) {
        const std::vector<double> positions(problem.free.size(), position);
        const std::vector<double> values = from_unit_box(problem, positions);
        const std::vector<double> slopes = unit_box_slopes(problem, positions);
        constexpr double h = 1e-5;
        const std::vector<double> above = from_unit_box(problem, std::vector<double>(values.size(), position + h));
        const std::vector<double> below = from_unit_box(problem, std::vector<double>(values.size(), position - h));
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double width = problem.free[i].bounds.upper - problem.free[i].bounds.lower;
            // Rounding of a value divided by the least slope, which is a hundredth of the width.
            EXPECT_NEAR(to_unit_box(problem, values)[i], position, 1000 * epsilon);
            EXPECT_GT(slopes[i], 0.0);
            if (position == 1.0) continue;  // values end at the upper bound
            // The third derivative of the exponential is at most 6^3 times it.
            EXPECT_NEAR(slopes[i], (above[i] - below[i]) / (2 * h), 36 * h * h * slopes[i] + 4 * epsilon * width / h);
        }
    }
}

TEST(SpreadPoints, LeaveNoGapAndFollowTheSeed) {
    constexpr std::size_t count = 64;
    std::vector<double> line;
    for (const std::vector<double>& point : spread_points(count, 1, 7)) line.push_back(point[0]);
    std::ranges::sort(line);
    // Multiples of the golden ratio: three different gaps at most, the largest below 1.9 / n.
    for (std::size_t i = 1; i < count; ++i) EXPECT_LT(line[i] - line[i - 1], 1.9 / count);
    EXPECT_EQ(spread_points(5, 6, 1), spread_points(5, 6, 1));
    EXPECT_NE(spread_points(5, 6, 1), spread_points(5, 6, 2));
    // In a plane: of 64 points, one in each of 16 squares.
    std::vector<int> hits(16, 0);
    for (const std::vector<double>& point : spread_points(count, 2, 7)) {
        ++hits[static_cast<std::size_t>(4 * point[0]) * 4 + static_cast<std::size_t>(4 * point[1])];
    }
    EXPECT_GT(*std::ranges::min_element(hits), 0);
}

TEST(Solvers, AllFindTheTruthOfASpectrumWithoutNoise) {
    Configuration truth = quick_configuration();
    truth.values.skin.melanosome_fraction = 0.15;
    truth.values.skin.reticular_blood_fraction = 0.03;
    truth.values.skin.bilirubin_g_per_l = 0.4;
    const Task task(quick_configuration(), modelled_spectrum(truth, grid_nm(400, 700, 20)));
    for (std::size_t i = 0; i < solver_count; ++i) {
        const Minimum found = minimise(task.objective, static_cast<Solver>(i), starts(task.problem));
        EXPECT_TRUE(found.converged) << i << ": " << found.termination;
        // No parameter can be a twentieth of its sigma off without the cost rising by a twentieth squared.
        EXPECT_LT(found.cost, 0.05 * 0.05) << i << ": " << found.termination;
    }
}

TEST(Solvers, AFlatDirectionIsConvergence) {
    // Only the product of melanosomes and their melanins shows.
    const Configuration configuration =
        with_free(quick_configuration(),
                  {Parameter::melanosome_fraction, Parameter::eumelanin_g_per_l, Parameter::pheomelanin_g_per_l});
    Configuration truth = configuration;
    truth.values.skin.melanosome_fraction = 0.1;
    const Task task(configuration, modelled_spectrum(truth, grid_nm(400, 700, 20)));
    for (std::size_t i = 0; i < solver_count; ++i) {
        const Minimum found = minimise(task.objective, static_cast<Solver>(i), starts(task.problem));
        EXPECT_TRUE(found.converged) << i << ": " << found.termination;
    }
}

TEST(ExpectedGain, IsZeroAtAMinimumAndThePossibleFallElsewhere) {
    Configuration truth = quick_configuration();
    truth.values.instrument.offset = 0.01;
    const Task task(with_free(quick_configuration(), {Parameter::offset}),
                    modelled_spectrum(truth, grid_nm(400, 700, 20)));
    // Linear in the offset, and the box is far wider than sigma: the whole cost can fall away.
    const auto gain = [&task](double offset) {
        const std::vector<double> values = {offset};
        return expected_gain(task.problem, task.objective.misfit(values), values);
    };
    const double cost = task.objective.misfit(std::vector{0.0}).cost();
    const double width_in_sigmas = 0.2 / 0.006 * 4.0;  // sixteen wavelengths
    EXPECT_NEAR(gain(0.0), cost, cost / (width_in_sigmas * width_in_sigmas));
    EXPECT_LT(gain(0.01), 1e-20);
}

TEST(DistinctMinima, EverySearchEndsWhereThereIsOneMinimum) {
    const Configuration configuration = quick_configuration();
    const Task task(configuration, modelled_spectrum(configuration, grid_nm(400, 700, 10)));
    const Searches searches = distinct_minima(task.objective, task.objective, Solver::ceres, 6);
    EXPECT_EQ(searches.starts, 6U);
    EXPECT_EQ(searches.rough_minima, 1U);
    EXPECT_EQ(searches.finished, 1U);
    ASSERT_EQ(searches.minima.size(), 1U);
    EXPECT_EQ(searches.minima[0].searches, 6);
    EXPECT_LT(searches.minima[0].minimum.cost, 1e-6);
}

TEST(DistinctMinima, SayHowManyWereLeftOut) {
    const Configuration configuration = quick_configuration();
    const Task task(configuration, modelled_spectrum(configuration, grid_nm(400, 700, 10)));
    // Searches that may not take a step end where they start, and so at as many places.
    const Searches searches =
        distinct_minima(task.objective, task.objective, Solver::bobyqa, 9, {.cheap_evaluations = 1, .evaluations = 1});
    EXPECT_EQ(searches.starts, 9U);
    EXPECT_EQ(searches.rough_minima, 9U);
    EXPECT_EQ(searches.finished, most_finished);
    EXPECT_LE(searches.minima.size(), most_finished);
}

TEST(DistinctMinima, DoNotDependOnTheStart) {
    Configuration configuration = quick_configuration();
    configuration.engine = Engine::solver;
    configuration.noise = 0.003;
    configuration = with_freedom(configuration, "fibril_radius_nm", true, "test");
    Spectrum spectrum = modelled_spectrum(quick_configuration(), grid_nm(400, 700, 25));
    const std::vector<double> noise = normal_numbers(3, spectrum.value.size());
    for (std::size_t i = 0; i < noise.size(); ++i) spectrum.value[i] += 0.003 * noise[i];
    const double cost = fit_spectrum(configuration, spectrum, {.cache = no_cache()}).cost;
    configuration.values.skin.fibril_radius_nm = 12.0;
    EXPECT_NEAR(fit_spectrum(configuration, spectrum, {.cache = no_cache()}).cost, cost, 1e-3);
}

}  // namespace
}  // namespace skinfit::test
