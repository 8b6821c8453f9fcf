#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "fit/minimum.hpp"
#include "fit/uncertainty.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

Minimum at(std::vector<double> values) {
    return {.values = std::move(values), .chi2 = 0.0, .evaluations = 0, .converged = true, .termination = ""};
}

TEST(Uncertainty, IsTheInverseOfTheNormalMatrix) {
    const Configuration truth = inner_truth(0.001);
    const Task task(truth, modelled_spectrum(truth, grid_nm(400, 700, 10)));
    const Minimum minimum = at(starts(task.problem));
    const Uncertainty uncertainty = estimate_uncertainty(task.objective, minimum);
    // The normal equations by Cholesky's method, where the library decomposes the Jacobian by singular values.
    const Eigen::MatrixXd jacobian = task.objective.model(minimum.values).jacobian / truth.noise.value();
    const Eigen::VectorXd norms = jacobian.colwise().norm();
    const Eigen::MatrixXd equal_columns = jacobian * norms.cwiseInverse().asDiagonal();
    const Eigen::MatrixXd normal = equal_columns.transpose() * equal_columns;
    const Eigen::MatrixXd inverse = normal.ldlt().solve(Eigen::MatrixXd::Identity(5, 5));
    // An inverse is right to the condition number in roundings; both scalings have about the same one.
    const Eigen::VectorXd eigenvalues = normal.selfadjointView<Eigen::Lower>().eigenvalues();
    const double error = 100 * std::numeric_limits<double>::epsilon() * eigenvalues.maxCoeff() / eigenvalues.minCoeff();
    ASSERT_LT(error, 1e-6);
    for (Eigen::Index a = 0; a < 5; ++a) {
        const ParameterUncertainty& found = uncertainty.parameters[static_cast<std::size_t>(a)];
        ASSERT_EQ(found.status, Status::free);
        EXPECT_NEAR(*found.sigma / (std::sqrt(inverse(a, a)) / norms[a]), 1.0, error);
        for (Eigen::Index b = 0; b < 5; ++b) {
            EXPECT_NEAR(uncertainty.correlation(a, b), inverse(a, b) / std::sqrt(inverse(a, a) * inverse(b, b)), error);
        }
    }
}

TEST(Uncertainty, ScalesWithTheNoise) {
    Configuration truth = inner_truth(0.001);
    const Spectrum spectrum = modelled_spectrum(truth, grid_nm(400, 700, 10));
    const Task task(truth, spectrum);
    truth.noise = 0.5 * truth.noise.value();
    const Task half(truth, spectrum);
    const Uncertainty whole = estimate_uncertainty(task.objective, at(starts(task.problem)));
    const Uncertainty halved = estimate_uncertainty(half.objective, at(starts(half.problem)));
    for (std::size_t i = 0; i < whole.parameters.size(); ++i) {
        // The two decompositions round differently: the condition number, below 1e6, in roundings.
        EXPECT_NEAR(*halved.parameters[i].sigma / *whole.parameters[i].sigma, 0.5, 1e-9);
        // What the finite number of rays does to the fit has nothing to do with the noise.
        EXPECT_NEAR(*halved.parameters[i].monte_carlo_sigma / *whole.parameters[i].monte_carlo_sigma, 1.0, 1e-9);
    }
}

TEST(Uncertainty, IntervalIs196SigmaCutAtTheBounds) {
    const Configuration truth = inner_truth(0.001);
    const Task task(truth, modelled_spectrum(truth, grid_nm(400, 700, 10)));
    const Minimum minimum = at(starts(task.problem));
    const Uncertainty uncertainty = estimate_uncertainty(task.objective, minimum);
    for (std::size_t i = 0; i < minimum.values.size(); ++i) {
        const ParameterUncertainty& found = uncertainty.parameters[i];
        const Bounds& bounds = task.problem.free[i].bounds;
        const double reach = 1.959963984540054 * *found.sigma;  // 97.5 % quantile of the normal distribution
        const double rounding = 1e-6 * reach;                   // of the quantile in the library, seven digits
        EXPECT_NEAR(found.interval_95.lower, std::max(bounds.lower, minimum.values[i] - reach), rounding);
        EXPECT_NEAR(found.interval_95.upper, std::min(bounds.upper, minimum.values[i] + reach), rounding);
    }
}

