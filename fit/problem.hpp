#pragma once

#include <string>
#include <vector>

#include "fit/configuration.hpp"
#include "measurements/spectrum.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {

/// A parameter the fit adjusts.
struct FreeParameter {
    Parameter parameter;
    double start;
    Bounds bounds;                 ///< where a prior's density is zero at a bound: `within_support`
    std::optional<Prior> prior{};  ///< unset: uniform within the bounds
};

/// A prior on a quantity computed from parameters.
struct DerivedPrior {
    Derived quantity;
    Prior prior;
};

/// One measured spectrum and the model that is to explain it.
struct FitProblem {
    Experiment experiment;  ///< fixed values, and the starts of the free ones
    Quantity quantity = Quantity::reflectance;
    std::vector<double> wavelength_nm;  ///< within the window of the fit
    std::vector<double> measured;       ///< fractions
    std::vector<double> sigma;          ///< standard uncertainty of `measured`
    std::string sigma_source;           ///< in words
    std::vector<FreeParameter> free;
    WalkOptions walk;
    std::vector<double> weight{};  ///< of each squared residual; empty: 1
    std::optional<Discrepancy> discrepancy{};
    Loss loss = Loss::squares;
    double loss_scale = 1.0;  ///< sigmas
    std::vector<DerivedPrior> derived_priors{};
};

/// The experiment that `configuration` describes; `geometry` fills in what it leaves open.
[[nodiscard]] Experiment make_experiment(const Configuration& configuration, const Geometry& geometry);

/// `configuration` with everything filled in that the spectrum or the defaults decide.
[[nodiscard]] Configuration resolved(Configuration configuration, const Spectrum& spectrum);

/// The problem of fitting `spectrum` as `resolved_configuration` says. Throws InputError where that makes no sense: no
/// wavelengths in the window or outside the tables, a constant spectrum, fewer wavelengths and priors than free
/// parameters, none free, a start outside its bounds, a parameter that this engine cannot adjust or that has no effect,
/// a prior with its mode outside the bounds or less than a tenth of its mass inside. A prior on what is fixed has no
/// effect, like the bounds of a fixed parameter.
[[nodiscard]] FitProblem make_problem(const Configuration& resolved_configuration, const Spectrum& spectrum);

}  // namespace skinfit
