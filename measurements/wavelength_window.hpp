#pragma once

#include <limits>
#include <span>
#include <vector>

#include "measurements/spectrum.hpp"

namespace skinfit {

/// The wavelengths that are used; by default all.
struct WavelengthWindow {
    /// Both ends included.
    struct Range {
        double lowest_nm;
        double highest_nm;
    };
    Range range{.lowest_nm = 0.0, .highest_nm = std::numeric_limits<double>::infinity()};
    std::vector<Range> excluded{};

    /// True inside the range and outside all that is excluded, whose ends are excluded too.
    [[nodiscard]] bool contains(double wavelength_nm) const;
};

/// `spectrum` as if nothing else had been measured than what lies in `window`; nothing may remain.
[[nodiscard]] Spectrum part_of(const Spectrum& spectrum, const WavelengthWindow& window);

/// Of `values`, one per wavelength and NaN where one is missing, those in `window`; all of them where it has none.
[[nodiscard]] std::vector<double> used_values(const WavelengthWindow& window, std::span<const double> wavelength_nm,
                                              std::span<const double> values);

}  // namespace skinfit
