#include <gtest/gtest.h>

#include <cmath>

#include "fit/fit.hpp"
#include "fit/minimum.hpp"
#include "fit/uncertainty.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

struct Truth {
    const char* name;
    Skin skin;
};

const std::vector<Truth> truths = {
    {"fair", {.melanosome_fraction = 0.02, .papillary_blood_fraction = 0.02, .oxygen_saturation = 0.6}},
    {"dark, jaundiced", {.melanosome_fraction = 0.25, .reticular_blood_fraction = 0.03, .bilirubin_g_per_l = 0.9}},
    {"no bilirubin, at its bound", {.papillary_blood_fraction = 0.03, .bilirubin_g_per_l = 0.0}},
    {"full saturation, at its bound", {.melanosome_fraction = 0.03, .oxygen_saturation = 1.0}},
    {"both at their bounds", {.oxygen_saturation = 0.0, .bilirubin_g_per_l = 0.0}},
};

/// A fit from the starts of Table 1 to the noise-free spectrum of a truth.
struct RoundTrip {
    Configuration truth;
    Task task;

    explicit RoundTrip(const Skin& skin)
        : truth(with_skin(skin)), task(quick_configuration(), modelled_spectrum(truth, grid_nm(400, 700, 20))) {}

    static Configuration with_skin(const Skin& skin) {
        Configuration configuration = quick_configuration();
        configuration.values.skin = skin;
        return configuration;
    }

    [[nodiscard]] std::vector<double> true_values() const {
        std::vector<double> values;
        for (const FreeParameter& free : task.problem.free) values.push_back(value_of(truth.values, free.parameter));
        return values;
    }

    /// Norm of the residuals' derivative by positions in the unit box.
    [[nodiscard]] double steepness() const {
        const std::vector<double> slopes = unit_box_slopes(task.problem, to_unit_box(task.problem, true_values()));
        Eigen::MatrixXd jacobian = task.objective.misfit(true_values()).jacobian;
        for (Eigen::Index i = 0; i < jacobian.cols(); ++i) jacobian.col(i) *= slopes[static_cast<std::size_t>(i)];
        return jacobian.norm();
    }
};

TEST(RoundTrip, CeresFindsTheTruthToItsStepTolerance) {
    for (const Truth& truth : truths) {
        SCOPED_TRACE(truth.name);
        const RoundTrip trip(truth.skin);
        const Minimum found = minimise_by_ceres(trip.task.objective, starts(trip.task.problem));
        EXPECT_TRUE(found.converged) << found.termination;
        // Ceres stops at steps of 1e-9 of the unit box's diagonal at most; near a minimum without residuals each step
        // is shorter than half of the one before, so that less than the last is left.
        const double left = 1e-9 * std::sqrt(5.0) * trip.steepness();
        EXPECT_LT(found.chi2, left * left);
        const std::vector<double> wanted = trip.true_values();
        const std::vector<double> misses = to_unit_box(trip.task.problem, found.values);
        const std::vector<double> positions = to_unit_box(trip.task.problem, wanted);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            EXPECT_NEAR(misses[i], positions[i], 1e-9 * std::sqrt(5.0))
                << info(trip.task.problem.free[i].parameter).name;
        }
    }
}

TEST(RoundTrip, BobyqaFindsTheSameWithinATwentiethOfASigma) {
    for (const Truth& truth : truths) {
        SCOPED_TRACE(truth.name);
        const RoundTrip trip(truth.skin);
        const Minimum found = minimise_by_nlopt(trip.task.objective, Solver::bobyqa, starts(trip.task.problem));
        EXPECT_TRUE(found.converged) << found.termination;
        // No parameter can be a twentieth of its sigma off without chi2 rising by a twentieth squared.
        EXPECT_LT(found.chi2, 0.05 * 0.05);
    }
}

TEST(RoundTrip, FitSpectrumAgreesWithItsCrossCheckAndBlamesTheRaysAtMost) {
    const RoundTrip trip(truths.front().skin);
    for (const Solver solver : {Solver::ceres, Solver::bobyqa}) {
        Configuration configuration = quick_configuration();
        configuration.solver = solver;
        const FitResult result = fit_spectrum(configuration, modelled_spectrum(trip.truth, grid_nm(400, 700, 10)),
                                              {.cross_check = true, .cache = no_cache()});
        ASSERT_EQ(result.cross_check.size(), solver_count - 1);
        for (const SolverAnswer& other : result.cross_check) {
            EXPECT_NE(other.solver, solver);
            const std::optional<double> difference = largest_difference_in_sigmas(result, other.minimum);
            ASSERT_TRUE(difference);
            EXPECT_LT(*difference, 0.05);
        }
        EXPECT_EQ(result.degrees_of_freedom, 26.0);
        for (const std::string& reason : result.reasons) EXPECT_TRUE(reason.starts_with("TOO FEW RAYS")) << reason;
    }
}

TEST(RoundTrip, OneFreeParameterIsFoundByBothSolvers) {
    Configuration truth = quick_configuration();
    truth.values.skin.melanosome_fraction = 0.1;
    const Task task(with_free(quick_configuration(), {Parameter::melanosome_fraction}),
                    modelled_spectrum(truth, grid_nm(400, 700, 20)));
    const Minimum ceres = minimise_by_ceres(task.objective, starts(task.problem));
    const Minimum bobyqa = minimise_by_nlopt(task.objective, Solver::bobyqa, starts(task.problem));
    EXPECT_TRUE(ceres.converged);
    EXPECT_TRUE(bobyqa.converged);
    EXPECT_NEAR(ceres.values[0], 0.1, 1e-9);
    EXPECT_LT(bobyqa.chi2, 0.05 * 0.05);
}

TEST(Minimise, DoesNotMoveFromTheMinimum) {
    const RoundTrip trip(truths.front().skin);
    const Minimum first = minimise_by_ceres(trip.task.objective, starts(trip.task.problem));
    const Minimum again = minimise_by_ceres(trip.task.objective, first.values);
    EXPECT_TRUE(again.converged);
    EXPECT_LE(again.chi2, first.chi2);
    EXPECT_LE(again.evaluations, 3);
}

TEST(UnitBox, GoesThereAndBackAndHitsTheBoundsExactly) {
    const RoundTrip trip(truths.front().skin);
    const FitProblem& problem = trip.task.problem;
    const std::vector<double> upper = from_unit_box(problem, std::vector<double>(problem.free.size(), 1.0));
    const std::vector<double> lower = from_unit_box(problem, std::vector<double>(problem.free.size(), 0.0));
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        EXPECT_EQ(upper[i], problem.free[i].bounds.upper);
        EXPECT_EQ(lower[i], problem.free[i].bounds.lower);
    }
}

}  // namespace
}  // namespace skinfit::test
