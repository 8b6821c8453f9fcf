#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "measurements/quality.hpp"
#include "measurements/spectrum.hpp"

/// The checks that `quality_findings` makes, one function each. Thresholds lie beyond everything seen in the skin
/// spectra of [VRHEL94], [COOKSEY17], [XIAO16], [LU25] and [BIERMAN11] that look sound: 2427 spectra. A spectrum whose
/// quantity is not stated is checked as a reflectance.
namespace skinfit {

/// `unit_conflict`: the unit is fraction, and half of the values or more exceed `largest_fraction`; or it is percent,
/// and no value exceeds `largest_fraction` percent.
[[nodiscard]] std::optional<Finding> unit_conflict(const Spectrum& spectrum);

/// `outside_0_1`: a value below 0 or above 1.
[[nodiscard]] std::optional<Finding> outside_0_1(const Spectrum& spectrum);

/// `offset`: a reflectance, specular not excluded, that somewhere falls, by more than 4 standard deviations of its
/// noise from reading to reading, below 1.7 %, which the surface of skin alone reflects: Fresnel's ((n - 1) / (n +
/// 1))^2 of n = 1.3, the least index that skin is given.
[[nodiscard]] std::optional<Finding> offset(const Spectrum& spectrum);

/// `dark_everywhere`: a reflectance below 9 % at all of its wavelengths, of which some are 650 nm or more. The darkest
/// skin of [VRHEL94] and [COOKSEY17] reaches 11.6 % there.
[[nodiscard]] std::optional<Finding> dark_everywhere(const Spectrum& spectrum);

/// `missing_values`: the file has wavelengths without a value. A note where they are one in ten or fewer.
[[nodiscard]] std::optional<Finding> missing_values(const Spectrum& spectrum);

/// `as_read`: what the reader left out of the file, converted, or could not make out. A note.
[[nodiscard]] std::optional<Finding> as_read(const Spectrum& spectrum);

/// `repeated_wavelengths`: a wavelength has several values.
[[nodiscard]] std::optional<Finding> repeated_wavelengths(const Spectrum& spectrum);

/// `outside_tables`: wavelengths outside those that the model knows. A note where others lie inside.
[[nodiscard]] std::optional<Finding> outside_tables(const Spectrum& spectrum, const ModelledRange& modelled);

/// `unusable_uncertainty`: a standard uncertainty that is missing, not above 0, or beyond `sigma_range`.
[[nodiscard]] std::optional<Finding> unusable_uncertainty(const Spectrum& spectrum);

/// `spikes`: a reading that lies beyond both of its neighbours, on the same side, by more than 0.01, 0.002 per nm of
/// half their distance, and 6 standard deviations of the spectrum's own reading-to-reading noise. Sound skin does so by
/// 0.0068 at most at 3 nm and 0.0135 at 10 nm, at a hemoglobin band; white noise, in one of 1e6 readings.
[[nodiscard]] std::optional<Finding> spikes(const Spectrum& spectrum);

/// `collapse_at_end`: over its last 20 nm the spectrum falls to less than half; or, a reflectance, towards its first
/// 20 nm to less than a third, since skin itself darkens there (to 0.42 at the least).
[[nodiscard]] std::optional<Finding> collapse_at_end(const Spectrum& spectrum);

/// `falling_end`: over its last 20 nm the spectrum loses more than a quarter, but no more than half. Sound skin loses
/// 20 % at the most, before a water band.
[[nodiscard]] std::optional<Finding> falling_end(const Spectrum& spectrum);

/// `saturation`: four or more readings side by side at exactly the spectrum's largest value, reached from a neighbour
/// by more than three times the grain of its numbers. Sound skin has three at most, of a maximum that is rounded.
[[nodiscard]] std::optional<Finding> saturation(const Spectrum& spectrum);

/// `no_hemoglobin`: between 540 and 580 nm the natural logarithm of the spectrum lies less than 0.04 below its chord
/// from 510 to 620 nm, on average. Melanin bends it the other way. The weakest bare skin has 0.088 (the darkest of
/// [VRHEL94]); heavy make-up hides it. What has it may still be no skin: so has a red paint. Spectra that do not cover
/// the chord with ten readings or have values that are not positive there are not judged.
[[nodiscard]] std::optional<Finding> no_hemoglobin(const Spectrum& spectrum);

/// `noise_against_repeats`: the scatter of the repeats contradicts the stated uncertainty: scatter^2 / (repeats
/// sigma^2), averaged over the wavelengths, has a probability below 1e-3 on either side under chi-square with as many
/// degrees of freedom as there are repeats beyond the first, as if each repeat departed alike at all wavelengths.
[[nodiscard]] std::optional<Finding> noise_against_repeats(const Spectrum& spectrum);

/// `doubtful_file`: what the file states contradicts its data, as its reader found.
[[nodiscard]] std::optional<Finding> doubtful_file(const Spectrum& spectrum);

/// `duplicate`, of each spectrum that has the same values at the same wavelengths as another one.
/// Two equal spectra make two findings. Measurements of skin never agree so: the nearest of [XIAO16] are 0.0035 apart.
[[nodiscard]] std::vector<Finding> duplicates(std::span<const Spectrum> spectra);

/// `reflectance_plus_transmittance`, of each reflectance that with the transmittance of the same specimen makes more
/// than 1.02 somewhere: 1 and twice the noise of two readings, 0.006 each [COOKSEY17]. The specimen is the same where
/// the names are, but for the words reflectance and transmittance.
[[nodiscard]] std::vector<Finding> reflectance_plus_transmittance(std::span<const Spectrum> spectra);

/// A check of one spectrum that needs nothing else, with the name that its findings bear.
struct SpectrumCheck {
    std::string_view name;
    std::optional<Finding> (*check)(const Spectrum& spectrum);
};

/// All of them, in the order of their findings.
inline constexpr std::array<SpectrumCheck, 15> spectrum_checks = {{{"as_read", as_read},
                                                                   {"unit_conflict", unit_conflict},
                                                                   {"outside_0_1", outside_0_1},
                                                                   {"offset", offset},
                                                                   {"dark_everywhere", dark_everywhere},
                                                                   {"missing_values", missing_values},
                                                                   {"repeated_wavelengths", repeated_wavelengths},
                                                                   {"unusable_uncertainty", unusable_uncertainty},
                                                                   {"spikes", spikes},
                                                                   {"collapse_at_end", collapse_at_end},
                                                                   {"falling_end", falling_end},
                                                                   {"saturation", saturation},
                                                                   {"no_hemoglobin", no_hemoglobin},
                                                                   {"noise_against_repeats", noise_against_repeats},
                                                                   {"doubtful_file", doubtful_file}}};

/// The names of all checks, as their findings bear them.
inline constexpr std::array<std::string_view, spectrum_checks.size() + 3> quality_check_names = [] {
    std::array<std::string_view, spectrum_checks.size() + 3> names{};
    auto next = std::ranges::transform(spectrum_checks, names.begin(), &SpectrumCheck::name).out;
    for (const std::string_view name : {"outside_tables", "duplicate", "reflectance_plus_transmittance"})
        *next++ = name;
    return names;
}();

}  // namespace skinfit