void expect_not_identifiable(const Task& task, const Minimum& minimum, Parameter parameter) {
    const Uncertainty uncertainty = estimate_uncertainty(task.objective, minimum);
    for (std::size_t i = 0; i < task.problem.free.size(); ++i) {
        const ParameterUncertainty& found = uncertainty.parameters[i];
        if (task.problem.free[i].parameter != parameter) {
            EXPECT_EQ(found.status, Status::free) << info(task.problem.free[i].parameter).name;
            continue;
        }
        EXPECT_EQ(found.status, Status::not_identifiable);
        EXPECT_FALSE(found.sigma);
        EXPECT_FALSE(found.monte_carlo_sigma);
        EXPECT_EQ(found.interval_95.lower, task.problem.free[i].bounds.lower);
        EXPECT_EQ(found.interval_95.upper, task.problem.free[i].bounds.upper);
    }
}

TEST(Uncertainty, BloodBelowASeparatedEpidermisIsNotIdentifiable) {
    Configuration configuration =
        with_free(quick_configuration(), {Parameter::melanosome_fraction, Parameter::reticular_blood_fraction});
    configuration.layers = 2;
    configuration.quantity = Quantity::transmittance;
    const Task task(configuration, modelled_spectrum(configuration, grid_nm(400, 700, 20)));
    expect_not_identifiable(task, at(starts(task.problem)), Parameter::reticular_blood_fraction);
    // Nor does it become a parameter "at its bound" by starting there.
    expect_not_identifiable(task, at({0.05, 0.0}), Parameter::reticular_blood_fraction);
}

TEST(Uncertainty, CaroteneIsNotIdentifiableWhereItDoesNotAbsorb) {
    const Configuration configuration =
        with_free(quick_configuration(), {Parameter::melanosome_fraction, Parameter::dermis_carotene_g_per_l});
    const Task task(configuration, modelled_spectrum(configuration, grid_nm(600, 700, 5)));
    expect_not_identifiable(task, at(starts(task.problem)), Parameter::dermis_carotene_g_per_l);
}

TEST(Uncertainty, TwinParametersAreNotIdentifiableTogetherAndShowTheirCorrelation) {
    // Eumelanin and pheomelanin in proportion to the melanosomes: only the product shows.
    const Configuration configuration =
        with_free(quick_configuration(),
                  {Parameter::melanosome_fraction, Parameter::eumelanin_g_per_l, Parameter::pheomelanin_g_per_l});
    const Task task(configuration, modelled_spectrum(configuration, grid_nm(400, 700, 10)));
    const Uncertainty uncertainty = estimate_uncertainty(task.objective, at(starts(task.problem)));
    EXPECT_LT(uncertainty.correlation(0, 1), -0.9);
    EXPECT_EQ(uncertainty.parameters[2].status, Status::not_identifiable);
}

/// A spectrum that pushes bilirubin below zero, by up to one sigma of the noise.
struct Pushed {
    Configuration configuration;
    Spectrum spectrum;
};

constexpr std::size_t bilirubin = 4;  // position among the five free parameters

Pushed pushed_below_zero(double noise) {
    Configuration truth = inner_truth(0.001);
    truth.values.skin.bilirubin_g_per_l = 0.0;
    truth.noise = noise;
    Pushed pushed{truth, modelled_spectrum(truth, grid_nm(400, 700, 20))};
    const Task task(truth, pushed.spectrum);
    const Eigen::VectorXd column = task.objective.model(starts(task.problem)).jacobian.col(bilirubin);
    for (std::size_t i = 0; i < pushed.spectrum.value.size(); ++i) {
        pushed.spectrum.value[i] -= noise * column[static_cast<Eigen::Index>(i)] / column.cwiseAbs().maxCoeff();
    }
    return pushed;
}

TEST(Uncertainty, AtABoundThereIsAnIntervalAndNoSigma) {
    const Pushed pushed = pushed_below_zero(0.001);
    const Task task(pushed.configuration, pushed.spectrum);
    const Minimum minimum = minimise_by_ceres(task.objective, starts(task.problem));
    ASSERT_TRUE(minimum.converged);
    EXPECT_EQ(minimum.values[bilirubin], 0.0);
    const Uncertainty uncertainty = estimate_uncertainty(task.objective, minimum);
    const ParameterUncertainty& found = uncertainty.parameters[bilirubin];
    EXPECT_EQ(found.status, Status::at_lower_bound);
    EXPECT_FALSE(found.sigma);
    EXPECT_FALSE(found.monte_carlo_sigma);
    EXPECT_EQ(found.interval_95.lower, 0.0);
    EXPECT_GT(found.interval_95.upper, 0.0);
    EXPECT_LT(found.interval_95.upper, 3.0);
    for (std::size_t i = 0; i < bilirubin; ++i) {
        EXPECT_EQ(uncertainty.parameters[i].status, Status::free);
        EXPECT_EQ(uncertainty.correlation(static_cast<Eigen::Index>(i), bilirubin), 0.0);
    }
}

