#pragma once

#include <optional>
#include <vector>

#include "study/studied_spectrum.hpp"

namespace skinfit {

/// What is believed of one quantity of one spectrum after the fit: its marginal distribution, by quantiles at evenly
/// spaced probabilities from 0 to 1, linear between them.
class MarginalDistribution {
public:
    /// `quantiles`: at least two, ascending.
    explicit MarginalDistribution(std::vector<double> quantiles);

    /// The probability of values above `threshold`.
    [[nodiscard]] double probability_above(double threshold) const;

    /// The probability that a value of this exceeds one of `other`, the two being independent.
    [[nodiscard]] double probability_above(const MarginalDistribution& other) const;

private:
    std::vector<double> quantiles_;
};

/// The marginal distribution of a parameter: that of the posterior where it was sampled. Otherwise what the interval
/// says, cut at the bounds of the fit: in the natural coordinate of the parameter, that of its prior, two halves of
/// normal distributions that meet at the value, each with the standard deviation that puts its end of the interval at
/// the normal distribution's 97.5 %; of a parameter at a bound one half, whose limit lies 1.645 standard deviations
/// away, where the cost has risen by 2.71
/// (`estimate_uncertainty`). None for one that is not identifiable or whose interval is the whole range: the spectrum
/// does not tell.
[[nodiscard]] std::optional<MarginalDistribution> marginal_of(const ParameterEstimate& estimate);

/// That of a quantity of the tissue: of the posterior where it was sampled, else two halves of normal distributions of
/// its logarithm, which meet at the value and have the ends of the interval at 1.96 standard deviations; of one that is
/// zero half a normal distribution, with its limit there. None without an interval.
[[nodiscard]] std::optional<MarginalDistribution> marginal_of(const TissueValue& estimate);

/// A normal distribution.
[[nodiscard]] MarginalDistribution marginal_of(const IndexValue& index);

}  // namespace skinfit
