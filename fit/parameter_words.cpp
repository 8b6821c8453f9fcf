#include "fit/parameter_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skinfit {
namespace {

/// One-sided where the minimum lies at a bound.
std::string interval_words(const ParameterUncertainty& uncertainty, double grain) {
    const std::string lower = rounded(uncertainty.interval_95.lower, grain);
    const std::string upper = rounded(uncertainty.interval_95.upper, grain);
    switch (uncertainty.status) {
        case Status::at_lower_bound:
            return "at most " + upper;
        case Status::at_upper_bound:
            return "at least " + lower;
        default:
            return lower + " to " + upper;
    }
}

std::string remark_on(Status status) {
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

}  // namespace

std::string rounded(double value, double sigma) {
    if (!(sigma > 0.0) || !std::isfinite(sigma)) return fmt::format("{:.6g}", value);
    const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, 12);
    return fmt::format("{:.{}f}", value, decimals);
}

std::string monte_carlo_words(double error) {
    return error > 0.0 ? rounded(error, error) : "none";
}

ParameterWords parameter_words(const FittedParameter& free) {
    const ParameterUncertainty& uncertainty = free.uncertainty;
    const std::string_view unit = info(free.parameter).unit;
    const double grain = uncertainty.sigma.value_or((free.bounds.upper - free.bounds.lower) / 1000);
    const bool has_sigma = uncertainty.status == Status::free && uncertainty.sigma;
    return {.value = uncertainty.status == Status::not_identifiable ? "-" : rounded(free.value, grain),
            .sigma = has_sigma ? rounded(*uncertainty.sigma, grain) : "-",
            .monte_carlo = has_sigma ? monte_carlo_words(*uncertainty.monte_carlo_sigma) : "-",
            .interval_95 = interval_words(uncertainty, grain),
            .unit = unit.empty() ? "-" : std::string(unit),
            .remark = remark_on(uncertainty.status)};
}

}  // namespace skinfit
