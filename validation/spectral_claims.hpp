#pragma once

#include <span>

#include "measurements/spectrum.hpp"
#include "model/angular_grid.hpp"
#include "validation/curve.hpp"
#include "validation/finding.hpp"

/// Claims about spectra: pure functions of computed curves. Curves that are compared have the same wavelengths.
namespace skinfit {

/// Every curve, one at least, of two wavelengths or more, is lower at each wavelength than at the one before.
[[nodiscard]] ClaimFinding falls_with_wavelength(std::span<const SpectralCurve> curves);

/// Every curve, two at least, is below the one before it at every wavelength, and somewhere by more than two errors of
/// the solver. The reason counts the differences that are within these errors.
[[nodiscard]] ClaimFinding darker_in_order(std::span<const SpectralCurve> curves);

/// How far the curve at 560 nm rises above the chord between 542 and 577 nm, the two bands of oxyhemoglobin: the depth
/// of the W, below zero where there is a dip instead.
[[nodiscard]] double w_depth(const SpectralCurve& curve);

/// The depth of the W grows from every curve, two at least, to the next by more than the solver's error of both, and
/// between 550 and 570 nm the last curve peaks above dips within 5 nm of 542 and 577 nm by more than that error.
[[nodiscard]] ClaimFinding w_deepens_in_order(std::span<const SpectralCurve> curves);

/// Of the curve that is nearest to what was measured, one at least, the root mean square difference at the measured
/// wavelengths that it reaches is no more than 95 % of the repeats of one measurement of skin scatter, 0.017.
/// [COOKSEY17]
[[nodiscard]] ClaimFinding close_to_measured(std::span<const SpectralCurve> curves, const Spectrum& measured);

/// At every measured wavelength that they reach, some curve is at or above and another at or below what was measured.
[[nodiscard]] ClaimFinding measured_within(std::span<const SpectralCurve> curves, const Spectrum& measured);

}  // namespace skinfit
