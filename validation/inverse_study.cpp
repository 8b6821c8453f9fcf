#include "validation/inverse_study.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/input_error.hpp"
#include "fit/models.hpp"
#include "fit/multistart.hpp"
#include "fit/simulation.hpp"

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
    Case drawn{.truth = drawn_skin(problem, random), .measured = {}};
    const SimulatedReadings simulated = simulate(drawn.truth, number);
    for (Index row = 0; row < simulated.reading.size(); ++row) {
        const double missing = design.noise * design.noise - std::pow(simulated.standard_error[row], 2);
        if (!(missing >= 0.0)) {
            throw InputError({.where = "rays",
                              .problem = fmt::format("leave a noise of {:.2g} in a simulated reading",
                                                     simulated.standard_error[row]),
                              .why = fmt::format("the study wants one of {:g}", design.noise),
                              .remedy = "set more rays, or a larger noise"});
        }
        drawn.measured.push_back(simulated.reading[row] + std::sqrt(missing) * random.normal());
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

/// In standard deviations of `uncertainty`; none where no parameter has one.
std::optional<double> largest_difference(const Minimum& a, const Minimum& b, const Uncertainty& uncertainty) {
    std::optional<double> largest;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const std::optional<double>& sigma = uncertainty.parameters[i].sigma;
        if (sigma) largest = std::max(largest.value_or(0.0), std::abs(a.values[i] - b.values[i]) / *sigma);
    }
    return largest;
}

/// The objective of one spectrum, whole and cheap.
struct Searched {
    const Objective& cheap;
    const Objective& objective;

    [[nodiscard]] Minimum best(Solver solver, std::size_t count) const {
        return distinct_minima(cheap, objective, solver, count).minima.front().minimum;
    }
};

void add_intervals(UncertaintyMethod method, const Uncertainty& uncertainty, RecoveredSpectrum& spectrum) {
    for (std::size_t i = 0; i < spectrum.parameters.size(); ++i) {
        const ParameterUncertainty& found = uncertainty.parameters[i];
        spectrum.parameters[i].intervals[static_cast<std::size_t>(method)] =
            RecoveredParameter::Interval{.status = found.status, .interval_95 = found.interval_95};
    }
}

/// The same fit with each kind of interval in turn.
RecoveredSpectrum analysed(const Searched& searched, const Searched& elsewhere, const std::vector<double>& truth,
                           const RecoveryDesign& design, std::uint64_t number) {
    const Objective& objective = searched.objective;
    const auto wanted = [&](UncertaintyMethod method) { return design.intervals[static_cast<std::size_t>(method)]; };
    Minimum minimum = searched.best(Solver::ceres, design.starts);
    const Minimum other = searched.best(Solver::bobyqa, design.starts);
    const Minimum thorough = elsewhere.best(Solver::ceres, design.thorough_starts);
    RecoveredSpectrum spectrum{
        .parameters = std::vector<RecoveredParameter>(truth.size()),
        .converged = minimum.converged,
        .cost = minimum.cost,
        .best_cost = std::min({minimum.cost, other.cost, thorough.cost, objective.cost(truth)}),
        .other_cost = other.cost,
        .other_sigmas = largest_difference(minimum, other, estimate_uncertainty(objective, minimum)),
        .worst_r_hat = 1.0,
        .divergences = 0};
    if (wanted(UncertaintyMethod::covariance)) {
        add_intervals(UncertaintyMethod::covariance, estimate_uncertainty(objective, minimum), spectrum);
    }
    for (std::size_t i = 0; i < truth.size(); ++i) {
        spectrum.parameters[i].truth = truth[i];
        spectrum.parameters[i].estimate = minimum.values[i];
    }
    if (wanted(UncertaintyMethod::profile)) {
        const Inference profiled = infer(objective, minimum, UncertaintyMethod::profile, design.seed);
        add_intervals(UncertaintyMethod::profile, profiled.uncertainty, spectrum);
        spectrum.best_cost = std::min(spectrum.best_cost, profiled.profile->cost);
        minimum = profiled.minimum;
    }
    if (wanted(UncertaintyMethod::posterior)) {
        const Inference sampled = infer(objective, minimum, UncertaintyMethod::posterior, design.seed + number);
        add_intervals(UncertaintyMethod::posterior, sampled.uncertainty, spectrum);
        spectrum.divergences = sampled.posterior->divergences;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            spectrum.parameters[i].rank = rank_among(*sampled.posterior, static_cast<Index>(i), truth[i]);
            spectrum.worst_r_hat = std::max(spectrum.worst_r_hat, sampled.posterior->marginals[i].r_hat);
        }
    }
    return spectrum;
}

}  // namespace

std::vector<RecoveredSpectrum> recover(const FitProblem& problem, const std::vector<ForwardModel>& models,
                                       const Simulator& simulate, const RecoveryDesign& design,
                                       const RecoveryWatch& watch) {
    std::vector<std::optional<RecoveredSpectrum>> recovered(design.spectra);
    std::atomic<std::uint64_t> done = 0;
    const std::vector<ForwardModel> rough = cheap_models(problem, models);
    constexpr std::size_t at_a_time = 10;  // they share one copy of the models
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, design.spectra, at_a_time), [&](const auto& range) {
        if (watch.stop.stop_requested()) return;
        FitProblem own = problem;
        std::ranges::fill(own.only().sigma, design.noise);
        FitProblem shifted = own;
        ++shifted.seed;  // of the points from which searches start
        const Objective objective(own, models);
        const Objective cheap(own, rough);
        const Objective objective_elsewhere(shifted, models);
        const Objective cheap_elsewhere(shifted, rough);
        for (std::size_t k = range.begin(); k < range.end() && !watch.stop.stop_requested(); ++k) {
            const Case drawn = drawn_case(problem, simulate, design, k);
            own.only().measured = drawn.measured;
            shifted.only().measured = drawn.measured;
            recovered[k] = analysed({cheap, objective}, {cheap_elsewhere, objective_elsewhere}, drawn.truth, design, k);
            ++done;
            if (watch.progress) watch.progress(done);
        }
    });
    std::vector<RecoveredSpectrum> finished;
    for (std::optional<RecoveredSpectrum>& spectrum : recovered) {
        if (spectrum) finished.push_back(std::move(*spectrum));
    }
    return finished;
}

}  // namespace skinfit
