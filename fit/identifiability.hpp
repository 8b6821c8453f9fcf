#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fit/objective.hpp"

namespace skinfit {

/// A combination of parameters and how well the spectrum knows it.
struct Direction {
    /// By how many sigmas of noise the spectrum changes for one prior standard deviation along the direction.
    double singular_value;
    Eigen::VectorXd components;  ///< of the free parameters, in prior standard deviations; of unit length

    /// The spectrum says less about it than the bounds or priors do.
    [[nodiscard]] bool is_weak() const { return singular_value < 1.0; }
};

/// What a spectrum can tell about the free parameters around one point, to first order. A parameter without a prior of
/// its own counts as uniform between its bounds: a standard deviation of width / sqrt(12).
struct Identifiability {
    std::vector<std::string> names;     ///< of the free parameters, `name_of`
    std::vector<Direction> directions;  ///< best known first
    /// 1 - variance with the spectrum / variance without it, of each parameter in its natural coordinate: near 1 where
    /// the spectrum decides.
    std::vector<double> shrinkage;
};

/// The standard deviation of a parameter without a spectrum, of its prior or a uniform one within its bounds: of its
/// natural coordinate, and as the step of the value, from `value`, that changes the coordinate by as much.
[[nodiscard]] double prior_sigma(const FreeParameter& free);
[[nodiscard]] double prior_step(const FreeParameter& free, double value);

/// Whether a 95 % interval owes more to the prior of the parameter than to the spectrum: in the natural coordinate it
/// is no shorter than 1/sqrt(2) of what it would be without a spectrum. Never without a prior.
[[nodiscard]] bool is_decided_by_prior(const FreeParameter& free, const Bounds& interval_95);

/// From the derivatives of the data's residuals, in sigmas, by the free parameters at `values`.
[[nodiscard]] Identifiability identifiability(const Eigen::MatrixXd& jacobian, const std::vector<FreeParameter>& free,
                                              std::span<const double> values);

/// The same for the data of `objective` at values of its free parameters.
[[nodiscard]] Identifiability identifiability(const Objective& objective, std::span<const double> values);

/// The parameters that make up most of a direction: `a trades against b` where one rises and the other falls without
/// the spectrum changing as much as it would for either.
[[nodiscard]] std::string in_words(const Direction& direction, const std::vector<std::string>& names);

}  // namespace skinfit
