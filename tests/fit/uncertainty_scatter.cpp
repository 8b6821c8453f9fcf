#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "fit/minimum.hpp"
#include "fit/uncertainty.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit::test {
namespace {

/// The smaller tail of a chi-square statistic, doubled: too much and too little scatter both show.
double two_tailed(double statistic, double degrees_of_freedom) {
    const double upper = chi_square_p_value(statistic, degrees_of_freedom);
    return 2.0 * std::min(upper, 1.0 - upper);
}

Eigen::VectorXd sigmas_of(const Uncertainty& uncertainty, std::optional<double> ParameterUncertainty::*which) {
    Eigen::VectorXd sigmas(static_cast<Eigen::Index>(uncertainty.parameters.size()));
    for (Eigen::Index i = 0; i < sigmas.size(); ++i) {
        sigmas[i] = (uncertainty.parameters[static_cast<std::size_t>(i)].*which).value_or(std::nan(""));
    }
    return sigmas;
}

Eigen::VectorXd as_vector(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

TEST(UncertaintyScatter, SigmaIsTheScatterOfFitsToNoisySpectra) {
    const Configuration truth = inner_truth(0.0005);
    Task task(truth, modelled_spectrum(truth, grid_nm(400, 700, 20)));
    const std::vector<double> clean = task.problem.only().measured;
    const std::vector<double> true_values = starts(task.problem);
    constexpr std::size_t spectra = 200;
    const std::vector<double> noise = normal_numbers(20, spectra * clean.size());
    Eigen::VectorXd each = Eigen::VectorXd::Zero(5);  // squared misses in sigmas, of each parameter
    double together = 0.0;                            // squared misses by the whole covariance
    for (std::size_t k = 0; k < spectra; ++k) {
        for (std::size_t i = 0; i < clean.size(); ++i) {
            task.problem.only().measured[i] = clean[i] + truth.noise.value() * noise[k * clean.size() + i];
        }
        const Minimum minimum = minimise_by_ceres(task.objective, true_values);
        const Uncertainty uncertainty = estimate_uncertainty(task.objective, minimum);
        const Eigen::VectorXd misses = (as_vector(minimum.values) - as_vector(true_values))
                                           .cwiseQuotient(sigmas_of(uncertainty, &ParameterUncertainty::sigma));
        each += misses.cwiseAbs2();
        together += misses.dot(uncertainty.correlation.ldlt().solve(misses));
    }
    for (const double statistic : each) {
        EXPECT_GT(two_tailed(statistic, spectra), passing_p_value);
        // Sigmas a third too small are noticed.
        EXPECT_LT(two_tailed(statistic * 1.5 * 1.5, spectra), passing_p_value);
    }
    EXPECT_GT(two_tailed(together, 5 * spectra), passing_p_value);
    EXPECT_LT(two_tailed(together * 1.2 * 1.2, 5 * spectra), passing_p_value);
}

TEST(UncertaintyScatter, MonteCarloSigmaIsTheScatterOfFitsOverSeeds) {
    Configuration configuration =
        with_free(inner_truth(0.0005),
                  {Parameter::melanosome_fraction, Parameter::papillary_blood_fraction, Parameter::oxygen_saturation});
    const Spectrum spectrum = modelled_spectrum(configuration, grid_nm(400, 700, 20));
    constexpr int seeds = 80;
    Eigen::MatrixXd fits(3, seeds);
    Eigen::VectorXd variance = Eigen::VectorXd::Zero(3);
    for (int seed = 0; seed < seeds; ++seed) {
        configuration.seed = 100 + static_cast<std::uint64_t>(seed);
        const Task task(configuration, spectrum);
        const Minimum minimum = minimise_by_ceres(task.objective, starts(task.problem));
        const Uncertainty uncertainty = estimate_uncertainty(task.objective, minimum);
        fits.col(seed) = as_vector(minimum.values);
        variance += sigmas_of(uncertainty, &ParameterUncertainty::monte_carlo_sigma).cwiseAbs2() / seeds;
    }
    fits.colwise() -= Eigen::VectorXd(fits.rowwise().mean());
    for (Eigen::Index i = 0; i < 3; ++i) {
        // The mean of 80 variances from 32 batches each has 2480 degrees of freedom: as good as known against 79.
        const double statistic = fits.row(i).squaredNorm() / variance[i];
        EXPECT_GT(two_tailed(statistic, seeds - 1), passing_p_value);
        // Half or double the true sigma is noticed.
        EXPECT_LT(two_tailed(statistic * 4.0, seeds - 1), passing_p_value);
        EXPECT_LT(two_tailed(statistic / 4.0, seeds - 1), passing_p_value);
    }
}

}  // namespace
}  // namespace skinfit::test
