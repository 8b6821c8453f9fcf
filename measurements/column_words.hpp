#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Names of columns that hold neither spectra nor their uncertainties.
namespace skinfit {

/// Row numbers and names of readings, wherever they stand.
[[nodiscard]] bool counts_readings(std::string_view name);

/// The same, and names of specimens, in front of the wavelengths: a data frame's index without a name, `id`, `sample`.
[[nodiscard]] bool is_label_in_front(std::string_view name);

/// `n`, `count`: of how many readings each value is the mean.
[[nodiscard]] bool counts_repeats(std::string_view name);

/// What each reading was taken with: its bandpass, a temperature, a time of exposure.
[[nodiscard]] bool is_condition(std::string_view name);

/// Whether a name speaks of values: `R`, `mean`, `reflectance`.
[[nodiscard]] bool is_name_of_values(std::string_view name);

/// `min`, `upper` and the like, beside values of which they are bounds.
[[nodiscard]] bool is_bound(std::string_view name);

/// Whether the cells below may tell specimens apart: `subject`, `site`, `sample id`.
[[nodiscard]] bool names_specimens(std::string_view name);

/// What a reflectance or transmittance beside it was made of: `dark`, `white`, `sample`.
[[nodiscard]] bool is_raw_beside_quantity(std::string_view name);

/// Column `c` of Ocean Optics' Jaz is dark, reference or sample: its names are W, D, R, S and P, the processed
/// spectrum.
[[nodiscard]] bool is_raw_of_jaz(const std::vector<std::string>& names, std::size_t c);

}  // namespace skinfit
