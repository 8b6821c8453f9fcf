#include "fit/band_sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fit/models.hpp"
#include "fit/objective.hpp"
#include "fit/problem.hpp"
#include "model/angular_solver.hpp"

namespace skinfit {
namespace {

constexpr std::array shapes = {BandpassShape::triangular, BandpassShape::gaussian, BandpassShape::rectangular};

/// The density of the band, by its definition.
double density(const Bandpass& band, double distance_nm) {
    const double x = std::abs(distance_nm) / band.width_nm;
    switch (band.shape) {
        case BandpassShape::triangular:
            return std::max(0.0, 1.0 - x) / band.width_nm;
        case BandpassShape::rectangular:
            return x < 0.5 ? 1.0 / band.width_nm : 0.0;
        default:
            return std::exp2(-4.0 * x * x) * std::sqrt(4.0 * std::numbers::ln2 / std::numbers::pi) / band.width_nm;
    }
}

/// The variance of the band per squared width.
double variance(BandpassShape shape) {
    switch (shape) {
        case BandpassShape::triangular:
            return 1.0 / 6.0;
        case BandpassShape::rectangular:
            return 1.0 / 12.0;
        default:
            return 1.0 / (8.0 * std::numbers::ln2);
    }
}

Eigen::VectorXd of(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

TEST(BandSampling, WithoutWidthChangesNothing) {
    const std::vector<double> centres_nm = {400, 401.3, 433, 500};
    for (const std::optional<Bandpass>& none : {std::optional<Bandpass>(), std::optional(Bandpass{})}) {
        const BandSampling sampling = sample_bands(centres_nm, none);
        EXPECT_EQ(sampling.wavelength_nm, centres_nm);
        EXPECT_EQ(sampling.weights.rows(), 0);
        EXPECT_EQ(sampling.readings(of(centres_nm)), of(centres_nm));
    }
}

TEST(BandSampling, KeepsConstantsAndLinesOnAnyGrid) {
    const std::vector<double> centres_nm = {400, 401.3, 433, 500.7, 503};
    for (const BandpassShape shape : shapes) {
        for (const double width_nm : {0.1, 1.7, 5.0, 10.0, 33.0}) {
            const BandSampling sampling = sample_bands(centres_nm, Bandpass{.shape = shape, .width_nm = width_nm});
            EXPECT_TRUE(std::ranges::is_sorted(sampling.wavelength_nm));
            const Eigen::VectorXd ones =
                Eigen::VectorXd::Ones(static_cast<Eigen::Index>(sampling.wavelength_nm.size()));
            // The rounding of differences of excesses as large as the reach of the band.
            EXPECT_LT((sampling.readings(ones).array() - 1).abs().maxCoeff(), 1e-13);
            EXPECT_LT((sampling.readings(of(sampling.wavelength_nm)) - of(centres_nm)).cwiseAbs().maxCoeff(), 1e-10);
        }
    }
}

TEST(BandSampling, WidensAParabolaByTheVarianceOfBandAndStep) {
    // (x - c)^2 integrates to the variance of the band; the line between two nodes lies above it by a sixth of the
    // squared step, on average over a step. These bands end at nodes, so that is exact but for the truncated tails of
    // the gaussian: 4e-9 of it, at squared distances of a few hundred.
    for (const BandpassShape shape : shapes) {
        for (const double width_nm : {8.0, 12.0}) {
            const BandSampling sampling = sample_bands({500}, Bandpass{.shape = shape, .width_nm = width_nm});
            const Eigen::VectorXd parabola = (of(sampling.wavelength_nm).array() - 500).square();
            const double expected = variance(shape) * width_nm * width_nm;
            EXPECT_NEAR(sampling.readings(parabola)[0], expected + 2.0 / 3.0, 5e-6) << static_cast<int>(shape);
        }
    }
}

/// The reading of a band by brute force: the midpoint rule at a tenth of a nanometre.
double dense(const AngularSolver& solver, const Bandpass& band, double centre_nm) {
    constexpr double step_nm = 0.1;
    const double reach_nm = band.shape == BandpassShape::gaussian ? 2.5 * band.width_nm : band.width_nm;
    double sum = 0;
    double weight = 0;
    for (double x = -reach_nm + step_nm / 2; x < reach_nm; x += step_nm) {
        const double here = density(band, x);
        if (here == 0.0) continue;
        sum += here * solver.shares(centre_nm + x).viewed.share;
        weight += here;
    }
    return sum / weight;
}

TEST(BandSampling, IsWithinATenthOfTheNoiseOfTheDenseIntegral) {
    constexpr double accuracy = 6e-4;  // of 0.006 [COOKSEY17]
    Experiment experiment;
    experiment.incidence_rad = 0.14;
    experiment.values.skin.papillary_blood_fraction = 0.02;
    experiment.values.skin.reticular_blood_fraction = 0.02;
    experiment.values.skin.melanosome_fraction = 0.01;
    for (const double saturation : {0.2, 0.5, 0.98}) {
        experiment.values.skin.oxygen_saturation = saturation;
        const AngularSolver solver = angular_solver(experiment, AngularResolution::for_accuracy(1e-3));
        for (const Bandpass& band : {Bandpass{.shape = BandpassShape::triangular, .width_nm = 5},
                                     Bandpass{.shape = BandpassShape::triangular, .width_nm = 10},
                                     Bandpass{.shape = BandpassShape::rectangular, .width_nm = 10}}) {
            for (const double centre_nm : {415.0, 453.0, 541.0, 560.0, 577.0, 592.5}) {  // where haemoglobin bends most
                const BandSampling sampling = sample_bands({centre_nm}, band);
                std::vector<double> modelled;
                for (const double at_nm : sampling.wavelength_nm) modelled.push_back(solver.shares(at_nm).viewed.share);
                EXPECT_NEAR(sampling.readings(of(modelled))[0], dense(solver, band, centre_nm), accuracy)
                    << centre_nm << " nm, width " << band.width_nm << ", saturation " << saturation;
            }
        }
    }
}

Spectrum flat_spectrum() {
    Spectrum spectrum;
    spectrum.name = spectrum.source = "made";
    for (double at_nm = 530; at_nm <= 560; at_nm += 5) {
        spectrum.wavelength_nm.push_back(at_nm);
        spectrum.value.push_back(0.2 + 1e-4 * at_nm);
    }
    return spectrum;
}

FitProblem problem_with(Engine engine, std::optional<double> width_nm) {
    Configuration configuration = default_configuration();
    configuration.engine = engine;
    configuration.rays = 2000;
    configuration.free[static_cast<std::size_t>(Parameter::scale)] = true;
    configuration.bandpass_width_nm = width_nm;
    return make_problem(configuration, flat_spectrum());
}

std::vector<double> start_values(const FitProblem& problem) {
    std::vector<double> values;
    for (const FreeParameter& free : problem.free) values.push_back(free.start);
    return values;
}

class Engines : public testing::TestWithParam<Engine> {};

TEST_P(Engines, AZeroWidthChangesNoBitAndAWidthConvolvesReadingsAndDerivatives) {
    const FitProblem single = problem_with(GetParam(), std::nullopt);
    const FitProblem zero = problem_with(GetParam(), 0.0);
    const FitProblem wide = problem_with(GetParam(), 10.0);
    const DiskCache no_cache{
        .folder = std::nullopt, .warn = [](const std::string&) {}, .inform = [](const std::string&) {}};
    const Objective of_single(single, make_models(single, GetParam(), no_cache));
    const Objective of_zero(zero, make_models(zero, GetParam(), no_cache));
    const Objective of_wide(wide, make_models(wide, GetParam(), no_cache));
    const std::vector<double> values = start_values(single);
    EXPECT_EQ(of_zero.model(values).reading, of_single.model(values).reading);
    EXPECT_EQ(of_zero.model(values).jacobian, of_single.model(values).jacobian);

    const Objective::Modelled modelled = of_wide.model(values);
    EXPECT_EQ(modelled.reading.size(), 7);
    EXPECT_EQ(of_wide.readings(values), modelled.reading);
    EXPECT_GT((modelled.reading - of_single.model(values).reading).cwiseAbs().maxCoeff(), 1e-4);
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::vector<double> above = values;
        std::vector<double> below = values;
        const double step = 1e-4 * values[i];
        above[i] += step;
        below[i] -= step;
        const Eigen::VectorXd difference = (of_wide.readings(above) - of_wide.readings(below)) / (2 * step);
        const auto column = modelled.jacobian.col(static_cast<Eigen::Index>(i));
        // A central difference errs by step^2 / 6 times the third derivative, which is of the order of the first per
        // squared value; 1e-8 of the derivative then, and the rounding of two readings of order 1.
        EXPECT_LT((difference - column).cwiseAbs().maxCoeff(), 1e-6 * column.cwiseAbs().maxCoeff() + 1e-15 / step);
    }
}

INSTANTIATE_TEST_SUITE_P(All, Engines, testing::Values(Engine::paths, Engine::solver, Engine::emulator));

}  // namespace
}  // namespace skinfit
