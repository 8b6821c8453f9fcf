#include "validation/inverse_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "fit/report.hpp"

namespace skinfit {
namespace {

constexpr std::size_t rank_bins = 20;
constexpr std::array<const char*, uncertainty_methods> method_names = {"covariance", "profile", "posterior"};

bool is_identifiable(const RecoveredParameter::Interval& interval) {
    return interval.status != Status::not_identifiable;
}

bool covers(const RecoveredParameter::Interval& interval, double truth) {
    return interval.interval_95.lower <= truth && truth <= interval.interval_95.upper;
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
                             .ranks = std::vector<std::size_t>(rank_bins),
                             .rank_p_value = 1.0};
    for (const RecoveredSpectrum& spectrum : spectra) {
        const RecoveredParameter& found = spectrum.parameters[column];
        for (std::size_t method = 0; method < uncertainty_methods; ++method) {
            if (!is_identifiable(found.intervals[method])) continue;
            ++result.coverage[method].identifiable;
            if (covers(found.intervals[method], found.truth)) ++result.coverage[method].covered;
        }
        ++result.ranks[static_cast<std::size_t>(found.rank) * rank_bins / (ranked_draws + 1)];
        if (!is_identifiable(found.intervals[1])) continue;
        const double miss = found.estimate - found.truth;
        result.bias += miss;
        result.root_mean_square_error += miss * miss;
    }
    const auto identifiable = static_cast<double>(std::max<std::size_t>(result.coverage[1].identifiable, 1));
    result.bias /= identifiable;
    result.root_mean_square_error = std::sqrt(result.root_mean_square_error / identifiable);
    if (result.coverage[2].identifiable > 0) result.rank_p_value = equal_bins_p_value(result.ranks);
    return result;
}

std::string coverage_words(const Coverage& coverage) {
    const std::optional<bool> passes = coverage.passes();
    if (!passes) return fmt::format("{:>7} of {:<4}", "-", coverage.identifiable);
    return fmt::format("{:>6.1f} % of {:<4}{}", 100.0 * coverage.share(), coverage.identifiable,
                       *passes ? "" : " FAILS");
}

}  // namespace

std::optional<bool> Coverage::passes() const {
    constexpr std::size_t enough = 20;
    if (identifiable < enough) return std::nullopt;
    // What three binomial deviations explain is no failure of the method: in 1000 spectra 2.1 %.
    const double chance = 3.0 * std::sqrt(0.95 * 0.05 / static_cast<double>(identifiable));
    return std::abs(share() - 0.95) <= std::max(0.02, chance);
}

RecoverySummary summarised(const std::vector<RecoveredSpectrum>& spectra, const std::vector<FreeParameter>& free) {
    RecoverySummary summary{.spectra = spectra.size(),
                            .parameters = {},
                            .not_converged = 0,
                            .missed_minimum = 0,
                            .not_mixed = 0,
                            .diverged = 0};
    for (const RecoveredSpectrum& spectrum : spectra) {
        if (!spectrum.converged) ++summary.not_converged;
        if (spectrum.chi2_of_truth < -1e-3) ++summary.missed_minimum;
        if (spectrum.worst_r_hat >= 1.01) ++summary.not_mixed;
        if (spectrum.divergences > 0) ++summary.diverged;
    }
    for (std::size_t column = 0; column < free.size(); ++column) {
        summary.parameters.push_back(recovery_of(spectra, column, free[column].parameter));
    }
    return summary;
}

std::string recovery_csv(const std::vector<RecoveredSpectrum>& spectra, const std::vector<FreeParameter>& free) {
    std::string text = "spectrum,parameter,truth,estimate";
    for (const char* const method : method_names) {
        text += fmt::format(",{0}_status,{0}_lower,{0}_upper", method);
    }
    text += ",rank\n";
    for (std::size_t k = 0; k < spectra.size(); ++k) {
        for (std::size_t column = 0; column < free.size(); ++column) {
            const RecoveredParameter& found = spectra[k].parameters[column];
            text += fmt::format("{},{},{},{}", k + 1, info(free[column].parameter).name, found.truth, found.estimate);
            for (const RecoveredParameter::Interval& interval : found.intervals) {
                text += fmt::format(",{},{},{}", name_of(interval.status), interval.interval_95.lower,
                                    interval.interval_95.upper);
            }
            text += fmt::format(",{}\n", found.rank);
        }
    }
    return text;
}

std::string recovery_text(const RecoverySummary& summary) {
    std::string text = fmt::format(
        "{} spectra: {} not converged, {} missed the best minimum, {} posteriors not mixed, "
        "{} with divergences\n",
        summary.spectra, summary.not_converged, summary.missed_minimum, summary.not_mixed, summary.diverged);
    text += fmt::format("{:<34}{:>12}{:>12}{:>23}{:>23}{:>23}{:>10}\n", "coverage of 95 % intervals", "bias", "RMSE",
                        method_names[0], method_names[1], method_names[2], "ranks: p");
    for (const ParameterRecovery& row : summary.parameters) {
        text += fmt::format("{:<34}{:>12.3g}{:>12.3g}", info(row.parameter).name, row.bias, row.root_mean_square_error);
        for (const Coverage& coverage : row.coverage) text += fmt::format("{:>23}", coverage_words(coverage));
        text += fmt::format("{:>10.2g}\n", row.rank_p_value);
    }
    return text;
}

}  // namespace skinfit
