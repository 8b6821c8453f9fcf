#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fit/minimum.hpp"
#include "fit/objective.hpp"

namespace skinfit {

/// What became of a parameter.
enum class Status { free, fixed, at_lower_bound, at_upper_bound, not_identifiable };

/// How near to a bound, as a share of the distance between the two, a parameter is at it.
inline constexpr double touching_share = 1e-6;

/// How well the spectrum determines one free parameter.
struct ParameterUncertainty {
    Status status;
    std::optional<double> sigma;              ///< 1 standard deviation from the noise; for Status::free only
    std::optional<double> monte_carlo_sigma;  ///< from the finite number of rays; for Status::free only
    Bounds interval_95;                       ///< within the bounds of the fit
    bool decided_by_prior = false;            ///< `is_decided_by_prior` its interval
};

/// How well the spectrum determines the free parameters at a minimum.
struct Uncertainty {
    std::vector<ParameterUncertainty> parameters;  ///< in the order of `FitProblem::free`
    /// Of the parameters away from their bounds, identifiable or not: what trades against what shows here. Rows and
    /// columns of those at a bound are zero but for the diagonal.
    Eigen::MatrixXd correlation;
};

/// By how much the cost rises from its minimum, at `value`, to where one parameter is held at `at` and the others
/// follow, where the model and their priors are linear and `sigma` is the parameter's standard deviation: a parabola
/// without a prior of its own; a prior is taken as it is.
[[nodiscard]] double linear_cost_rise(const std::optional<Prior>& prior, double value, double sigma, double at);

/// The uncertainty by linearisation at `minimum`.
///
/// A parameter at a bound, with the cost rising into the box, is taken out of the covariance; its 95 % limit is where
/// the linearised cost, minimised over the others, has risen by 2.71. One without a prior of its own whose standard
/// deviation is not below that of a uniform distribution over its bounds, width / sqrt(12), is not identifiable: the
/// data say less than the bounds do; so is one whose limit at one bound lies beyond the other. Its interval is the
/// bounds. The others have sigma, and intervals up to where `linear_cost_rise` is 3.84, cut at the bounds: without a
/// prior of 1.96 sigma to either side.
[[nodiscard]] Uncertainty estimate_uncertainty(const Objective& objective, const Minimum& minimum);

}  // namespace skinfit
