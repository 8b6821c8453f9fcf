#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/interval_estimate.hpp"

/// How estimates repeat when a specimen is measured again.
namespace skinfit {

/// One estimate of one specimen.
struct RepeatedEstimate {
    std::string specimen;         ///< what its repeats have in common
    double estimate;              ///< not a number: there is none, and the repeat is counted only
    std::optional<double> sigma;  ///< claimed standard deviation, above 0
};

/// Whether claimed sigmas explain the scatter of repeats.
struct ClaimedScatter {
    /// Root mean square of the claimed sigmas of repeats of repeated specimens, each specimen of k weighted by 1 - 1/k,
    /// as it is in the scatter.
    double sigma;
    IntervalEstimate ratio;  ///< within-specimen sd over `sigma`; the interval from chi-square
    double chi_square;       ///< of repeats about the weighted mean of their specimen, with `within_degrees_of_freedom`
    double p_value;          ///< that claimed sigmas give as much scatter or more; exact for normal errors
};

/// The scatter of repeats, by one-way analysis of variance with random specimens.
struct RepeatabilityAnalysis {
    std::size_t specimens;           ///< with an estimate
    std::size_t repeated_specimens;  ///< with two or more
    std::size_t repeats;             ///< estimates of all specimens
    std::size_t without_estimate;
    IntervalEstimate within_specimen_sd;  ///< pooled; the interval from chi-square
    std::size_t within_degrees_of_freedom;
    /// Variance of the true values of specimens, (mean square between - within) / k; negative where specimens differ
    /// less than their repeats by chance. k is the number of repeats, or for unequal numbers
    /// (N - sum k_i^2 / N) / (specimens - 1) [SEARLE92, Ch. 3]. None for one specimen.
    std::optional<double> between_specimen_variance;
    std::optional<double> between_specimen_sd;  ///< none where the variance is negative
    /// Intraclass correlation ICC(1, 1) [SHROUT79]: the share of the variance that is between specimens. The interval
    /// is exact for equal numbers of repeats, else an approximation by k. None for one specimen or without scatter.
    std::optional<IntervalEstimate> intraclass_correlation;
    std::optional<ClaimedScatter> claimed;  ///< none unless every repeat of a repeated specimen has a sigma
};

/// Groups `repeats` by specimen, in whatever order they come. None where no specimen has two estimates.
[[nodiscard]] std::optional<RepeatabilityAnalysis> repeatability(const std::vector<RepeatedEstimate>& repeats);

}  // namespace skinfit
