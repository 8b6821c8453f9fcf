#include "study/repeatability.hpp"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cassert>
#include <cmath>
#include <map>

namespace skinfit {
namespace {

using Groups = std::map<std::string, std::vector<RepeatedEstimate>>;

Groups groups_of(const std::vector<RepeatedEstimate>& repeats) {
    Groups groups;
    for (const RepeatedEstimate& repeat : repeats) {
        assert(!repeat.sigma || *repeat.sigma > 0.0);
        if (std::isfinite(repeat.estimate)) groups[repeat.specimen].push_back(repeat);
    }
    return groups;
}

double mean_of(const std::vector<RepeatedEstimate>& group) {
    double sum = 0.0;
    for (const RepeatedEstimate& repeat : group) sum += repeat.estimate;
    return sum / static_cast<double>(group.size());
}

/// Sums of squares within and between groups, with their degrees of freedom.
struct RepeatTable {
    double within_squares = 0.0;
    double between_squares = 0.0;
    double within_freedom = 0.0;
    double between_freedom = 0.0;
    double repeats_per_specimen = 0.0;  ///< k

    [[nodiscard]] double within() const { return within_squares / within_freedom; }
    [[nodiscard]] double between() const { return between_squares / between_freedom; }
};

RepeatTable table_of(const Groups& groups) {
    double count = 0.0;
    double sum = 0.0;
    double square_sizes = 0.0;
    for (const auto& [specimen, group] : groups) {
        const auto size = static_cast<double>(group.size());
        count += size;
        sum += size * mean_of(group);
        square_sizes += size * size;
    }
    RepeatTable table;
    for (const auto& [specimen, group] : groups) {
        const double mean = mean_of(group);
        for (const RepeatedEstimate& repeat : group) table.within_squares += std::pow(repeat.estimate - mean, 2);
        table.between_squares += static_cast<double>(group.size()) * std::pow(mean - sum / count, 2);
    }
    table.between_freedom = static_cast<double>(groups.size()) - 1.0;
    table.within_freedom = count - static_cast<double>(groups.size());
    table.repeats_per_specimen = (count - square_sizes / count) / table.between_freedom;
    return table;
}

/// [SHROUT79]
std::optional<IntervalEstimate> intraclass_correlation(const RepeatTable& table) {
    if (!(table.between_freedom > 0.0) || !(table.within_squares > 0.0)) return std::nullopt;
    constexpr double tail = 0.025;
    const double k = table.repeats_per_specimen;
    const auto correlation = [k](double ratio) { return (ratio - 1.0) / (ratio + k - 1.0); };
    const double ratio = table.between() / table.within();
    const boost::math::fisher_f law(table.between_freedom, table.within_freedom);
    return IntervalEstimate{
        .value = correlation(ratio),
        .interval_95 = {.lower = correlation(ratio / boost::math::quantile(boost::math::complement(law, tail))),
                        .upper = correlation(ratio / boost::math::quantile(law, tail))}};
}

std::optional<ClaimedScatter> claimed_of(const Groups& groups, const RepeatTable& table) {
    double expected_squares = 0.0;
    double chi_square = 0.0;
    for (const auto& [specimen, group] : groups) {
        if (group.size() < 2) continue;
        double weights = 0.0;
        double weighted = 0.0;
        double variances = 0.0;
        for (const RepeatedEstimate& repeat : group) {
            if (!repeat.sigma) return std::nullopt;
            const double variance = *repeat.sigma * *repeat.sigma;
            weights += 1.0 / variance;
            weighted += repeat.estimate / variance;
            variances += variance;
        }
        for (const RepeatedEstimate& repeat : group) {
            chi_square += std::pow((repeat.estimate - weighted / weights) / repeat.sigma.value_or(0.0), 2);
        }
        expected_squares += variances * (1.0 - 1.0 / static_cast<double>(group.size()));
    }
    const double sigma = std::sqrt(expected_squares / table.within_freedom);
    const double ratio = std::sqrt(table.within()) / sigma;
    const Bounds factors = standard_deviation_factors_95(table.within_freedom);
    return ClaimedScatter{
        .sigma = sigma,
        .ratio = {.value = ratio, .interval_95 = {.lower = ratio * factors.lower, .upper = ratio * factors.upper}},
        .chi_square = chi_square,
        .p_value = upper_chi_square_p_value(chi_square, table.within_freedom)};
}

}  // namespace

std::optional<RepeatabilityAnalysis> repeatability(const std::vector<RepeatedEstimate>& repeats) {
    const Groups groups = groups_of(repeats);
    std::size_t estimates = 0;
    for (const auto& [specimen, group] : groups) estimates += group.size();
    const auto repeated = static_cast<std::size_t>(
        std::ranges::count_if(groups, [](const auto& named) { return named.second.size() > 1; }));
    if (repeated == 0) return std::nullopt;
    const RepeatTable table = table_of(groups);
    const double sd = std::sqrt(table.within());
    const Bounds factors = standard_deviation_factors_95(table.within_freedom);
    RepeatabilityAnalysis found{
        .specimens = groups.size(),
        .repeated_specimens = repeated,
        .repeats = estimates,
        .without_estimate = repeats.size() - estimates,
        .within_specimen_sd = {.value = sd, .interval_95 = {.lower = sd * factors.lower, .upper = sd * factors.upper}},
        .within_degrees_of_freedom = estimates - groups.size(),
        .between_specimen_variance = {},
        .between_specimen_sd = {},
        .intraclass_correlation = intraclass_correlation(table),
        .claimed = claimed_of(groups, table)};
    if (groups.size() > 1) {
        const double variance = (table.between() - table.within()) / table.repeats_per_specimen;
        found.between_specimen_variance = variance;
        if (variance >= 0.0) found.between_specimen_sd = std::sqrt(variance);
    }
    return found;
}

}  // namespace skinfit
