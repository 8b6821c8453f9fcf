#include "model/colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <functional>

#include "core/input_error.hpp"
#include "model/table.hpp"

namespace skinfit {
namespace {

constexpr int first_nm = 380;
constexpr int last_nm = 780;
constexpr int step_nm = 5;

constexpr double must_begin_nm = 420;
constexpr double must_end_nm = 680;

/// What the power reflected at one wavelength adds to X, Y and Z.
struct ColourWeight {
    double wavelength_nm;
    Xyz xyz;
};

std::vector<ColourWeight> weights(const Viewing& viewing) {
    const Table& observers = embedded_table("cie_observers");
    const bool narrow = viewing.observer == Observer::two_degrees;
    const Curve x(observers, narrow ? "x2" : "x10");
    const Curve y(observers, narrow ? "y2" : "y10");
    const Curve z(observers, narrow ? "z2" : "z10");
    const Curve d65(embedded_table("cie_d65"), "d65");
    std::vector<ColourWeight> weights;
    for (int nm = first_nm; nm <= last_nm; nm += step_nm) {
        const double power = viewing.illuminant == Illuminant::d65 ? d65(nm) : 1.0;
        weights.push_back(
            {.wavelength_nm = static_cast<double>(nm), .xyz = {power * x(nm), power * y(nm), power * z(nm)}});
    }
    return weights;
}

template <typename Value>
Xyz weighted_sum(const std::vector<ColourWeight>& weights, const Value& value) {
    Xyz sum{};
    for (const ColourWeight& weight : weights) {
        const double v = value(weight.wavelength_nm);
        sum.x += weight.xyz.x * v;
        sum.y += weight.xyz.y * v;
        sum.z += weight.xyz.z * v;
    }
    return sum;
}

Xyz diffuser_sum(const std::vector<ColourWeight>& weights) {
    return weighted_sum(weights, [](double) { return 1.0; });
}

Xyz normalised(const Xyz& sum, const Xyz& diffuser) {
    return {100.0 * (sum.x / diffuser.y), 100.0 * (sum.y / diffuser.y), 100.0 * (sum.z / diffuser.y)};
}

bool beyond(const ColourStimulus& stimulus, double wavelength_nm) {
    return wavelength_nm < stimulus.wavelength_nm.front() || wavelength_nm > stimulus.wavelength_nm.back();
}

double value_at(const ColourStimulus& stimulus, double wavelength_nm) {
    const std::vector<double>& nm = stimulus.wavelength_nm;
    const auto upper = std::ranges::upper_bound(nm, wavelength_nm);
    if (upper == nm.begin()) return stimulus.value.front();
    if (upper == nm.end()) return stimulus.value.back();
    const auto i = static_cast<std::size_t>(upper - nm.begin());
    const double share = (wavelength_nm - nm[i - 1]) / (nm[i] - nm[i - 1]);
    // In this form a flat spectrum stays flat to the last bit, and the diffuser's colour is the white.
    return stimulus.value[i - 1] + share * (stimulus.value[i] - stimulus.value[i - 1]);
}

double widest_visible_step_nm(const std::vector<double>& nm) {
    double widest = 0.0;
    for (std::size_t i = 1; i < nm.size(); ++i) {
        if (nm[i] > first_nm && nm[i - 1] < last_nm) widest = std::max(widest, nm[i] - nm[i - 1]);
    }
    return widest;
}

void require_enough_wavelengths(const ColourStimulus& stimulus) {
    const std::vector<double>& nm = stimulus.wavelength_nm;
    assert(!nm.empty() && nm.size() == stimulus.value.size());
    assert(std::ranges::adjacent_find(nm, std::greater_equal<>{}) == nm.end());
    if (nm.front() <= must_begin_nm && nm.back() >= must_end_nm) return;
    throw InputError({.where = "colour of a spectrum",
                      .problem = fmt::format("it reaches from {} to {} nm", nm.front(), nm.back()),
                      .why = fmt::format("a colour needs at least {} to {} nm", must_begin_nm, must_end_nm),
                      .remedy = "give a spectrum that reaches further, or ask for no colour"});
}

}  // namespace

Xyz white(const Viewing& viewing) {
    const Xyz diffuser = diffuser_sum(weights(viewing));
    return normalised(diffuser, diffuser);
}

SeenColour colour_of(const ColourStimulus& stimulus, const Viewing& viewing) {
    require_enough_wavelengths(stimulus);
    const std::vector<ColourWeight> all = weights(viewing);
    const Xyz diffuser = diffuser_sum(all);
    const Xyz sum = weighted_sum(all, [&](double nm) { return value_at(stimulus, nm); });
    const Xyz held = weighted_sum(all, [&](double nm) { return beyond(stimulus, nm) ? 1.0 : 0.0; });
    return {.xyz = normalised(sum, diffuser),
            .white = normalised(diffuser, diffuser),
            .held_share = {held.x / diffuser.x, held.y / diffuser.y, held.z / diffuser.z},
            .widest_step_nm = widest_visible_step_nm(stimulus.wavelength_nm)};
}

}  // namespace skinfit
