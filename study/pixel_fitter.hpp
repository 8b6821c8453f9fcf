#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "fit/bulk.hpp"
#include "fit/configuration.hpp"
#include "fit/problem.hpp"
#include "measurements/spectrum.hpp"
#include "model/disk_cache.hpp"
#include "study/fit_status.hpp"

namespace skinfit {

/// Why a pixel is not simply fitted. The numbers are those of the plane `reason` of a map.
enum class PixelReason : std::uint8_t {
    none,
    missing_values,    ///< rejected: no number at a wavelength of the fit
    unit_conflict,     ///< rejected; this and the next ones as the findings of quality_checks.hpp
    outside_0_1,       ///< rejected
    offset,            ///< rejected
    dark_everywhere,   ///< rejected
    spikes,            ///< rejected
    collapse_at_end,   ///< rejected
    falling_end,       ///< rejected
    saturation,        ///< rejected
    no_hemoglobin,     ///< rejected
    not_converged,     ///< failed
    misfit,            ///< suspect: chi2 is improbable under the noise
    no_freedom,        ///< suspect: as many parameters as wavelengths, so that nothing tests the model
    at_bound,          ///< suspect: a parameter ended at one of its bounds
    not_identifiable,  ///< suspect: the pixel says less about a parameter than its bounds do
};
inline constexpr std::array<std::string_view, 16> pixel_reason_names = {
    "none",   "missing_values",  "unit_conflict", "outside_0_1",     "offset",        "dark_everywhere",
    "spikes", "collapse_at_end", "falling_end",   "saturation",      "no_hemoglobin", "not_converged",
    "misfit", "no_freedom",      "at_bound",      "not_identifiable"};

/// The word for `reason` in headers and legends.
[[nodiscard]] constexpr std::string_view name_of(PixelReason reason) {
    return pixel_reason_names[static_cast<std::size_t>(reason)];
}

/// What a fit of one pixel found. Numbers are NaN for pixels that are rejected or failed.
struct PixelFit {
    FitStatus status;
    PixelReason reason;          ///< the first that applies, in the order of the enumeration
    std::vector<double> values;  ///< of the free parameters
    std::vector<double> sigmas;  ///< 1 standard deviation from the noise; NaN at a bound and where not identifiable
    double rmse;                 ///< of reading minus measurement, fraction
    double chi2;
};

/// How pixels are fitted. Of 14400 synthetic pixels at a noise of 0.0005 to 0.006, one start left 1958 in a minimum
/// whose chi2 is higher by more than 3.84 than the lowest from eight starts, two left 41, which stood side by side in
/// the map, and three none.
inline constexpr BulkOptions pixel_options{.starts = 3};

/// Fits the pixels of one cube, one after the other, by the emulator of the angular solver (whatever the engine of the
/// configuration), with the noise of the configuration and its bandpass, else that of the cube.
///
/// The judgement is the part of `diagnose` that can be had for every pixel:
///   rejected, without a fit, where `findings_before_fit` warns of the pixel or it has no number at a wavelength of the
///   fit; failed where the fit did not converge; suspect where the p-value of chi2 is below `improbable`, no degree of
///   freedom is left, or a parameter lies at a bound or is not identifiable; else fitted.
/// Not looked for: runs of residuals, and other minima that explain the pixel almost as well.
class PixelFitter {
public:
    /// `common` is `common_spectrum` of the cube. Throws InputError as `make_problem` and `LeanModel`, and for another
    /// method of uncertainty than covariance.
    PixelFitter(const Configuration& configuration, const Spectrum& common, const DiskCache& cache);
    PixelFitter(const PixelFitter&) = delete;
    PixelFitter& operator=(const PixelFitter&) = delete;
    ~PixelFitter() = default;

    /// The fit of `values`, fractions at all wavelengths of the cube, NaN where there is none. Calls may come from any
    /// thread.
    [[nodiscard]] PixelFit fit(std::span<const double> values) const;

    /// What is fitted; its measured values mean nothing.
    [[nodiscard]] const FitProblem& problem() const { return problem_; }

private:
    [[nodiscard]] PixelReason reason_to_reject(std::span<const double> values) const;
    [[nodiscard]] PixelReason reason_to_doubt(const BulkFit& fit) const;

    Spectrum common_;
    FitProblem problem_;
    std::vector<std::size_t> fitted_;        ///< of the wavelengths of the cube
    std::optional<double> improbable_chi2_;  ///< exceeded with probability `improbable`; unset: no degree of freedom
    BulkFitter fitter_;
};

}  // namespace skinfit
