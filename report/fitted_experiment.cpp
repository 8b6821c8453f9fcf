#include "report/fitted_experiment.hpp"

#include "fit/measurement.hpp"
#include "fit/problem.hpp"

namespace skinfit {
namespace {

/// Whether `fitted` is free in that spectrum: in all of them, or in this one alone.
bool belongs_to(const FittedParameter& fitted, std::size_t number) {
    FreeParameter free{.parameter = fitted.parameter, .start = fitted.start, .bounds = fitted.bounds};
    if (name_of(free) == fitted.name) return true;
    free.measurement = number;
    return name_of(free) == fitted.name;
}

}  // namespace

Experiment fitted_experiment(const FitResult& result, std::size_t number) {
    ResolvedConfiguration configuration = result.spectra[number].configuration;
    for (const FittedParameter& fitted : result.free) {
        if (belongs_to(fitted, number)) value_of(configuration.values, fitted.parameter) = fitted.value;
    }
    return make_experiment(configuration);
}

}  // namespace skinfit
