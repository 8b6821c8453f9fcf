#pragma once

#include "fit/configuration.hpp"
#include "fit/forward_model.hpp"
#include "fit/problem.hpp"
#include "fit/result.hpp"
#include "measurements/quality.hpp"
#include "measurements/spectrum.hpp"
#include "model/ensemble_cache.hpp"

namespace skinfit {

/// What to do beside the fit itself.
struct FitOptions {
    bool cross_check = false;  ///< also by the other solvers, and compare
    EnsembleCache cache;
    std::vector<Finding> findings{};  ///< on the spectra, for the result: `findings_before_fit`
};

/// Explains all `spectra` (at least one) together as `configuration` says. Throws InputError for a problem that makes
/// no sense (`make_problem`); a fit that ends badly is a result with a verdict.
[[nodiscard]] FitResult fit_spectra(const Configuration& configuration, std::span<const Spectrum> spectra,
                                    const FitOptions& options);

/// The same for one spectrum.
[[nodiscard]] FitResult fit_spectrum(const Configuration& configuration, const Spectrum& spectrum,
                                     const FitOptions& options);

/// What computes the light of each measurement: walks, recorded now or kept by `cache`, the angular solver, or its
/// emulator, made now or kept.
[[nodiscard]] std::vector<ForwardModel> make_models(const FitProblem& problem, Engine engine,
                                                    const EnsembleCache& cache);

/// Approximations that cost a small part of `models`: a few of the recorded rays, or a coarser grid of angles; the
/// emulator is cheap itself.
[[nodiscard]] std::vector<ForwardModel> cheap_models(const FitProblem& problem,
                                                     const std::vector<ForwardModel>& models);

/// The median of `values`; 0 of none.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace skinfit
