#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "measurements/interpolation.hpp"
#include "measurements/quality_checks.hpp"
#include "measurements/reading_noise.hpp"

/// The checks on how values follow each other.
namespace skinfit {
namespace {

constexpr double end_width_nm = 20;

/// By how much reading `i` lies beyond both of its neighbours; 0 where it lies between them.
double prominence(const Spectrum& spectrum, std::size_t i) {
    const double before = spectrum.value[i] - spectrum.value[i - 1];
    const double after = spectrum.value[i] - spectrum.value[i + 1];
    return before * after > 0 ? std::min(std::abs(before), std::abs(after)) : 0;
}

Finding falls(const Spectrum& spectrum, const char* name, double from_nm, double end_nm) {
    return {.name = name,
            .spectrum = spectrum.name,
            .message = fmt::format("falls from {:.4g} at {:g} nm to {:.4g} at its end, {:g} nm",
                                   value_at(spectrum, from_nm), from_nm, value_at(spectrum, end_nm), end_nm),
            .remedy = "leave that end out, with exclude_nm or in the file, and check the instrument there"};
}

/// What remains of the value over the last `end_width_nm`, or towards the first; 1 for spectra shorter than twice that.
double rest_at_end(const Spectrum& spectrum, double end_nm, double from_nm) {
    if (spectrum.wavelength_nm.back() - spectrum.wavelength_nm.front() < 2 * end_width_nm) return 1;
    const double from = value_at(spectrum, from_nm);
    return from > 0 ? value_at(spectrum, end_nm) / from : 1;
}

double rest_at_long_end(const Spectrum& spectrum) {
    const double end_nm = spectrum.wavelength_nm.back();
    return rest_at_end(spectrum, end_nm, end_nm - end_width_nm);
}

}  // namespace

std::optional<Finding> spikes(const Spectrum& spectrum) {
    constexpr double least = 0.01;
    constexpr double per_nm = 0.002;
    constexpr double sigmas = 6;
    if (spectrum.value.size() < 3) return std::nullopt;
    const double noise = reading_noise(spectrum);
    std::size_t count = 0;
    std::size_t worst = 1;
    for (std::size_t i = 1; i + 1 < spectrum.value.size(); ++i) {
        const double distance_nm = (spectrum.wavelength_nm[i + 1] - spectrum.wavelength_nm[i - 1]) / 2;
        if (prominence(spectrum, i) <= std::max({least, per_nm * distance_nm, sigmas * noise})) continue;
        ++count;
        if (prominence(spectrum, i) > prominence(spectrum, worst)) worst = i;
    }
    if (count == 0) return std::nullopt;
    return Finding{.name = "spikes",
                   .spectrum = spectrum.name,
                   .message = fmt::format("{} {} beyond both neighbours; the worst, {:.4g} at {:g} nm, by {:.2g}",
                                          count, count == 1 ? "reading lies" : "readings lie", spectrum.value[worst],
                                          spectrum.wavelength_nm[worst], prominence(spectrum, worst)),
                   .remedy = "leave those readings out, with exclude_nm or in the file, or set loss=cauchy"};
}

std::optional<Finding> collapse_at_end(const Spectrum& spectrum) {
    constexpr double half = 0.5;
    constexpr double third = 1.0 / 3;
    const double first_nm = spectrum.wavelength_nm.front();
    const double last_nm = spectrum.wavelength_nm.back();
    if (rest_at_long_end(spectrum) < half) {
        return falls(spectrum, "collapse_at_end", last_nm - end_width_nm, last_nm);
    }
    const bool is_reflectance = spectrum.quantity.value_or(Quantity::reflectance) == Quantity::reflectance;
    if (is_reflectance && rest_at_end(spectrum, first_nm, first_nm + end_width_nm) < third) {
        return falls(spectrum, "collapse_at_end", first_nm + end_width_nm, first_nm);
    }
    return std::nullopt;
}

std::optional<Finding> falling_end(const Spectrum& spectrum) {
    constexpr double half = 0.5;
    constexpr double three_quarters = 0.75;
    const double rest = rest_at_long_end(spectrum);
    if (rest < half || rest >= three_quarters) return std::nullopt;
    const double last_nm = spectrum.wavelength_nm.back();
    return falls(spectrum, "falling_end", last_nm - end_width_nm, last_nm);
}

std::optional<Finding> saturation(const Spectrum& spectrum) {
    constexpr std::size_t least_run = 4;
    constexpr double grains = 3;
    const std::vector<double>& value = spectrum.value;
    const double largest = std::ranges::max(value);
    double grain = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < value.size(); ++i) {
        if (value[i] != value[i - 1]) grain = std::min(grain, std::abs(value[i] - value[i - 1]));
    }
    for (std::size_t begin = 0; begin < value.size();) {
        std::size_t end = begin;
        while (end < value.size() && value[end] == largest) ++end;
        const double before = begin > 0 ? largest - value[begin - 1] : 0;
        const double after = end < value.size() ? largest - value[end] : 0;
        if (end - begin >= least_run && std::max(before, after) > grains * grain) {
            return Finding{
                .name = "saturation",
                .spectrum = spectrum.name,
                .message = fmt::format("stays at exactly {:.4g}, its largest value, from {:g} to {:g} nm", largest,
                                       spectrum.wavelength_nm[begin], spectrum.wavelength_nm[end - 1]),
                .remedy =
                    "measure again with less light or a shorter exposure, or leave those readings out "
                    "with exclude_nm"};
        }
        begin = std::max(end, begin + 1);
    }
    return std::nullopt;
}

std::optional<Finding> no_hemoglobin(const Spectrum& spectrum) {
    constexpr double least_bump = 0.04;
    constexpr double first_nm = 510;
    constexpr double last_nm = 620;
    constexpr std::array<double, 5> bands_nm = {540, 550, 560, 570, 580};
    constexpr std::ptrdiff_t least_readings = 10;
    if (spectrum.wavelength_nm.front() > first_nm || spectrum.wavelength_nm.back() < last_nm) return std::nullopt;
    const auto first = std::ranges::lower_bound(spectrum.wavelength_nm, first_nm);
    const auto last = std::ranges::upper_bound(spectrum.wavelength_nm, last_nm);
    const bool is_positive = std::all_of(first, last, [&](const double& wavelength_nm) {
        return spectrum.value[static_cast<std::size_t>(&wavelength_nm - spectrum.wavelength_nm.data())] > 0;
    });
    if (last - first < least_readings || !is_positive) return std::nullopt;
    const double at_first = std::log(value_at(spectrum, first_nm));
    const double at_last = std::log(value_at(spectrum, last_nm));
    double bump = 0;
    for (const double band_nm : bands_nm) {
        const double chord = at_first + (at_last - at_first) * (band_nm - first_nm) / (last_nm - first_nm);
        bump += (chord - std::log(value_at(spectrum, band_nm))) / bands_nm.size();
    }
    if (bump >= least_bump) return std::nullopt;
    return Finding{
        .name = "no_hemoglobin",
        .spectrum = spectrum.name,
        .message = fmt::format("the bands of hemoglobin between 540 and 580 nm absorb {:.3f} more than their "
                               "surroundings, in logarithm; bare skin has 0.09 or more",
                               bump),
        .remedy = "check that this is skin without make-up, the right column, and not the white standard"};
}

}  // namespace skinfit
