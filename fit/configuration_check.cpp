#include "fit/configuration_check.hpp"

#include <fmt/format.h>

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

}  // namespace

void check_configuration(const Configuration& configuration, const std::string& where) {
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
