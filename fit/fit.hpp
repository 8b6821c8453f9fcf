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
    std::vector<Finding> findings{};  ///< on the spectrum, for the result: `findings_before_fit`
};

/// Explains `spectrum` as `configuration` says. Throws InputError for a problem that makes no sense (`make_problem`);
/// a fit that ends badly is a result with a verdict.
[[nodiscard]] FitResult fit_spectrum(const Configuration& configuration, const Spectrum& spectrum,
                                     const FitOptions& options);

/// What computes the light of `problem`: walks, recorded now or kept by `cache`, or the angular solver.
[[nodiscard]] ForwardModel make_model(const FitProblem& problem, Engine engine, const EnsembleCache& cache);

/// An approximation that costs a small part of `model`: a few of the recorded rays, or a coarser grid of angles; the
/// emulator is cheap itself.
[[nodiscard]] ForwardModel cheap_model(const FitProblem& problem, const ForwardModel& model);

/// The median of `values`; 0 of none.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace skinfit
