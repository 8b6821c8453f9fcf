#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fit/configuration.hpp"
#include "fit/fit_watch.hpp"
#include "fit/models.hpp"
#include "fit/resolution.hpp"
#include "fit/result.hpp"
#include "measurements/quality.hpp"
#include "measurements/spectrum.hpp"
#include "model/disk_cache.hpp"

namespace skinfit {

/// What to do beside the fit itself.
struct FitOptions {
    bool cross_check = false;  ///< also by the other solvers, and compare
    DiskCache cache;
    std::vector<Finding> findings{};  ///< on the spectra, for the result: `findings_before_fit`
    /// What gives the models of the problem; unset: `make_models` with `cache`.
    std::function<std::vector<ForwardModel>(const FitProblem&, Engine)> models{};
    FitWatch watch{};
};

/// Explains all spectra of `input` together. Throws InputError for a problem that makes
/// no sense (`make_problem`); a fit that ends badly is a result with a verdict, and one that is cancelled throws
/// Cancelled within about 0.2 s, at the next evaluation of the model or while one is made, but where
/// `watch.keeps_partial_result` and a minimum is found already: then the result says what is `unfinished`.
[[nodiscard]] FitResult fit_spectra(const FitInput& input, const FitOptions& options);

/// The same of `fit_input`.
[[nodiscard]] FitResult fit_spectra(const Configuration& configuration, std::span<const Spectrum> spectra,
                                    const FitOptions& options);

/// The same for one spectrum.
[[nodiscard]] FitResult fit_spectrum(const Configuration& configuration, const Spectrum& spectrum,
                                     const FitOptions& options);

}  // namespace skinfit
