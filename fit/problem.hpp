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
    Bounds bounds;
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
};

/// The experiment that `configuration` describes; `geometry` fills in what it leaves open.
[[nodiscard]] Experiment make_experiment(const Configuration& configuration, const Geometry& geometry);

/// `configuration` with everything filled in that the spectrum or the defaults decide.
[[nodiscard]] Configuration resolved(Configuration configuration, const Spectrum& spectrum);

/// The problem of fitting `spectrum` as `resolved_configuration` says. Throws InputError where that makes no sense: no
/// wavelengths in the window or outside the tables, fewer wavelengths than free parameters, none free, a start outside
/// its bounds, a parameter that this engine cannot adjust or that has no effect.
[[nodiscard]] FitProblem make_problem(const Configuration& resolved_configuration, const Spectrum& spectrum);

}  // namespace skinfit
