#include "fit/band_sampling.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace skinfit {
namespace {

constexpr double step_nm = 2.0;

/// How far from its centre a band reaches.
double reach_nm(const Bandpass& band) {
    constexpr double gaussian_reach = 2.5;  // full widths at half maximum, 5.9 sigma: 4e-9 lies beyond
    switch (band.shape) {
        case BandpassShape::triangular:
            return band.width_nm;
        case BandpassShape::gaussian:
            return gaussian_reach * band.width_nm;
        default:
            return 0.5 * band.width_nm;
    }
}

/// The mean of max(x - X, 0) where X is distributed as the band about 0: its second derivative by x is the band.
double mean_excess(const Bandpass& band, double x) {
    if (x <= -reach_nm(band)) return 0.0;
    if (x >= reach_nm(band)) return x;
    if (x > 0.0) return x + mean_excess(band, -x);  // bands are symmetric
    const double width = band.width_nm;
    switch (band.shape) {
        case BandpassShape::triangular:
            return std::pow(x + width, 3) / (6.0 * width * width);
        case BandpassShape::gaussian: {
            const double sigma = width / std::sqrt(8.0 * std::numbers::ln2);
            const double z = x / sigma;
            const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
            return x * 0.5 * std::erfc(-z / std::numbers::sqrt2) + sigma * density;
        }
        default:
            return std::pow(x + 0.5 * width, 2) / (2.0 * width);
    }
}

/// The integral of the band times the function that is 1 at `x`, linear, and 0 from one step away.
double weight_at(const Bandpass& band, double x) {
    const double bend = mean_excess(band, x - step_nm) - 2.0 * mean_excess(band, x) + mean_excess(band, x + step_nm);
    return bend / step_nm;
}

}  // namespace

Eigen::VectorXd BandSampling::readings(Eigen::VectorXd modelled) const {
    if (weights.rows() == 0) return modelled;
    return weights * modelled;
}

Eigen::MatrixXd BandSampling::readings(Eigen::MatrixXd modelled) const {
    if (weights.rows() == 0) return modelled;
    return weights * modelled;
}

BandSampling sample_bands(const std::vector<double>& centres_nm, const std::optional<Bandpass>& bandpass) {
    if (!bandpass || bandpass->width_nm == 0.0) return {.wavelength_nm = centres_nm, .weights = {}};
    using Entry = Eigen::Triplet<double>;
    std::map<long, std::vector<Entry>> entries;  // by multiple of the step; their columns are not known yet
    for (std::size_t row = 0; row < centres_nm.size(); ++row) {
        const double reach = reach_nm(*bandpass) + step_nm;
        const auto first = static_cast<long>(std::ceil((centres_nm[row] - reach) / step_nm));
        const auto last = static_cast<long>(std::floor((centres_nm[row] + reach) / step_nm));
        for (long k = first; k <= last; ++k) {
            const double weight = weight_at(*bandpass, step_nm * static_cast<double>(k) - centres_nm[row]);
            if (weight > 0.0) entries[k].emplace_back(static_cast<int>(row), 0, weight);
        }
    }
    BandSampling sampling;
    std::vector<Entry> all;
    for (const auto& [k, here] : entries) {
        const int column = static_cast<int>(sampling.wavelength_nm.size());
        sampling.wavelength_nm.push_back(step_nm * static_cast<double>(k));
        for (const Entry& entry : here) all.emplace_back(entry.row(), column, entry.value());
    }
    sampling.weights.resize(static_cast<Eigen::Index>(centres_nm.size()),
                            static_cast<Eigen::Index>(sampling.wavelength_nm.size()));
    sampling.weights.setFromTriplets(all.begin(), all.end());
    return sampling;
}

std::vector<Reading> readings_in_bands(const std::vector<Reading>& modelled, const BandSampling& bands,
                                       const std::vector<double>& centres_nm) {
    if (bands.weights.rows() == 0) return modelled;
    std::vector<Reading> readings(centres_nm.size());
    for (std::size_t i = 0; i < readings.size(); ++i) readings[i].wavelength_nm = centres_nm[i];
    for (double Reading::*const field : {&Reading::reflectance, &Reading::reflectance_se, &Reading::transmittance,
                                         &Reading::transmittance_se, &Reading::surface_reflectance}) {
        Eigen::VectorXd values(static_cast<Eigen::Index>(modelled.size()));
        for (std::size_t i = 0; i < modelled.size(); ++i) values[static_cast<Eigen::Index>(i)] = modelled[i].*field;
        values = bands.weights * values;
        for (std::size_t i = 0; i < readings.size(); ++i) readings[i].*field = values[static_cast<Eigen::Index>(i)];
    }
    return readings;
}

}  // namespace skinfit
