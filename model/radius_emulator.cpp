#include "model/radius_emulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/input_error.hpp"
#include "model/chromophores.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {
namespace {

bool is_radius(const ParameterRange& range) {
    return range.parameter == Parameter::fibril_radius_nm;
}

/// Chebyshev points: so many that the polynomial between them is as good as the emulators, 2e-4 at most on the
/// specimens tried (tests/model/radius_emulator.cpp). Its error falls by four with each of them for a range of a factor
/// of three.
std::vector<double> nodes(double lower, double upper) {
    const double width = std::log(upper / lower);
    const int count = width > 0.0 ? 3 + static_cast<int>(std::ceil(4.5 * width)) : 1;
    std::vector<double> points;
    for (int k = 0; k < count; ++k) {
        const double point = std::cos(std::numbers::pi * (k + 0.5) / count);
        points.push_back(std::log(lower) + width / 2.0 * (1.0 + point));
    }
    return points;
}

/// How much each node's value counts in the polynomial at `x`, and its derivative by x.
struct NodeWeights {
    std::vector<double> weight;
    std::vector<double> slope;
};

NodeWeights weights_at(double x, const std::vector<double>& nodes) {
    NodeWeights weights;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        double weight = 1.0;
        double slope = 0.0;
        for (std::size_t m = 0; m < nodes.size(); ++m) {
            if (m == k) continue;
            const double gap = nodes[k] - nodes[m];
            slope = (slope * (x - nodes[m]) + weight) / gap;
            weight *= (x - nodes[m]) / gap;
        }
        weights.weight.push_back(weight);
        weights.slope.push_back(slope);
    }
    return weights;
}

/// The size of the last of the Chebyshev coefficients of values at the nodes. What follows it, each a quarter of the
/// one before, adds up to less.
double last_term(const std::vector<double>& values) {
    const auto count = static_cast<double>(values.size());
    if (values.size() < 2) return 0.0;
    double coefficient = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double angle = std::numbers::pi * (static_cast<double>(k) + 0.5) / count;
        coefficient += values[k] * std::cos((count - 1.0) * angle);
    }
    return std::abs(2.0 * coefficient / count);
}

/// The `number`-th of a sequence that fills the unit interval evenly (van der Corput).
double evenly(int number, int base) {
    double value = 0.0;
    double digit = 1.0;
    for (; number > 0; number /= base) {
        digit /= base;
        value += digit * (number % base);
    }
    return value;
}

/// The optical depths of a specimen of the domain at each of its wavelengths.
std::vector<PerLayer<double>> specimen(const EmulatorDomain& domain, int number) {
    constexpr std::array bases = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41};
    Skin skin = domain.sample.skin;
    std::size_t place = 0;
    for (const ParameterRange& range : domain.ranges) {
        if (is_radius(range)) continue;
        const double share = evenly(number, bases[place++ % bases.size()]);
        // Crowded at the lower bounds, where the share bends most.
        ParameterValues values{.skin = skin, .instrument = {}};
        value_of(values, range.parameter) = range.lower + (range.upper - range.lower) * share * share * share;
        skin = values.skin;
    }
    return optical_depths(skin, extinctions(domain.wavelengths_nm, domain.sample.edition));
}

}  // namespace

bool varies_fibril_radius(const EmulatorDomain& domain) {
    return std::ranges::any_of(domain.ranges, is_radius);
}

RadiusEmulator::RadiusEmulator(const EmulatorDomain& domain, const Make& make)
    : radius_nm_(*std::ranges::find_if(domain.ranges, is_radius)),
      log_radius_(nodes(radius_nm_.lower, radius_nm_.upper)) {
    EmulatorDomain of_one = domain;
    std::erase_if(of_one.ranges, is_radius);
    for (const double log_radius : log_radius_) {
        of_one.sample.skin.fibril_radius_nm = std::exp(log_radius);
        emulators_.push_back(make(of_one));
    }
    constexpr int specimens = 256;
    std::vector<double> between(wavelength_count(), 0.0);
    for (int number = 1; number <= specimens; ++number) {
        const std::vector<PerLayer<double>> depths = specimen(of_one, number);
        std::vector<std::vector<double>> values(wavelength_count());
        for (const Emulator& emulator : emulators_) {
            const std::vector<EmulatedShare> shares = emulator.respond(depths);
            for (std::size_t i = 0; i < shares.size(); ++i) values[i].push_back(shares[i].share);
        }
        for (std::size_t i = 0; i < values.size(); ++i) between[i] = std::max(between[i], last_term(values[i]));
    }
    for (std::size_t i = 0; i < wavelength_count(); ++i) {
        double largest = 0.0;
        for (const Emulator& emulator : emulators_) largest = std::max(largest, emulator.certified_error(i));
        certified_error_.push_back(largest + between[i]);
    }
}

double RadiusEmulator::certified_error() const {
    return std::ranges::max(certified_error_);
}

std::vector<RadiusShare> RadiusEmulator::respond(std::span<const PerLayer<double>> optical_depths,
                                                 double fibril_radius_nm) const {
    constexpr double rounding = 1e-9;
    // Written so that a radius that is no number is refused.
    if (!(fibril_radius_nm >= radius_nm_.lower * (1.0 - rounding) &&
          fibril_radius_nm <= radius_nm_.upper * (1.0 + rounding))) {
        throw InputError({.where = "engine emulator",
                          .problem = fmt::format("fibril_radius_nm {:.6g} lies outside its domain", fibril_radius_nm),
                          .why = fmt::format("it was made for {:.6g} to {:.6g}", radius_nm_.lower, radius_nm_.upper),
                          .remedy = "keep the value within its bounds, widen them, or set engine=solver"});
    }
    const NodeWeights weights = weights_at(std::log(fibril_radius_nm), log_radius_);
    std::vector<RadiusShare> sum(wavelength_count());
    for (std::size_t k = 0; k < emulators_.size(); ++k) {
        const std::vector<EmulatedShare> shares = emulators_[k].respond(optical_depths);
        for (std::size_t i = 0; i < shares.size(); ++i) {
            sum[i].share += weights.weight[k] * shares[i].share;
            sum[i].by_fibril_radius_nm += weights.slope[k] * shares[i].share / fibril_radius_nm;
            for (std::size_t layer = 0; layer < layer_count; ++layer) {
                sum[i].by_optical_depth[layer] += weights.weight[k] * shares[i].by_optical_depth[layer];
            }
        }
    }
    return sum;
}

}  // namespace skinfit
