#include "fit/fit_scale.hpp"

#include <algorithm>
#include <cmath>

namespace skinfit {
namespace {

/// About where a pigment's effect begins to saturate: below it effects are linear. Thicknesses and the fibril radius
/// scale effects by factors: their knee is their lower bound, which makes the scale a logarithm.
double knee(Parameter parameter, const Bounds& bounds) {
    switch (parameter) {
        case Parameter::melanosome_fraction:
            return 0.03;
        case Parameter::papillary_blood_fraction:
        case Parameter::reticular_blood_fraction:
            return 0.02;
        case Parameter::bilirubin_g_per_l:
            return 0.5;
        case Parameter::stratum_corneum_carotene_g_per_l:
        case Parameter::epidermis_carotene_g_per_l:
        case Parameter::dermis_carotene_g_per_l:
            return 0.001;
        case Parameter::stratum_corneum_thickness_cm:
        case Parameter::epidermis_thickness_cm:
        case Parameter::papillary_dermis_thickness_cm:
        case Parameter::reticular_dermis_thickness_cm:
        case Parameter::fibril_radius_nm:
        case Parameter::fold_aspect_ratio:
        case Parameter::scale:
            return bounds.lower;
        default:
            return 0.0;  // linear
    }
}

double knee(const FreeParameter& free) {
    return knee(free.parameter, free.bounds);
}

/// The width of the box in units of the knee, on the logarithmic scale.
double log_width(const FreeParameter& free) {
    return std::log1p((free.bounds.upper - free.bounds.lower) / knee(free));
}

double to_position(const FreeParameter& free, double value) {
    const double above = value - free.bounds.lower;
    if (knee(free) == 0.0) return above / (free.bounds.upper - free.bounds.lower);
    return std::log1p(above / knee(free)) / log_width(free);
}

double from_position(const FreeParameter& free, double position) {
    // Exactly the bound at 1, whatever the rounding.
    if (position == 1.0) return free.bounds.upper;
    if (knee(free) == 0.0) return free.bounds.lower + position * (free.bounds.upper - free.bounds.lower);
    return std::min(free.bounds.lower + knee(free) * std::expm1(position * log_width(free)), free.bounds.upper);
}

double slope(const FreeParameter& free, double position) {
    if (knee(free) == 0.0) return free.bounds.upper - free.bounds.lower;
    return knee(free) * log_width(free) * std::exp(position * log_width(free));
}

template <class Function>
std::vector<double> each(const FitProblem& problem, std::span<const double> numbers, Function function) {
    std::vector<double> results;
    for (std::size_t i = 0; i < numbers.size(); ++i) results.push_back(function(problem.free[i], numbers[i]));
    return results;
}

}  // namespace

bool has_logarithmic_scale(Parameter parameter) {
    const ParameterInfo& row = info(parameter);
    return knee(parameter, {.lower = row.lower, .upper = row.upper}) > 0.0;
}

std::vector<double> to_unit_box(const FitProblem& problem, std::span<const double> values) {
    return each(problem, values, to_position);
}

std::vector<double> from_unit_box(const FitProblem& problem, std::span<const double> positions) {
    return each(problem, positions, from_position);
}

std::vector<double> unit_box_slopes(const FitProblem& problem, std::span<const double> positions) {
    return each(problem, positions, slope);
}

}  // namespace skinfit
