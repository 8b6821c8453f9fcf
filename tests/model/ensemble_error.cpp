#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/chromophores.hpp"
#include "model/constants.hpp"
#include "model/path_ensemble.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit {
namespace {

const Sample thin_skin{.skin = {}, .base = {Base::Kind::matched}};

std::vector<PerLayer<double>> depths_at(const std::vector<double>& wavelengths_nm) {
    std::vector<PerLayer<double>> depths;
    for (const double wavelength_nm : wavelengths_nm) {
        depths.push_back(optical_depth(thin_skin.skin, Extinction::at(wavelength_nm, thin_skin.edition)));
    }
    return depths;
}

TEST(PathEnsembleError, AgreesWithTheAnalogWalk) {
    const std::vector<double> wavelengths_nm = {450, 546, 700};
    const WalkOptions options{.incidence_rad = 0.8, .rays = 500'000, .seed = 12};
    WalkOptions other_rays = options;
    other_rays.seed = 13;
    const PathEnsemble ensemble = PathEnsemble::trace(thin_skin, wavelengths_nm, options);
    const std::vector<EnsembleResponse> responses = ensemble.respond(depths_at(wavelengths_nm));
    const std::vector<WalkCounts> walked = random_walk(thin_skin, wavelengths_nm, other_rays);
    const auto p_value = [&](double scale) {
        std::vector<double> z;
        for (std::size_t w = 0; w < wavelengths_nm.size(); ++w) {
            const Escape& top = responses[w][Side::top];
            const Escape& bottom = responses[w][Side::bottom];
            z.push_back(test::z_between(test::Estimate{scale * top.share, top.standard_error},
                                        test::share_of(walked[w].subsurface_reflected, options.rays)));
            z.push_back(test::z_between(test::Estimate{scale * bottom.share, bottom.standard_error},
                                        test::share_of(walked[w].transmitted, options.rays)));
        }
        return test::family_wise_p_value(z);
    };
    EXPECT_GT(p_value(1.0), test::passing_p_value);
    EXPECT_LT(p_value(1.03), test::passing_p_value) << "shares 3 % too high pass";
}

/// The sum over seeds of ((share - mean) / standard error)^2: a chi-square variable if the standard error is honest.
double scatter(const std::vector<Escape>& escapes) {
    double mean = 0.0;
    for (const Escape& escape : escapes) mean += escape.share / static_cast<double>(escapes.size());
    double sum = 0.0;
    for (const Escape& escape : escapes) sum += std::pow((escape.share - mean) / escape.standard_error, 2);
    return sum;
}

TEST(PathEnsembleError, StandardErrorIsTheScatterOverSeeds) {
    constexpr std::size_t seeds = 200;
    std::vector<Escape> top;
    std::vector<Escape> bottom;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const PathEnsemble ensemble = PathEnsemble::trace(thin_skin, {600}, {.rays = 5000, .seed = seed});
        const EnsembleResponse response = ensemble.respond(depths_at({600}))[0];
        top.push_back(response[Side::top]);
        bottom.push_back(response[Side::bottom]);
    }
    for (const double statistic : {scatter(top), scatter(bottom)}) {
        const auto p_value = [](double value) {
            const double upper = test::chi_square_p_value(value, seeds - 1);
            return 2.0 * std::min(upper, 1.0 - upper);
        };
        EXPECT_GT(p_value(statistic), test::passing_p_value);
        EXPECT_LT(p_value(statistic * 1.5 * 1.5), test::passing_p_value)
            << "a standard error 1.5 times too small passes";
        EXPECT_LT(p_value(statistic / 1.5 / 1.5), test::passing_p_value)
            << "a standard error 1.5 times too large passes";
    }
}

/// The standard error that the rays of `ensemble` would leave in the share at the top if they were independent.
double independent_error(const PathEnsemble& ensemble, const PerLayer<double>& depth) {
    const PathEnsemble::Recording recording = ensemble.recording();
    const PathEnsemble::Segment& top = recording.segments[0][static_cast<std::size_t>(Side::top)];
    const std::uint64_t count = top.batch_begins.back();
    double sum = 0.0;
    double squares = 0.0;
    for (std::uint64_t i = 0; i < count; ++i) {
        double depth_along = 0.0;
        for (std::size_t layer = 0; layer < layer_count; ++layer) {
            depth_along += depth[layer] * static_cast<double>(recording.lengths[top.first_float + layer * count + i]);
        }
        const double weight = std::exp(-depth_along);
        sum += weight;
        squares += weight * weight;
    }
    const auto n = static_cast<double>(ensemble.rays());
    return (1.0 - ensemble.surface_share()) * std::sqrt((squares / n - (sum / n) * (sum / n)) / n);
}

TEST(PathEnsembleError, SharedOutNumbersKeepTable1Within0_0005) {
    constexpr std::size_t seeds = 8;
    constexpr double largest = 0.0005;     // at 100 000 rays
    constexpr double wavelength_nm = 700;  // where the share scatters most
    const Sample table_1;
    const std::vector<PerLayer<double>> depths = {
        optical_depth(table_1.skin, Extinction::at(wavelength_nm, table_1.edition))};
    double as_recorded = 0.0;  // squares of standard errors in units of the largest, summed
    double independent = 0.0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const PathEnsemble ensemble = PathEnsemble::trace(
            table_1, {wavelength_nm}, {.incidence_rad = 45 * rad_per_deg, .rays = 100'000, .seed = seed});
        as_recorded += std::pow(ensemble.respond(depths)[0][Side::top].standard_error / largest, 2);
        independent += std::pow(independent_error(ensemble, depths[0]) / largest, 2);
    }
    // Each square has batch_count - 1 degrees of freedom, the batches being sums of thousands of rays.
    constexpr std::size_t freedom = PathEnsemble::batch_count - 1;
    const auto p_value = [](double squares) {
        return test::chi_square_p_value(static_cast<double>(freedom) * squares, seeds * freedom);
    };
    EXPECT_GT(p_value(as_recorded), test::passing_p_value) << std::sqrt(as_recorded / seeds) * largest;
    EXPECT_LT(p_value(independent), test::passing_p_value)
        << "independent rays pass, at " << std::sqrt(independent / seeds) * largest;
}

}  // namespace
}  // namespace skinfit
