#pragma once

#include <cstdint>
#include <vector>

#include "fit/configuration.hpp"
#include "fit/objective.hpp"
#include "fit/problem.hpp"
#include "measurements/spectrum.hpp"
#include "model/ensemble_cache.hpp"

namespace skinfit::test {

/// The default configuration with few rays.
[[nodiscard]] Configuration quick_configuration();

/// `configuration` with other free parameters.
[[nodiscard]] Configuration with_free(Configuration configuration, const std::vector<Parameter>& free);

/// First, first + step, ... up to last, nm.
[[nodiscard]] std::vector<double> grid_nm(double first, double last, double step);

/// What the model of `truth` reads, without noise, over the same recorded walks as a fit with its settings.
[[nodiscard]] Spectrum modelled_spectrum(const Configuration& truth, const std::vector<double>& wavelengths_nm);

/// Keeps nothing and says nothing.
[[nodiscard]] EnsembleCache no_cache();

/// A problem and its objective, which points to it: `problem.measured` may be changed from fit to fit.
struct Task {
    FitProblem problem;
    Objective objective;

    Task(const Configuration& configuration, const Spectrum& spectrum);
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;
};

/// Independent standard normal numbers, the same on any machine.
[[nodiscard]] std::vector<double> normal_numbers(std::uint64_t seed, std::size_t count);

}  // namespace skinfit::test
