#pragma once

#include <cassert>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/configuration.hpp"
#include "fit/measurement.hpp"
#include "measurements/spectrum.hpp"

namespace skinfit {

/// A parameter the fit adjusts.
struct FreeParameter {
    Parameter parameter;
    double start;
    Bounds bounds;                             ///< where a prior's density is zero at a bound: `within_support`
    std::optional<Prior> prior{};              ///< unset: uniform within the bounds
    std::optional<std::size_t> measurement{};  ///< of this measurement alone; unset: one value for all

    /// Whether it is free in measurement `number`.
    [[nodiscard]] bool belongs_to(std::size_t number) const { return measurement.value_or(number) == number; }
};

/// The parameter's name; of a parameter of one measurement with its number, counted from 1: `oxygen_saturation[2]`.
[[nodiscard]] std::string name_of(const FreeParameter& free);

/// A prior on a quantity computed from parameters.
struct DerivedPrior {
    Derived quantity;
    Prior prior;
    std::size_t measurement = 0;  ///< the one from whose parameters it is computed
};

/// What is to be found, and from which measurements.
struct FitProblem {
    std::vector<Measurement> measurements;  ///< at least one
    std::vector<FreeParameter> free;
    std::uint64_t seed = 1;  ///< of the searches
    std::optional<Discrepancy> discrepancy{};
    Loss loss = Loss::squares;
    double loss_scale = 1.0;  ///< sigmas
    std::vector<DerivedPrior> derived_priors{};

    /// The measurement of a problem that has one.
    [[nodiscard]] const Measurement& only() const {
        assert(measurements.size() == 1);
        return measurements.front();
    }
    [[nodiscard]] Measurement& only() {
        assert(measurements.size() == 1);
        return measurements.front();
    }
};

/// The problem of explaining all spectra of `input` by one specimen, but for the parameters that its configuration
/// lists as `own`, which have a value in each. Throws InputError where that makes no sense: no wavelengths in the
/// window or outside the tables, a constant spectrum, fewer wavelengths and priors than free parameters, none free, a
/// start outside its bounds, a parameter that this engine cannot adjust or that has no effect, a prior with its median
/// outside the bounds or less than a tenth of its mass inside; what `make_measurement` refuses; the same values twice,
/// or a reflectance and a transmittance that add up to more than 1. A prior on what is fixed has no effect, like the
/// bounds of a fixed parameter.
[[nodiscard]] FitProblem make_problem(const FitInput& input);

/// The same of `fit_input`.
[[nodiscard]] FitProblem make_problem(const Configuration& configuration, std::span<const Spectrum> spectra);

/// The same for one spectrum.
[[nodiscard]] FitProblem make_problem(const Configuration& configuration, const Spectrum& spectrum);
[[nodiscard]] FitProblem make_problem(const ResolvedConfiguration& configuration, const Spectrum& spectrum);

}  // namespace skinfit
