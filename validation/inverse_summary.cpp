#include "validation/inverse_summary.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace skinfit {
namespace {

constexpr double improbable = 1e-3;  // chosen: of some twenty rules one fails by chance in a study of fifty

/// The probability that as few or fewer of `count` are hit, each with the probability `share`.
double as_few(std::size_t hit, std::size_t count, double share) {
    const boost::math::binomial_distribution<double> law(static_cast<double>(count), share);
    return boost::math::cdf(law, static_cast<double>(hit));
}

bool is_identifiable(const RecoveredParameter::Interval& interval) {
    return interval.status != Status::not_identifiable;
}

bool covers(const RecoveredParameter::Interval& interval, double truth) {
    return interval.interval_95.lower <= truth && truth <= interval.interval_95.upper;
}

/// A divisor of the number of ranks that leaves ten spectra or more per bin where it can.
std::size_t rank_bins(std::size_t spectra) {
    if (spectra >= 200) return 20;
    return spectra >= 100 ? 10 : 5;
}

/// Pearson's test that all bins are equally probable.
double equal_bins_p_value(const std::vector<std::size_t>& counts) {
    double total = 0.0;
    for (const std::size_t count : counts) total += static_cast<double>(count);
    const double expected = total / static_cast<double>(counts.size());
    double statistic = 0.0;
    for (const std::size_t count : counts) {
        const double difference = static_cast<double>(count) - expected;
        statistic += difference * difference / expected;
    }
    const boost::math::chi_squared_distribution<double> law(static_cast<double>(counts.size() - 1));
    return boost::math::cdf(boost::math::complement(law, statistic));
}

ParameterRecovery recovery_of(const std::vector<RecoveredSpectrum>& spectra, std::size_t column, Parameter parameter) {
    ParameterRecovery result{.parameter = parameter,
                             .bias = 0.0,
                             .root_mean_square_error = 0.0,
                             .coverage = {},
                             .ranks = std::vector<std::size_t>(rank_bins(spectra.size())),
                             .rank_p_value = {}};
    std::size_t judged = 0;
    bool is_ranked = false;
    for (const RecoveredSpectrum& spectrum : spectra) {
        const RecoveredParameter& found = spectrum.parameters[column];
        bool is_first = true;
        for (std::size_t method = 0; method < uncertainty_method_count; ++method) {
            const std::optional<RecoveredParameter::Interval>& interval = found.intervals[method];
            if (!interval) continue;
            if (!result.coverage[method]) result.coverage[method] = Coverage{.identifiable = 0, .covered = 0};
            if (is_identifiable(*interval)) {
                ++result.coverage[method]->identifiable;
                if (covers(*interval, found.truth)) ++result.coverage[method]->covered;
            }
            if (is_first && is_identifiable(*interval)) {
                const double miss = found.estimate - found.truth;
                result.bias += miss;
                result.root_mean_square_error += miss * miss;
                ++judged;
            }
            is_first = false;
        }
        if (!found.rank) continue;
        is_ranked = true;
        ++result.ranks[static_cast<std::size_t>(*found.rank) * result.ranks.size() / (ranked_draws + 1)];
    }
    const auto count = static_cast<double>(std::max<std::size_t>(judged, 1));
    result.bias /= count;
    result.root_mean_square_error = std::sqrt(result.root_mean_square_error / count);
    if (is_ranked) result.rank_p_value = equal_bins_p_value(result.ranks);
    return result;
}

template <class Condition>
Agreement agreement(const std::vector<RecoveredSpectrum>& spectra, double wanted_share, Condition condition) {
    return {.spectra = spectra.size(),
            .agreeing = static_cast<std::size_t>(std::ranges::count_if(spectra, condition)),
            .wanted_share = wanted_share};
}

}  // namespace

std::optional<bool> Coverage::passes() const {
    constexpr double wanted = 0.95;
    constexpr double harmless = 0.02;
    if (identifiable == 0) return std::nullopt;
    if (std::abs(share() - wanted) <= harmless) return true;
    const double tail = share() < wanted ? as_few(covered, identifiable, wanted)
                                         : as_few(identifiable - covered, identifiable, 1.0 - wanted);
    return 2.0 * tail >= improbable;
}

bool Agreement::passes() const {
    return share() >= wanted_share || as_few(agreeing, spectra, wanted_share) >= improbable;
}

bool ParameterRecovery::ranks_pass() const {
    return rank_p_value.value_or(1.0) >= improbable;
}

std::optional<bool> ParameterRecovery::coverage_passes(UncertaintyMethod method) const {
    const std::optional<Coverage>& found = coverage[static_cast<std::size_t>(method)];
    return found && method != UncertaintyMethod::covariance ? found->passes() : std::nullopt;
}

RecoverySummary summarised(const std::vector<RecoveredSpectrum>& spectra, const std::vector<FreeParameter>& free) {
    constexpr double same_minimum = 1e-3;    // of the cost: no parameter is a thirtieth of its sigma away
    constexpr double same_cost = 1e-6;       // relative
    constexpr double same_parameter = 0.05;  // sigmas
    const auto count = [&](auto condition) {
        return static_cast<std::size_t>(std::ranges::count_if(spectra, condition));
    };
    using Each = RecoveredSpectrum;
    RecoverySummary summary{
        .spectra = spectra.size(),
        .parameters = {},
        .best_minimum =
            agreement(spectra, 0.995, [](const Each& each) { return each.cost - each.best_cost <= same_minimum; }),
        .solvers_cost =
            agreement(spectra, 0.99,
                      [](const Each& each) { return std::abs(each.cost - each.other_cost) <= same_cost * each.cost; }),
        .solvers_parameters = agreement(
            spectra, 0.99, [](const Each& each) { return each.other_sigmas.value_or(0.0) <= same_parameter; }),
        .not_converged = count([](const Each& each) { return !each.converged; }),
        .not_mixed = count([](const Each& each) { return each.worst_r_hat >= 1.01; }),
        .diverged = count([](const Each& each) { return each.divergences > 0; })};
    for (std::size_t column = 0; column < free.size(); ++column) {
        summary.parameters.push_back(recovery_of(spectra, column, free[column].parameter));
    }
    return summary;
}

bool passes(const RecoverySummary& summary) {
    const bool agree =
        summary.best_minimum.passes() && summary.solvers_cost.passes() && summary.solvers_parameters.passes();
    return agree && std::ranges::all_of(summary.parameters, [](const ParameterRecovery& row) {
               return row.coverage_passes(UncertaintyMethod::profile).value_or(true) &&
                      row.coverage_passes(UncertaintyMethod::posterior).value_or(true) && row.ranks_pass();
           });
}

}  // namespace skinfit
