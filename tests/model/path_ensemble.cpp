#include "model/path_ensemble.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>

#include "model/chromophores.hpp"
#include "model/recorded_walk.hpp"

namespace skinfit {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

const Sample thin_skin{.skin = {}, .edition = Edition::printed, .layers = 4, .base = {Base::Kind::matched}};
const std::vector<double> wavelengths_nm = {450, 600};
const WalkOptions options{.incidence_rad = 0.5, .rays = 10'000, .seed = 3};

std::vector<PerLayer<double>> depths_of(const Sample& sample) {
    std::vector<PerLayer<double>> depths;
    for (const double wavelength_nm : wavelengths_nm) {
        depths.push_back(optical_depth(sample.skin, Extinction::at(wavelength_nm, sample.edition)));
    }
    return depths;
}

/// The recorded lengths of one wavelength and side, one row per path.
std::vector<PerLayer<double>> recorded(const PathEnsemble& ensemble, std::size_t wavelength, Side side) {
    const PathEnsemble::Recording recording = ensemble.recording();
    const PathEnsemble::Segment& segment = recording.segments[wavelength][static_cast<std::size_t>(side)];
    const std::uint64_t count = segment.batch_begins.back();
    std::vector<PerLayer<double>> paths(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        for (std::size_t layer = 0; layer < layer_count; ++layer) {
            paths[i][layer] = static_cast<double>(recording.lengths[segment.first_float + layer * count + i]);
        }
    }
    return paths;
}

double depth_along(const PerLayer<double>& path, const PerLayer<double>& depth) {
    return path[0] * depth[0] + path[1] * depth[1] + path[2] * depth[2] + path[3] * depth[3];
}

TEST(PathEnsemble, KeepsTheRaysOfItsBatchesInOrder) {
    const PathEnsemble ensemble = PathEnsemble::trace(thin_skin, wavelengths_nm, options);
    const SobolPoints points(options.rays);
    for (std::size_t w = 0; w < wavelengths_nm.size(); ++w) {
        const LayerStack stack = layer_stack(thin_skin, wavelengths_nm[w]);
        std::array<std::vector<PerLayer<double>>, side_count> expected;
        for (std::uint32_t batch = 0; batch < PathEnsemble::batch_count; ++batch) {
            const std::uint64_t begin = options.rays * batch / PathEnsemble::batch_count;
            const std::uint64_t end = options.rays * (batch + 1) / PathEnsemble::batch_count;
            const double refracted = stack.between(-1, 0).transmitted_cosine(std::cos(options.incidence_rad));
            for (RecordedRay ray : record_batch(
                     stack, {.refracted_cosine = refracted, .rays = end - begin, .seed = options.seed, .number = batch},
                     points)) {
                for (double& length : ray.lengths) length = static_cast<double>(static_cast<float>(length));
                expected[ray.exit == Exit::reflected ? 0 : 1].push_back(ray.lengths);
            }
        }
        EXPECT_EQ(recorded(ensemble, w, Side::top), expected[0]);
        EXPECT_EQ(recorded(ensemble, w, Side::bottom), expected[1]);
    }
}

TEST(PathEnsemble, RespondsWithTheSumOverItsPaths) {
    const PathEnsemble ensemble = PathEnsemble::trace(thin_skin, wavelengths_nm, options);
    const std::vector<PerLayer<double>> depths = depths_of(thin_skin);
    const std::vector<EnsembleResponse> responses = ensemble.respond(depths);
    const double entering = 1.0 - ensemble.surface_share();
    const auto n = static_cast<double>(options.rays);
    for (std::size_t w = 0; w < wavelengths_nm.size(); ++w) {
        for (const Side side : {Side::top, Side::bottom}) {
            double sum = 0.0;
            double worst = 0.0;  // sum of the paths' rounding errors in units of epsilon
            PerLayer<double> length_sum{};
            for (const PerLayer<double>& path : recorded(ensemble, w, side)) {
                const double depth = depth_along(path, depths[w]);
                const double weight = std::exp(-depth);
                sum += weight;
                worst += weight * (2.0 + 8.0 * depth);  // 4 products and sums either way, and two exponentials
                for (std::size_t l = 0; l < layer_count; ++l) length_sum[l] += weight * path[l];
            }
            const Escape& escape = responses[w][side];
            // A sum of n positive terms in any order is within n epsilon / 2 of the truth, relatively.
            const double relative = epsilon * (n + worst / sum + 8.0);
            EXPECT_NEAR(escape.share, entering * sum / n, relative * entering * sum / n);
            for (std::size_t l = 0; l < layer_count; ++l) {
                // Here a path's error weighs as its length; its depth is at most 745 where its weight is not zero.
                const double derivative = entering * length_sum[l] / n;
                EXPECT_NEAR(escape.by_optical_depth[l], -derivative, epsilon * (n + 8.0 * 745.0) * derivative);
            }
        }
    }
}

TEST(PathEnsemble, DerivativesAreThoseOfItsShares) {
    const PathEnsemble ensemble = PathEnsemble::trace(thin_skin, wavelengths_nm, options);
    const std::vector<PerLayer<double>> depths = depths_of(thin_skin);
    const auto n = static_cast<double>(options.rays);
    const auto share_at = [&](std::size_t w, Side side, std::size_t layer, double change) {
        std::vector<PerLayer<double>> moved = depths;
        moved[w][layer] += change;
        return ensemble.respond(moved)[w][side].share;
    };
    for (std::size_t w = 0; w < wavelengths_nm.size(); ++w) {
        for (const Side side : {Side::top, Side::bottom}) {
            const Escape escape = ensemble.respond(depths)[w][side];
            for (std::size_t l = 0; l < layer_count; ++l) {
                const double h = 1e-2 * depths[w][l];
                const auto slope = [&](double step) {
                    return (share_at(w, side, l, step) - share_at(w, side, l, -step)) / (2.0 * step);
                };
                const double richardson = (4.0 * slope(h / 2) - slope(h)) / 3.0;
                // Richardson leaves h^4 / 480 times the fifth derivative, which is largest at the lowest depth.
                PerLayer<double> lowest = depths[w];
                lowest[l] -= h;
                double fifth = 0.0;
                for (const PerLayer<double>& path : recorded(ensemble, w, side)) {
                    fifth += std::exp(-depth_along(path, lowest)) * std::pow(path[l], 5) / n;
                }
                const double truncation = std::pow(h, 4) / 480 * fifth;
                const double rounding = 6.0 * n * epsilon * escape.share / h;
                EXPECT_NEAR(escape.by_optical_depth[l], richardson, truncation + rounding);
                // No path that returns has completed a run in the reticular dermis over a matched base: exactly zero.
                const bool tells = truncation + rounding < 1e-5 * std::abs(escape.by_optical_depth[l]);
                EXPECT_TRUE(tells || (fifth == 0.0 && escape.by_optical_depth[l] == 0.0)) << "bound too loose to tell";
            }
        }
    }
}

TEST(PathEnsemble, WithoutAbsorptionEverythingReturns) {
    const std::vector<PerLayer<double>> nothing(wavelengths_nm.size());
    const PathEnsemble whole = PathEnsemble::trace({}, wavelengths_nm, options);
    for (const EnsembleResponse& response : whole.respond(nothing)) {
        EXPECT_EQ(response[Side::top].share, 1.0 - whole.surface_share());
        EXPECT_EQ(response[Side::top].standard_error, 0.0);
        EXPECT_EQ(response[Side::bottom].share, 0.0);
    }
    const PathEnsemble thin = PathEnsemble::trace(thin_skin, wavelengths_nm, options);
    for (const EnsembleResponse& response : thin.respond(nothing)) {
        // Both shares are counts over n, scaled: three roundings.
        EXPECT_NEAR(response[Side::top].share + response[Side::bottom].share, 1.0 - thin.surface_share(), 4 * epsilon);
    }
}

TEST(PathEnsemble, StandardErrorIsTheScatterOfItsBatches) {
    WalkOptions equal_batches = options;
    equal_batches.rays = 320 * PathEnsemble::batch_count;
    const PathEnsemble ensemble = PathEnsemble::trace(thin_skin, wavelengths_nm, equal_batches);
    const std::vector<PerLayer<double>> depths = depths_of(thin_skin);
    for (const Side side : {Side::top, Side::bottom}) {
        const auto shares = ensemble.batch_shares(depths, side);
        const std::vector<EnsembleResponse> responses = ensemble.respond(depths);
        for (std::size_t w = 0; w < wavelengths_nm.size(); ++w) {
            double squares = 0.0;
            for (const double share : shares[w]) squares += std::pow(share - responses[w][side].share, 2);
            const double expected = std::sqrt(squares / (PathEnsemble::batch_count - 1) / PathEnsemble::batch_count);
            // A share is rounded as a sum of 320 terms, a thousand times more finely than the shares differ.
            const double rounding = 320 * epsilon * responses[w][side].share;
            EXPECT_NEAR(responses[w][side].standard_error, expected, rounding);
            EXPECT_LT(rounding, 1e-9 * expected);
        }
    }
    EXPECT_TRUE(std::isinf(ensemble.with_about(1).respond(depths)[0][Side::top].standard_error));
}

TEST(PathEnsemble, BatchesAddUpToTheWhole) {
    const PathEnsemble ensemble = PathEnsemble::trace(thin_skin, wavelengths_nm, options);
    const std::vector<PerLayer<double>> depths = depths_of(thin_skin);
    const auto shares = ensemble.batch_shares(depths, Side::top);
    const std::vector<EnsembleResponse> responses = ensemble.respond(depths);
    for (std::size_t w = 0; w < wavelengths_nm.size(); ++w) {
        double sum = 0.0;
        for (std::size_t batch = 0; batch < PathEnsemble::batch_count; ++batch) {
            const std::uint64_t begin = options.rays * batch / PathEnsemble::batch_count;
            const std::uint64_t end = options.rays * (batch + 1) / PathEnsemble::batch_count;
            sum += shares[w][batch] * static_cast<double>(end - begin);
        }
        const double share = responses[w][Side::top].share;
        EXPECT_NEAR(sum / static_cast<double>(options.rays), share, 64 * epsilon * share);  // 32 terms
    }
}

TEST(PathEnsemble, BitsDoNotDependOnThreads) {
    const auto compute = [](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const PathEnsemble ensemble = PathEnsemble::trace(thin_skin, wavelengths_nm, options);
        const std::span<const float> lengths = ensemble.recording().lengths;
        std::vector<std::uint64_t> bits;
        std::ranges::transform(lengths, std::back_inserter(bits),
                               [](float x) { return std::bit_cast<std::uint32_t>(x); });
        const auto keep = [&bits](double x) { bits.push_back(std::bit_cast<std::uint64_t>(x)); };
        for (const EnsembleResponse& response : ensemble.respond(depths_of(thin_skin))) {
            for (const Escape& escape : response.side) {
                keep(escape.share);
                keep(escape.standard_error);
                for (const double derivative : escape.by_optical_depth) keep(derivative);
            }
        }
        return bits;
    };
    EXPECT_EQ(compute(1), compute(2));
}

TEST(PathEnsemble, CopiesAndStoredPartsRespondAlike) {
    const std::vector<PerLayer<double>> depths = depths_of(thin_skin);
    const PathEnsemble ensemble = PathEnsemble::trace(thin_skin, wavelengths_nm, options);
    const PathEnsemble::Recording recording = ensemble.recording();
    const PathEnsemble stored({.surface_share = ensemble.surface_share(),
                               .rays = ensemble.rays(),
                               .segments = {recording.segments.begin(), recording.segments.end()},
                               .lengths = recording.lengths,
                               .owner = nullptr});
    for (std::size_t w = 0; w < wavelengths_nm.size(); ++w) {
        EXPECT_EQ(stored.respond(depths)[w][Side::top].share, ensemble.respond(depths)[w][Side::top].share);
        EXPECT_EQ(stored.respond(depths)[w][Side::bottom].share, ensemble.respond(depths)[w][Side::bottom].share);
    }
}

}  // namespace
}  // namespace skinfit
