#include "fit/parameter_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace skinfit {
namespace {

/// One-sided where the minimum lies at a bound.
std::string interval_words(const FittedParameter& free, double grain) {
    const ParameterUncertainty& uncertainty = free.uncertainty;
    // Under a prior the lower end may lie decades below the upper one.
    const auto rounded_end = [&](double end) {
        return rounded(end, free.prior && end != 0.0 ? std::min(grain, std::abs(end)) : grain);
    };
    const std::string lower = rounded_end(uncertainty.interval_95.lower);
    const std::string upper = rounded_end(uncertainty.interval_95.upper);
    switch (uncertainty.status) {
        case Status::at_lower_bound:
            return "at most " + upper;
        case Status::at_upper_bound:
            return "at least " + lower;
        default:
            return lower + " to " + upper;
    }
}

std::string remark_on_status(Status status) {
    switch (status) {
        case Status::not_identifiable:
            return "NOT IDENTIFIABLE";
        case Status::at_lower_bound:
            return "AT LOWER BOUND";
        case Status::at_upper_bound:
            return "AT UPPER BOUND";
        default:
            return "";
    }
}

std::string remark_on(const FittedParameter& free) {
    const ParameterUncertainty& uncertainty = free.uncertainty;
    std::string remark = is_upper_limit(free) ? "NONE FOUND" : remark_on_status(uncertainty.status);
    if (!uncertainty.decided_by_prior) return remark;
    return remark + (remark.empty() ? "" : ", ") + "DECIDED BY ITS PRIOR";
}

}  // namespace

std::string rounded(double value, double sigma) {
    if (!(sigma > 0.0) || !std::isfinite(sigma)) return fmt::format("{:.6g}", value);
    const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, 12);
    return fmt::format("{:.{}f}", value, decimals);
}

std::string monte_carlo_words(double error) {
    return error > 0.0 ? rounded(error, error) : "none";
}

std::string prior_words(const FitResult& result) {
    std::vector<std::string> names;
    for (const FittedParameter& free : result.free) {
        if (free.uncertainty.decided_by_prior) names.push_back(free.name);
    }
    if (names.empty()) return "";
    return fmt::format(
        "{}: {}; the spectrum says less than the prior does, so value and interval are what was "
        "assumed, hardly what was measured",
        names.size() == 1 ? "DECIDED BY ITS PRIOR" : "DECIDED BY THEIR PRIORS", fmt::join(names, ", "));
}

ParameterWords parameter_words(const FittedParameter& free) {
    const ParameterUncertainty& uncertainty = free.uncertainty;
    const std::string_view unit = info(free.parameter).unit;
    const double grain = uncertainty.sigma.value_or((free.bounds.upper - free.bounds.lower) / 1000);
    const bool has_sigma = uncertainty.status == Status::free && uncertainty.sigma;
    return {.value = uncertainty.status == Status::not_identifiable ? "-" : rounded(free.value, grain),
            .sigma = has_sigma ? rounded(*uncertainty.sigma, grain) : "-",
            .monte_carlo = has_sigma ? monte_carlo_words(*uncertainty.monte_carlo_sigma) : "-",
            .interval_95 = interval_words(free, grain),
            .unit = unit.empty() ? "-" : std::string(unit),
            .remark = remark_on(free)};
}

}  // namespace skinfit
