#include "fit/runs_test.hpp"

#include <algorithm>
#include <cmath>

namespace skinfit {
namespace {

/// log of n over k; minus infinity where it is zero.
double log_choices(int n, int k) {
    if (k < 0 || k > n) return -INFINITY;
    return std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0);
}

/// The share of the orders of `positive` and `negative` signs that have exactly `runs` runs.
double probability(int runs, int positive, int negative) {
    const double all = log_choices(positive + negative, positive);
    const int half = runs / 2;
    if (runs % 2 == 0) {
        return 2.0 * std::exp(log_choices(positive - 1, half - 1) + log_choices(negative - 1, half - 1) - all);
    }
    return std::exp(log_choices(positive - 1, half) + log_choices(negative - 1, half - 1) - all) +
           std::exp(log_choices(positive - 1, half - 1) + log_choices(negative - 1, half) - all);
}

}  // namespace

std::optional<double> runs_p_value(std::span<const double> residuals) {
    const auto positive =
        static_cast<int>(std::ranges::count_if(residuals, [](double residual) { return residual > 0.0; }));
    const int negative = static_cast<int>(residuals.size()) - positive;
    if (positive == 0 || negative == 0) return std::nullopt;
    int runs = 1;
    for (std::size_t i = 1; i < residuals.size(); ++i) {
        if ((residuals[i] > 0.0) != (residuals[i - 1] > 0.0)) ++runs;
    }
    double sum = 0.0;
    for (int fewer = 2; fewer <= runs; ++fewer) sum += probability(fewer, positive, negative);
    return std::min(sum, 1.0);
}

}  // namespace skinfit
