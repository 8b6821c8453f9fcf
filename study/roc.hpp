#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/interval_estimate.hpp"

/// How well a score tells positive from negative cases: the receiver operating characteristic (ROC).
namespace skinfit {

/// One case: the higher its score, the more it should be positive.
struct ScoredCase {
    std::optional<double> score;  ///< none, or not a number: it has none, and is counted only
    bool is_positive;
};

/// What calling positive from one score upwards makes of the cases that have a score.
struct OperatingPoint {
    double threshold;  ///< cases of this score or a higher one are called positive
    std::size_t true_positives;
    std::size_t false_positives;
    std::size_t true_negatives;
    std::size_t false_negatives;
    std::optional<Proportion> sensitivity;  ///< none without positive cases
    std::optional<Proportion> specificity;  ///< none without negative cases
};

/// Where the interval of an area comes from.
enum class RocIntervalRule {
    logit,      ///< [DELONG88] on the logit scale [PEPE03]
    separated,  ///< of an area of 0 or 1: exact and conservative
    hoeffding,  ///< where [DELONG88] gives no error: exact and conservative
};

/// The area under a curve: the probability that a positive case scores higher than a negative one, ties counting half.
struct RocArea {
    double value;
    std::optional<double> standard_error;  ///< [DELONG88]; none for a single positive or negative case
    Bounds interval_95;
    RocIntervalRule rule;
};

/// A receiver operating characteristic.
struct RocAnalysis {
    std::size_t positives;  ///< with a score
    std::size_t negatives;
    std::size_t positives_without_score;
    std::size_t negatives_without_score;
    /// From none called positive (threshold infinite) to all, one step per different score; empty without an area.
    std::vector<OperatingPoint> curve;
    std::optional<RocArea> area;
    std::string why_no_area;  ///< for the reader of a report; empty where there is one
};

/// The curve and its area.
///
/// Standard error: the variance of the structural components, [DELONG88]. Interval: logit(area) -/+ 1.96
/// standard errors over area (1 - area), so that it stays within 0 and 1. Of an area of 1 or 0 the standard error is
/// zero and says nothing. Of k = min(positives, negatives) disjoint pairs all are then in order, of which the
/// probability is area^k at most; the interval reaches to 0.025^(1/k), the binomial limit of [CLOPPER34]. With one
/// positive or negative case, or a standard error of zero otherwise, the interval is area -/+ sqrt(ln 40 / (2 k))
/// within 0 and 1, from Hoeffding's bound for U-statistics [HOEFFDING63].
[[nodiscard]] RocAnalysis roc_analysis(const std::vector<ScoredCase>& cases);

/// What `threshold` makes of the cases with a score.
[[nodiscard]] OperatingPoint operating_point(const std::vector<ScoredCase>& cases, double threshold);

/// The area that probabilities predict of themselves.
struct ExpectedRocArea {
    double value;
    double standard_deviation;  ///< of the area observed, when positives are drawn with these probabilities
};

/// The area under the curve of `probabilities`, each 0 to 1, that is to be expected if they are right: the expected
/// number of pairs of a positive and a negative case that are in order over the expected number of pairs, ties counting
/// half. None where no pair is possible. The standard deviation is that of the linear part of the observed area in the
/// labels (delta method), cases fixed: (observed - expected) / standard_deviation is standard normal for many cases
/// with calibrated probabilities.
[[nodiscard]] std::optional<ExpectedRocArea> expected_roc_area(const std::vector<double>& probabilities);

}  // namespace skinfit
