#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "study/interval_estimate.hpp"

/// How estimates agree with reference values of another method.
namespace skinfit {

/// An estimate and what the reference method found in the same specimen, in the same unit.
struct ReferencePair {
    double estimate;                    ///< not a number: there is none, and the pair is counted only
    double reference;                   ///< the same
    std::optional<double> sigma;        ///< claimed standard deviation of the difference, above 0
    std::optional<Bounds> interval_95;  ///< claimed for the reference value; none: estimate -/+ 1.96 sigma
};

/// estimate = intercept + slope reference, by least squares of the estimates. The references count as exact: the
/// question is what estimates show of a given reference value. A slope below 1 is shrinkage, by priors, or error of the
/// references, which flattens the line by their reliability.
struct AgreementLine {
    IntervalEstimate slope;  ///< Student's intervals
    IntervalEstimate intercept;
};

/// Whether the claimed uncertainties explain the differences.
struct ClaimedAgreement {
    std::size_t pairs;           ///< with a sigma
    double mean_z;               ///< of (estimate - reference) / sigma
    std::optional<double> sd_z;  ///< none for one pair
    double chi_square;           ///< sum of z squared, with as many degrees of freedom as pairs
    double p_value;              ///< that claimed sigmas, without bias, give as much or more
};

/// How two methods agree.
struct MethodAgreement {
    std::size_t pairs;  ///< 2 or more, of two numbers
    std::size_t incomplete_pairs;
    IntervalEstimate bias;  ///< mean of estimate - reference, Student's interval
    double difference_sd;
    IntervalEstimate lower_limit;  ///< of agreement: bias - 1.96 difference_sd
    IntervalEstimate upper_limit;
    std::optional<IntervalEstimate> pearson;      ///< correlation; none below 4 pairs, or where either does not vary
    std::optional<IntervalEstimate> concordance;  ///< Lin's, as `pearson`
    std::optional<AgreementLine> line;            ///< none below 3 pairs, or where the references do not vary
    std::optional<ClaimedAgreement> claimed;      ///< none without a sigma
    std::optional<Proportion> coverage;           ///< of the references by claimed 95 % intervals; none without any
};

/// Compares `pairs`; none for fewer than two complete ones.
///
/// Limits of agreement: [BLAND86]. The variance of a limit is that of difference_sd^2 (1/n + 1.96^2 / (2 (n - 1))),
/// [BLAND99], which [BLAND86] rounds to 3 difference_sd^2 / n; Student's interval. Pearson's correlation: on
/// the scale of atanh, with variance 1 / (n - 3) [FISHER21]. Concordance: [LIN89], on the scale of atanh, with the
/// variance as corrected in [LIN00].
[[nodiscard]] std::optional<MethodAgreement> method_agreement(const std::vector<ReferencePair>& pairs);

}  // namespace skinfit
