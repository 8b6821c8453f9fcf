#include "study/indices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "measurements/interpolation.hpp"
#include "model/colour.hpp"
#include "model/lab.hpp"

namespace skinfit {
namespace {

constexpr std::array<IndexInfo, 3> indices = {{
    {.name = "melanin_index",
     .unit = "",
     .meaning = "100 log10(1 / R) at 655 nm: grows with melanin",
     .source = "[SHRIVER00]"},
    {.name = "erythema_index",
     .unit = "",
     .meaning = "100 log10(R at 655 nm / R at 568 nm): grows with hemoglobin, and with melanin a little",
     .source = "[SHRIVER00]"},
    {.name = "individual_typology_angle_deg",
     .unit = "deg",
     .meaning = "arctan((L* - 50) / b*), D65, 2 degree observer: falls with pigmentation",
     .source = "[CHARDON91]"},
}};

constexpr double red_nm = 655;    // [SHRIVER00]
constexpr double green_nm = 568;  // [SHRIVER00]

/// A reading with its variance.
struct Read {
    double value;
    double variance;
};

/// Between two readings, linear as `value_at`; their noise is independent.
Read read_at(const Spectrum& spectrum, const std::vector<double>& sigma, double at_nm) {
    const std::vector<double>& nm = spectrum.wavelength_nm;
    const auto above = static_cast<std::size_t>(std::ranges::lower_bound(nm, at_nm) - nm.begin());
    if (nm[above] == at_nm) return {.value = spectrum.value[above], .variance = sigma[above] * sigma[above]};
    const double share = (at_nm - nm[above - 1]) / (nm[above] - nm[above - 1]);
    return {.value = value_at(spectrum, at_nm),
            .variance = std::pow((1.0 - share) * sigma[above - 1], 2) + std::pow(share * sigma[above], 2)};
}

void add_ratios(const Spectrum& spectrum, const std::vector<double>& sigma, std::vector<IndexValue>& values) {
    if (spectrum.wavelength_nm.front() > green_nm || spectrum.wavelength_nm.back() < red_nm) return;
    const Read red = read_at(spectrum, sigma, red_nm);
    const Read green = read_at(spectrum, sigma, green_nm);
    if (!(red.value > 0.0 && green.value > 0.0)) return;
    // d(100 log10 R) = 100 / ln 10 dR / R
    const double per_share = 100.0 / std::log(10.0);
    const double of_red = per_share * std::sqrt(red.variance) / red.value;
    const double of_green = per_share * std::sqrt(green.variance) / green.value;
    values.push_back({.name = indices[0].name, .value = -100.0 * std::log10(red.value), .sigma = of_red});
    values.push_back({.name = indices[1].name,
                      .value = 100.0 * std::log10(red.value / green.value),
                      .sigma = std::hypot(of_red, of_green)});
}

std::optional<double> angle_of(const Xyz& xyz, const Xyz& white) {
    return individual_typology_angle_deg(lab_from_xyz(xyz, white));
}

/// Tristimulus values are linear in the readings, so the derivative by each reading is a difference of two colours.
void add_angle(const Spectrum& spectrum, const std::vector<double>& sigma, std::vector<IndexValue>& values) {
    constexpr double first_nm = 420;  // as `colour_of` demands
    constexpr double last_nm = 680;
    if (spectrum.wavelength_nm.front() > first_nm || spectrum.wavelength_nm.back() < last_nm) return;
    ColourStimulus stimulus{.wavelength_nm = spectrum.wavelength_nm, .value = spectrum.value};
    const SeenColour seen = colour_of(stimulus, {});
    const std::optional<double> angle = angle_of(seen.xyz, seen.white);
    if (!angle) return;
    double variance = 0.0;
    for (std::size_t i = 0; i < sigma.size(); ++i) {
        stimulus.value[i] += sigma[i];
        const std::optional<double> higher = angle_of(colour_of(stimulus, {}).xyz, seen.white);
        stimulus.value[i] = spectrum.value[i] - sigma[i];
        const std::optional<double> lower = angle_of(colour_of(stimulus, {}).xyz, seen.white);
        stimulus.value[i] = spectrum.value[i];
        if (!higher || !lower) return;  // so close to b* = 0 that the angle says nothing
        variance += std::pow((*higher - *lower) / 2.0, 2);
    }
    values.push_back({.name = indices[2].name, .value = *angle, .sigma = std::sqrt(variance)});
}

}  // namespace

std::span<const IndexInfo> index_table() {
    return indices;
}

std::vector<IndexValue> indices_of(const Spectrum& spectrum, double noise) {
    std::vector<IndexValue> values;
    if (spectrum.quantity == Quantity::transmittance) return values;
    const std::vector<double> sigma =
        spectrum.sigma.empty() ? std::vector<double>(spectrum.value.size(), noise) : spectrum.sigma;
    add_ratios(spectrum, sigma, values);
    add_angle(spectrum, sigma, values);
    return values;
}

}  // namespace skinfit