/// How much chi2 rises when bilirubin is fixed at the end of its interval and the others fitted again.
double rise_at_limit(double noise) {
    const Pushed pushed = pushed_below_zero(noise);
    const Task task(pushed.configuration, pushed.spectrum);
    const Minimum minimum = minimise_by_ceres(task.objective, starts(task.problem));
    const Uncertainty uncertainty = estimate_uncertainty(task.objective, minimum);
    EXPECT_EQ(uncertainty.parameters[bilirubin].status, Status::at_lower_bound);
    Configuration held = pushed.configuration;
    held.free[static_cast<std::size_t>(Parameter::bilirubin_g_per_l)] = false;
    held.values.skin.bilirubin_g_per_l = uncertainty.parameters[bilirubin].interval_95.upper;
    const Task again(held, pushed.spectrum);
    return minimise_by_ceres(again.objective, starts(again.problem)).chi2 - minimum.chi2;
}

TEST(Uncertainty, AtTheOneSidedLimitChi2HasRisenBy271AsNoiseFalls) {
    // The limit is right for a model without curvature. Its distance shrinks with the noise, and the share of the
    // curvature in the rise with it: at a tenth of the noise a tenth of the error is left; a fifth allows for the next
    // order.
    const double rise = 1.6448536269514722 * 1.6448536269514722;  // 95 % quantile of the normal distribution, squared
    double error = std::abs(rise_at_limit(1e-3) - rise);
    EXPECT_LT(error, 1.0);
    for (const double noise : {1e-4, 1e-5}) {
        const double next = std::abs(rise_at_limit(noise) - rise);
        EXPECT_LT(next, error / 5);
        error = next;
    }
}

TEST(Uncertainty, MonteCarloErrorOfAnOffsetIsThatOfTheMeanReadingOverTheBatches) {
    const Configuration truth = with_free(quick_configuration(), {Parameter::offset});
    const Task task(truth, modelled_spectrum(truth, grid_nm(400, 700, 10)));
    const Minimum minimum = at(starts(task.problem));
    // With equal noise an offset is the mean difference from the readings: each batch says what its mean does.
    const Eigen::VectorXd means = task.objective.batch_readings(minimum.values).colwise().mean().transpose();
    const auto batches = static_cast<double>(means.size());
    const double squares = (means.array() - means.mean()).square().sum();
    const double found = *estimate_uncertainty(task.objective, minimum).parameters.front().monte_carlo_sigma;
    EXPECT_NEAR(found / std::sqrt(squares / (batches * (batches - 1.0))), 1.0, 1e-9);
}

TEST(Uncertainty, UpperBoundsWorkLikeLowerOnes) {
    Configuration truth = inner_truth(0.001);
    truth.values.skin.oxygen_saturation = 1.0;
    Spectrum spectrum = modelled_spectrum(truth, grid_nm(400, 700, 10));
    {
        const Task task(truth, spectrum);
        const Eigen::VectorXd column = task.objective.model(starts(task.problem)).jacobian.col(3);
        for (std::size_t i = 0; i < spectrum.value.size(); ++i) {
            spectrum.value[i] += 0.1 * column[static_cast<Eigen::Index>(i)];
        }
    }
    const Task task(truth, spectrum);
    const Minimum minimum = minimise_by_ceres(task.objective, starts(task.problem));
    const Uncertainty uncertainty = estimate_uncertainty(task.objective, minimum);
    EXPECT_EQ(minimum.values[3], 1.0);
    EXPECT_EQ(uncertainty.parameters[3].status, Status::at_upper_bound);
    EXPECT_EQ(uncertainty.parameters[3].interval_95.upper, 1.0);
    EXPECT_LT(uncertainty.parameters[3].interval_95.lower, 1.0);
}

}  // namespace
}  // namespace skinfit::test
