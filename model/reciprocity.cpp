#include "model/reciprocity.hpp"

#include <array>
#include <cassert>
#include <cmath>

namespace skinfit {
namespace {

double z_between(const BrdfValue& a, const BrdfValue& b) {
    const double difference = a.per_sr - b.per_sr;
    return difference == 0.0 ? 0.0 : difference / std::hypot(a.standard_error, b.standard_error);
}

}  // namespace

std::vector<ReciprocityPair> compare_both_ways(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                               const std::vector<double>& weights, Light light,
                                               const std::vector<int>& polar_bins, GoniophotometerOptions options) {
    assert(light != Light::transmitted);
    const AngularBins bins = options.bins;
    std::vector<AngularSpectrum> from;
    for (const int polar_bin : polar_bins) {
        options.incidence = {bins.polar_edge_rad(polar_bin), bins.polar_edge_rad(polar_bin + 1)};
        from.push_back({.bins = bins, .counts = goniophotometer(sample, wavelengths_nm, options), .weights = weights});
        options.first_ray += wavelengths_nm.size() * options.rays;
    }
    const std::array<std::optional<int>, 3> azimuth_bins = {std::nullopt, 0, bins.azimuth / 2};
    std::vector<ReciprocityPair> pairs;
    for (std::size_t a = 0; a < polar_bins.size(); ++a) {
        for (std::size_t b = a + 1; b < polar_bins.size(); ++b) {
            for (const std::optional<int> azimuth_bin : azimuth_bins) {
                const BrdfValue a_to_b = brdf(from[a], light, polar_bins[b], azimuth_bin);
                const BrdfValue b_to_a = brdf(from[b], light, polar_bins[a], azimuth_bin);
                pairs.push_back({.polar_bin_a = polar_bins[a],
                                 .polar_bin_b = polar_bins[b],
                                 .azimuth_bin = azimuth_bin,
                                 .a_to_b = a_to_b,
                                 .b_to_a = b_to_a,
                                 .z = z_between(a_to_b, b_to_a)});
            }
        }
    }
    return pairs;
}

}  // namespace skinfit
