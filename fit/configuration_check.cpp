#include "fit/configuration_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input_error.hpp"
#include "fit/wavelength_sets.hpp"
#include "model/chromophores.hpp"

namespace skinfit {
namespace {

void check_range(double first_nm, double last_nm, const std::string& where) {
    const WavelengthRange modelled = modelled_wavelengths();
    if (first_nm > last_nm) {
        throw InputError({.where = where,
                          .problem = fmt::format("{} nm is above {} nm", first_nm, last_nm),
                          .why = "no wavelength lies between them",
                          .remedy = "exchange them"});
    }
    if (first_nm >= modelled.lowest_nm && last_nm <= modelled.highest_nm) return;
    throw InputError(
        {.where = where,
         .problem = fmt::format("{} to {} nm reaches outside the tables", first_nm, last_nm),
         .why = fmt::format("the pigments are tabulated from {} to {} nm", modelled.lowest_nm, modelled.highest_nm),
         .remedy = "choose wavelengths inside that range"});
}

std::string free_names(const FitSettings& configuration) {
    std::string names;
    for (const Parameter parameter : free_parameters(configuration)) {
        names += (names.empty() ? "" : ", ") + std::string(info(parameter).name);
    }
    return names;
}

}  // namespace

void check_freedom(const FitSettings& configuration, const std::string& where) {
    const std::vector<Parameter> free = free_parameters(configuration);
    const bool skin_is_free =
        std::ranges::any_of(free, [](Parameter parameter) { return !belongs_to_instrument(parameter); });
    if (skin_is_free) return;
    const std::string names = free_names(configuration);
    throw InputError(
        {.where = where,
         .problem = names.empty() ? "no parameter is free" : fmt::format("frees only {}, nothing of the skin", names),
         .why = "the skin would stay as it is configured, whatever was measured",
         .remedy = "free parameters of the skin too, as --free melanosome_fraction does; in a file a list "
                   "of names replaces the default, and \"free\": [\"+scale\"] adds to it"});
}

void check_configuration(const Configuration& configuration, const std::string& where) {
    // One that frees nothing may be meant for simulations alone.
    if (!free_parameters(configuration).empty()) check_freedom(configuration, where + ": free");
    for (const Parameter parameter : free_parameters(configuration)) {
        const double start = value_of(configuration.values, parameter);
        const Bounds& bounds = configuration.bounds[static_cast<std::size_t>(parameter)];
        if (start >= bounds.lower && start <= bounds.upper) continue;
        throw InputError({.where = fmt::format("{}: parameters.{}", where, info(parameter).name),
                          .problem = fmt::format("starts at {}, outside its bounds", start),
                          .why = fmt::format("they are {} and {}", bounds.lower, bounds.upper),
                          .remedy = "set a value between them, widen them, or leave it out of \"free\""});
    }
    const std::vector<double> wavelengths_nm = parse_wavelengths(configuration.wavelengths, where + ": wavelengths");
    check_range(wavelengths_nm.front(), wavelengths_nm.back(), where + ": wavelengths");
    check_range(configuration.wavelength_min_nm, configuration.wavelength_max_nm,
                where + ": wavelength_min_nm, wavelength_max_nm");
}

}  // namespace skinfit
