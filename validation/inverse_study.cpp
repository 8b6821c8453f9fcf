#include "validation/inverse_study.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace skinfit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The skin of one spectrum and its measurement.
struct Case {
    std::vector<double> truth;
    std::vector<double> measured;
};

Case drawn_case(const FitProblem& problem, const Simulator& simulate, const RecoveryDesign& design,
                std::uint64_t number) {
    // Apart from the chains of any posterior.
    ChainRandom random(design.seed, number + (std::uint64_t{1} << 62U));
    Case drawn;
    for (const FreeParameter& free : problem.free) {
        drawn.truth.push_back(free.bounds.lower + random.uniform() * (free.bounds.upper - free.bounds.lower));
    }
    for (const double reading : simulate(drawn.truth)) {
        drawn.measured.push_back(reading + design.noise * random.normal());
    }
    return drawn;
}

int rank_among(const Posterior& posterior, Index parameter, double truth) {
    const Index draws = posterior.draws.cols();
    int rank = 0;
    for (int k = 0; k < ranked_draws; ++k) {
        if (posterior.draws(parameter, draws * k / ranked_draws) < truth) ++rank;
    }
    return rank;
}

/// The same fit with each kind of interval in turn.
RecoveredSpectrum analysed(const Objective& objective, const std::vector<double>& truth, const Minimiser& minimise,
                           const RecoveryDesign& design, std::uint64_t number) {
    const Minimum minimum = minimise(objective);
    RecoveredSpectrum spectrum{.parameters = {},
                               .converged = minimum.converged,
                               .better_minimum = false,
                               .chi2_of_truth = 0.0,
                               .worst_r_hat = 1.0,
                               .divergences = 0};
    const Inference profiled = infer(objective, minimum, UncertaintyMethod::profile, design.seed);
    spectrum.better_minimum = profiled.profile->better_minimum;
    spectrum.chi2_of_truth = objective.misfit(truth).residual.squaredNorm() - profiled.profile->cost;
    const Uncertainty linear = estimate_uncertainty(objective, profiled.minimum);
    std::optional<Inference> sampled;
    if (design.with_posterior) {
        sampled = infer(objective, profiled.minimum, UncertaintyMethod::posterior, design.seed + number);
        spectrum.divergences = sampled->posterior->divergences;
    }
    const auto interval = [](const ParameterUncertainty& found) {
        return RecoveredParameter::Interval{.status = found.status, .interval_95 = found.interval_95};
    };
    for (std::size_t i = 0; i < truth.size(); ++i) {
        RecoveredParameter parameter{
            .truth = truth[i],
            .estimate = profiled.minimum.values[i],
            .intervals = {interval(linear.parameters[i]),
                          interval(profiled.uncertainty.parameters[i]),
                          {.status = Status::not_identifiable, .interval_95 = objective.problem().free[i].bounds}},
            .rank = 0};
        if (sampled) {
            parameter.intervals[2] = interval(sampled->uncertainty.parameters[i]);
            parameter.rank = rank_among(*sampled->posterior, static_cast<Index>(i), truth[i]);
            spectrum.worst_r_hat = std::max(spectrum.worst_r_hat, sampled->posterior->marginals[i].r_hat);
        }
        spectrum.parameters.push_back(parameter);
    }
    return spectrum;
}

}  // namespace

std::vector<RecoveredSpectrum> recover(const FitProblem& problem, const ForwardModel& model, const Simulator& simulate,
                                       const Minimiser& minimise, const RecoveryDesign& design) {
    std::vector<RecoveredSpectrum> recovered(design.spectra);
    constexpr std::size_t at_a_time = 10;  // they share one copy of the model
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, design.spectra, at_a_time), [&](const auto& range) {
        FitProblem own = problem;
        std::ranges::fill(own.sigma, design.noise);
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
            const Case drawn = drawn_case(problem, simulate, design, k);
            own.measured = drawn.measured;
            const Objective objective(own, model);
            recovered[k] = analysed(objective, drawn.truth, minimise, design, k);
        }
    });
    return recovered;
}

}  // namespace skinfit
