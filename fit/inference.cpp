#include "fit/inference.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace skinfit {
namespace {

using Eigen::Index;

bool is_at_bound(Status status) {
    return status == Status::at_lower_bound || status == Status::at_upper_bound;
}

/// `linear` with another interval, identifiable or not as that says.
ParameterUncertainty with_interval(ParameterUncertainty linear, const FreeParameter& free, const Bounds& interval,
                                   bool is_identifiable) {
    const bool decided_by_prior = is_decided_by_prior(free, interval);
    if (!is_identifiable) {
        return {.status = Status::not_identifiable,
                .sigma = std::nullopt,
                .monte_carlo_sigma = std::nullopt,
                .interval_95 = interval,
                .decided_by_prior = decided_by_prior};
    }
    linear.interval_95 = interval;
    linear.decided_by_prior = decided_by_prior;
    if (!is_at_bound(linear.status)) linear.status = Status::free;
    return linear;
}

/// `profile` of positions as one of values.
Profile in_values(Profile profile, const FitProblem& problem) {
    const std::vector<double> minimum = values_at(problem, profile.minimum);
    profile.minimum = Eigen::VectorXd::Map(minimum.data(), static_cast<Index>(minimum.size()));
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        const FreeParameter& free = problem.free[i];
        const Bounds bounds = natural_bounds(free);
        ProfileInterval& interval = profile.intervals[i];
        interval.lower = value_at_position(free, interval.lower);
        interval.upper = value_at_position(free, interval.upper);
        for (ProfilePoint& point : interval.curve) {
            const double value = value_at_position(free, point.at);
            point = {
                .at = value,
                .cost_rise = point.cost_rise,
                .cost_slope = point.cost_slope * coordinate_slope(free.prior, value) / (bounds.upper - bounds.lower),
                .cost_rise_95 = point.cost_rise_95};
        }
    }
    return profile;
}

void use_profile(const Objective& objective, Inference& inference) {
    const FitProblem& problem = objective.problem();
    inference.profile = profile_intervals(in_unit_box(objective), box_position(problem, inference.minimum.values));
    if (inference.profile->better_minimum) {
        inference.minimum.values = values_at(problem, inference.profile->minimum);
        judge(objective, inference.minimum);
        inference.minimum.evaluations += inference.profile->evaluations;
        inference.uncertainty = estimate_uncertainty(objective, inference.minimum);
    }
    inference.profile = in_values(*std::move(inference.profile), problem);
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        const ProfileInterval& found = inference.profile->intervals[i];
        const Bounds& bounds = problem.free[i].bounds;
        ParameterUncertainty& row = inference.uncertainty.parameters[i];
        row = with_interval(row, problem.free[i], {found.lower, found.upper}, !found.is_everything());
        if (row.status != Status::free) continue;
        // The linear model calls what is flat at its bound not identifiable before it asks where it lies.
        if (inference.minimum.values[i] == bounds.lower) row.status = Status::at_lower_bound;
        if (inference.minimum.values[i] == bounds.upper) row.status = Status::at_upper_bound;
    }
}

/// `posterior` of positions as one of values.
Posterior in_values(Posterior posterior, const std::vector<FreeParameter>& free) {
    for (std::size_t i = 0; i < free.size(); ++i) {
        Marginal& marginal = posterior.marginals[i];
        for (double* const place : {&marginal.median, &marginal.lower, &marginal.upper}) {
            *place = value_at_position(free[i], *place);
        }
        auto draws = posterior.draws.row(static_cast<Index>(i));
        for (double& draw : draws) draw = value_at_position(free[i], draw);
        marginal.mean = draws.mean();
        marginal.sigma =
            std::sqrt((draws.array() - marginal.mean).square().sum() / static_cast<double>(draws.size() - 1));
    }
    posterior.correlation = correlation_of(posterior.draws);
    return posterior;
}

void use_posterior(const Objective& objective, std::uint64_t seed, Inference& inference) {
    const FitProblem& problem = objective.problem();
    const Posterior positions =
        sample_posterior(in_unit_box(objective), box_position(problem, inference.minimum.values), {.seed = seed});
    inference.posterior = in_values(positions, problem.free);
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        const FreeParameter& free = problem.free[i];
        const Bounds bounds = natural_bounds(free);
        const double relative = positions.marginals[i].sigma * (bounds.upper - bounds.lower) / prior_sigma(free);
        const double shrinkage = 1.0 - relative * relative;
        inference.identifiability.shrinkage[i] = shrinkage;
        const Marginal& marginal = inference.posterior->marginals[i];
        ParameterUncertainty& row = inference.uncertainty.parameters[i];
        row = with_interval(row, free, {marginal.lower, marginal.upper}, free.prior || shrinkage >= 0.5);
    }
}

}  // namespace

Inference infer(const Objective& objective, const Minimum& minimum, UncertaintyMethod method, std::uint64_t seed) {
    Inference inference{.minimum = minimum,
                        .uncertainty = estimate_uncertainty(objective, minimum),
                        .identifiability = {},
                        .profile = {},
                        .posterior = {}};
    if (method == UncertaintyMethod::profile) use_profile(objective, inference);
    inference.identifiability = identifiability(objective, inference.minimum.values);
    if (method == UncertaintyMethod::posterior) use_posterior(objective, seed, inference);
    return inference;
}

std::string samples_csv(const Posterior& posterior, const std::vector<std::string>& names) {
    std::string text = "chain,draw";
    for (const std::string& name : names) text += "," + name;
    text += "\n";
    const Index draws = posterior.draws.cols() / posterior.chains;
    for (Index column = 0; column < posterior.draws.cols(); ++column) {
        text += fmt::format("{},{}", column / draws + 1, column % draws + 1);
        for (const double value : posterior.draws.col(column)) text += fmt::format(",{}", value);
        text += "\n";
    }
    return text;
}

}  // namespace skinfit
