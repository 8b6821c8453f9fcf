#include "study/agreement.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

namespace skinfit {
namespace {

/// First and second moments, the latter as sums of products of deviations.
struct Moments {
    double count;
    double mean_estimate;
    double mean_reference;
    double estimate_squares;
    double reference_squares;
    double products;

    [[nodiscard]] double bias() const { return mean_estimate - mean_reference; }
};

Moments moments_of(const std::vector<ReferencePair>& pairs) {
    Moments found{.count = static_cast<double>(pairs.size()),
                  .mean_estimate = 0.0,
                  .mean_reference = 0.0,
                  .estimate_squares = 0.0,
                  .reference_squares = 0.0,
                  .products = 0.0};
    for (const ReferencePair& pair : pairs) {
        found.mean_estimate += pair.estimate / found.count;
        found.mean_reference += pair.reference / found.count;
    }
    for (const ReferencePair& pair : pairs) {
        const double estimate = pair.estimate - found.mean_estimate;
        const double reference = pair.reference - found.mean_reference;
        found.estimate_squares += estimate * estimate;
        found.reference_squares += reference * reference;
        found.products += estimate * reference;
    }
    return found;
}

IntervalEstimate around(double value, double half) {
    return {.value = value, .interval_95 = {.lower = value - half, .upper = value + half}};
}

/// A correlation with the interval that is `half` to each side on the scale of atanh.
IntervalEstimate correlation_around(double value, double half) {
    const double transformed = std::atanh(value);
    return {.value = value,
            .interval_95 = {.lower = std::tanh(transformed - half), .upper = std::tanh(transformed + half)}};
}

/// Of quantities that vary; rounding would take it a little beyond -1 and 1.
double pearson_of(const Moments& moments) {
    return std::clamp(moments.products / std::sqrt(moments.estimate_squares * moments.reference_squares), -1.0, 1.0);
}

IntervalEstimate pearson(const Moments& moments) {
    return correlation_around(pearson_of(moments), normal_deviate_95() / std::sqrt(moments.count - 3.0));
}

IntervalEstimate concordance(const Moments& moments) {
    const double spread = std::sqrt(moments.estimate_squares * moments.reference_squares);
    const double shift_squares = moments.count * moments.bias() * moments.bias();
    // The correlation is that of Pearson times this measure of how far the best line is from identity [LIN89].
    const double accuracy = 2.0 * spread / (moments.estimate_squares + moments.reference_squares + shift_squares);
    const double r = pearson_of(moments);
    const double rho = r * accuracy;
    const double left = 1.0 - rho * rho;
    if (!(left > 0.0)) return {.value = rho, .interval_95 = {.lower = rho, .upper = rho}};
    const double u2 = shift_squares / spread;
    // [LIN00], with rho / r written as accuracy so that r may be zero.
    const double variance =
        ((1.0 - r * r) * accuracy * accuracy / left + 2.0 * rho * rho * accuracy * (1.0 - rho) * u2 / (left * left) -
         0.5 * rho * rho * accuracy * accuracy * u2 * u2 / (left * left)) /
        (moments.count - 2.0);
    return correlation_around(rho, normal_deviate_95() * std::sqrt(std::max(variance, 0.0)));
}

AgreementLine line_of(const Moments& moments) {
    const double slope = moments.products / moments.reference_squares;
    const double freedom = moments.count - 2.0;
    const double residual = std::max(0.0, moments.estimate_squares - slope * moments.products) / freedom;
    const double deviate = student_deviate_95(freedom);
    const double intercept_variance =
        residual * (1.0 / moments.count + moments.mean_reference * moments.mean_reference / moments.reference_squares);
    return {.slope = around(slope, deviate * std::sqrt(residual / moments.reference_squares)),
            .intercept = around(moments.mean_estimate - slope * moments.mean_reference,
                                deviate * std::sqrt(intercept_variance))};
}

std::optional<ClaimedAgreement> claimed_of(const std::vector<ReferencePair>& pairs) {
    std::vector<double> z;
    for (const ReferencePair& pair : pairs) {
        if (pair.sigma) z.push_back((pair.estimate - pair.reference) / *pair.sigma);
    }
    if (z.empty()) return std::nullopt;
    const auto count = static_cast<double>(z.size());
    double sum = 0.0;
    double squares = 0.0;
    for (const double each : z) {
        sum += each;
        squares += each * each;
    }
    double deviations = 0.0;
    for (const double each : z) deviations += std::pow(each - sum / count, 2);
    return ClaimedAgreement{.pairs = z.size(),
                            .mean_z = sum / count,
                            .sd_z = z.size() > 1 ? std::optional(std::sqrt(deviations / (count - 1.0))) : std::nullopt,
                            .chi_square = squares,
                            .p_value = upper_chi_square_p_value(squares, count)};
}

std::optional<Proportion> coverage_of(const std::vector<ReferencePair>& pairs) {
    std::size_t covered = 0;
    std::size_t claimed = 0;
    for (const ReferencePair& pair : pairs) {
        if (!pair.interval_95 && !pair.sigma) continue;
        const Bounds interval = pair.interval_95
                                    ? *pair.interval_95
                                    : around(pair.estimate, normal_deviate_95() * pair.sigma.value_or(0.0)).interval_95;
        ++claimed;
        if (interval.lower <= pair.reference && pair.reference <= interval.upper) ++covered;
    }
    return claimed == 0 ? std::nullopt : std::optional(proportion(covered, claimed));
}

std::vector<ReferencePair> complete_of(const std::vector<ReferencePair>& pairs) {
    std::vector<ReferencePair> complete;
    std::ranges::copy_if(pairs, std::back_inserter(complete), [](const ReferencePair& pair) {
        assert(!pair.sigma || *pair.sigma > 0.0);
        return std::isfinite(pair.estimate) && std::isfinite(pair.reference);
    });
    return complete;
}

}  // namespace

std::optional<MethodAgreement> method_agreement(const std::vector<ReferencePair>& pairs) {
    const std::vector<ReferencePair> complete = complete_of(pairs);
    if (complete.size() < 2) return std::nullopt;
    const Moments moments = moments_of(complete);
    const double n = moments.count;
    double squares = 0.0;
    for (const ReferencePair& pair : complete) {
        squares += std::pow(pair.estimate - pair.reference - moments.bias(), 2);
    }
    const double sd = std::sqrt(squares / (n - 1.0));
    const double z = normal_deviate_95();
    const double deviate = student_deviate_95(n - 1.0);
    const double limit_half = deviate * sd * std::sqrt(1.0 / n + z * z / (2.0 * (n - 1.0)));  // [BLAND99]
    const bool vary = moments.estimate_squares > 0.0 && moments.reference_squares > 0.0;
    const bool have_correlation = complete.size() > 3 && vary;
    const bool have_line = complete.size() > 2 && moments.reference_squares > 0.0;
    return MethodAgreement{.pairs = complete.size(),
                           .incomplete_pairs = pairs.size() - complete.size(),
                           .bias = around(moments.bias(), deviate * sd / std::sqrt(n)),
                           .difference_sd = sd,
                           .lower_limit = around(moments.bias() - z * sd, limit_half),
                           .upper_limit = around(moments.bias() + z * sd, limit_half),
                           .pearson = have_correlation ? std::optional(pearson(moments)) : std::nullopt,
                           .concordance = have_correlation ? std::optional(concordance(moments)) : std::nullopt,
                           .line = have_line ? std::optional(line_of(moments)) : std::nullopt,
                           .claimed = claimed_of(complete),
                           .coverage = coverage_of(complete)};
}

}  // namespace skinfit
