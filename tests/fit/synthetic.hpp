#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fit/configuration.hpp"
#include "fit/objective.hpp"
#include "fit/problem.hpp"
#include "measurements/spectrum.hpp"
#include "model/disk_cache.hpp"

namespace skinfit::test {

/// The default configuration with few rays.
[[nodiscard]] Configuration quick_configuration();

/// `configuration` with other free parameters.
[[nodiscard]] Configuration with_free(Configuration configuration, const std::vector<Parameter>& free);

/// `configuration` with other free parameters and another engine, lit at 30 degrees, with an instrument that excludes
/// specular reflection and departs from the ideal one.
[[nodiscard]] Configuration tilted(const Configuration& configuration, Engine engine,
                                   const std::vector<Parameter>& free);

/// The quick configuration of a skin with all its free parameters many sigmas inside their bounds, so that no fit ends
/// at one.
[[nodiscard]] Configuration inner_truth(double noise);

/// First, first + step, ... up to last, nm.
[[nodiscard]] std::vector<double> grid_nm(double first, double last, double step);

/// What the model of `truth` reads, without noise, over the same recorded walks as a fit with its settings.
[[nodiscard]] Spectrum modelled_spectrum(const Configuration& truth, const std::vector<double>& wavelengths_nm);

/// Keeps nothing and says nothing.
[[nodiscard]] DiskCache no_cache();

/// A problem and its objective, which points to it: `problem.measured` may be changed from fit to fit.
struct Task {
    FitProblem problem;
    Objective objective;

    Task(const Configuration& configuration, const Spectrum& spectrum);
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;
    ~Task() = default;
};

/// How `vector_of` changes with number `i` of `values`: the difference over a step of `h` to either side.
template <class Function>
[[nodiscard]] Eigen::VectorXd central_difference(const Function& vector_of, const std::vector<double>& values,
                                                 std::size_t i, double h) {
    std::vector<double> above = values;
    std::vector<double> below = values;
    above[i] += h;
    below[i] -= h;
    return (vector_of(above) - vector_of(below)) / (above[i] - below[i]);
}

/// Independent standard normal numbers, the same on any machine.
[[nodiscard]] std::vector<double> normal_numbers(std::uint64_t seed, std::size_t count);

}  // namespace skinfit::test
