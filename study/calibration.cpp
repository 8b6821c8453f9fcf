#include "study/calibration.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace skinfit {
namespace {

struct Prediction {
    double probability;
    bool is_positive;
};

std::vector<Prediction> in_order(const std::vector<PredictedCase>& cases) {
    std::vector<Prediction> sorted;
    for (const PredictedCase& each : cases) {
        if (!each.probability || std::isnan(*each.probability)) continue;
        assert(*each.probability >= 0.0 && *each.probability <= 1.0);
        sorted.push_back({.probability = *each.probability, .is_positive = each.is_positive});
    }
    std::ranges::sort(sorted, {}, &Prediction::probability);
    return sorted;
}

CalibrationBin bin_of(const std::vector<Prediction>& sorted, std::size_t begin, std::size_t end) {
    double sum = 0.0;
    std::size_t positives = 0;
    for (std::size_t i = begin; i < end; ++i) {
        sum += sorted[i].probability;
        if (sorted[i].is_positive) ++positives;
    }
    return {.lowest_probability = sorted[begin].probability,
            .highest_probability = sorted[end - 1].probability,
            .mean_probability = sum / static_cast<double>(end - begin),
            .observed = proportion(positives, end - begin)};
}

std::vector<CalibrationBin> bins_of(const std::vector<Prediction>& sorted, std::size_t wanted) {
    std::vector<CalibrationBin> bins;
    std::size_t begin = 0;
    for (std::size_t number = 1; number <= wanted; ++number) {
        std::size_t end = number * sorted.size() / wanted;
        if (end <= begin) continue;
        while (end < sorted.size() && sorted[end].probability == sorted[end - 1].probability) ++end;
        bins.push_back(bin_of(sorted, begin, end));
        begin = end;
    }
    return bins;
}

/// `excess` in units of its standard deviation: infinite where what happened is impossible, none where all was certain.
std::optional<double> z_of(double excess, double variance) {
    if (variance > 0.0) return excess / std::sqrt(variance);
    if (excess == 0.0) return std::nullopt;
    return std::copysign(std::numeric_limits<double>::infinity(), excess);
}

std::optional<double> p_value_of(const std::optional<double>& z) {
    return z ? std::optional(two_sided_normal_p_value(*z)) : std::nullopt;
}

}  // namespace

std::optional<CalibrationAnalysis> calibration_analysis(const std::vector<PredictedCase>& cases, std::size_t bins) {
    assert(bins > 0);
    const std::vector<Prediction> sorted = in_order(cases);
    if (sorted.empty()) return std::nullopt;
    std::size_t observed = 0;
    double expected = 0.0;
    double variance = 0.0;  // of the number of positives
    double squares = 0.0;
    double excess = 0.0;           // of the squares, above what is expected
    double excess_variance = 0.0;  // [SPIEGELHALTER86]
    for (const auto& [p, is_positive] : sorted) {
        const double outcome = is_positive ? 1.0 : 0.0;
        if (is_positive) ++observed;
        expected += p;
        variance += p * (1.0 - p);
        squares += (outcome - p) * (outcome - p);
        excess += (outcome - p) * (1.0 - 2.0 * p);
        excess_variance += (1.0 - 2.0 * p) * (1.0 - 2.0 * p) * p * (1.0 - p);
    }
    const auto count = static_cast<double>(sorted.size());
    const std::optional<double> z = z_of(excess, excess_variance);
    return CalibrationAnalysis{
        .cases = sorted.size(),
        .without_probability = cases.size() - sorted.size(),
        .bins = bins_of(sorted, bins),
        .observed_positives = observed,
        .expected_positives = expected,
        .expected_positives_sd = std::sqrt(variance),
        .positives_p_value = p_value_of(z_of(static_cast<double>(observed) - expected, variance)),
        .brier_score = squares / count,
        .expected_brier_score = variance / count,
        .spiegelhalter_z = z,
        .spiegelhalter_p_value = p_value_of(z)};
}

}  // namespace skinfit
