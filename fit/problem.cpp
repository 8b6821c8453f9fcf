#include "fit/problem.hpp"

#include <fmt/format.h>

#include "core/input_error.hpp"
#include "fit/viewing.hpp"
#include "model/constants.hpp"

namespace skinfit {
namespace {

std::string key(const FreeParameter& free) {
    return fmt::format("free parameter {}", info(free.parameter).name);
}

void check_free(const FreeParameter& free, const Configuration& configuration) {
    const ParameterInfo& row = info(free.parameter);
    if (row.steers && configuration.engine == Engine::emulator) {
        throw InputError({.where = key(free),
                          .problem = "cannot be adjusted by engine emulator",
                          .why = "it changes where light goes, and an emulator stands for one geometry",
                          .remedy = fmt::format("set engine=solver, or fix it (--fix {})", row.name)});
    }
    if (row.steers && configuration.engine == Engine::paths) {
        throw InputError({.where = key(free),
                          .problem = "cannot be adjusted by engine paths",
                          .why = "it changes where light goes, so every recorded path would have to be traced again",
                          .remedy = fmt::format("set engine=solver, or fix it (--fix {})", row.name)});
    }
    if (free.parameter == Parameter::fold_aspect_ratio) {
        throw InputError({.where = key(free),
                          .problem = "has no effect",
                          .why = "folds turn the surface reflection without making it more or less",
                          .remedy = fmt::format("fix it (--fix {})", row.name)});
    }
    if (free.parameter == Parameter::specular_fraction &&
        (configuration.specular == Specular::included || configuration.quantity == Quantity::transmittance)) {
        throw InputError({.where = key(free),
                          .problem = "has no effect",
                          .why = "it scales the surface reflectance where specular is excluded",
                          .remedy = "fix it, or set specular=excluded for a reflectance"});
    }
    if (!(free.start >= free.bounds.lower && free.start <= free.bounds.upper)) {
        throw InputError({.where = key(free),
                          .problem = fmt::format("starts at {}, outside its bounds", free.start),
                          .why = fmt::format("they are {} and {}", free.bounds.lower, free.bounds.upper),
                          .remedy = "set a start between them, widen them in a configuration, or fix it"});
    }
}

/// A free shift must not lead the model outside the tables.
void check_shift(const FitProblem& problem, const FreeParameter& free) {
    if (free.parameter != Parameter::wavelength_shift_nm) return;
    const WavelengthRange modelled = modelled_wavelengths();
    const double lowest = problem.wavelength_nm.front() + free.bounds.lower;
    const double highest = problem.wavelength_nm.back() + free.bounds.upper;
    if (lowest > modelled.lowest_nm && highest < modelled.highest_nm) return;
    throw InputError(
        {.where = key(free),
         .problem = fmt::format("may lead to {} and {} nm", lowest, highest),
         .why = fmt::format("the pigments are tabulated from {} to {} nm", modelled.lowest_nm, modelled.highest_nm),
         .remedy = "narrow its bounds or the window of the fit"});
}

void check_wavelengths(const Configuration& configuration, const Spectrum& spectrum) {
    if (configuration.wavelength_min_nm > configuration.wavelength_max_nm) {
        throw InputError({.where = "wavelength_min_nm, wavelength_max_nm",
                          .problem = fmt::format("{} nm is not below {} nm", configuration.wavelength_min_nm,
                                                 configuration.wavelength_max_nm),
                          .why = "no wavelength lies between them",
                          .remedy = "exchange them"});
    }
    const WavelengthRange modelled = modelled_wavelengths();
    if (configuration.wavelength_min_nm < modelled.lowest_nm || configuration.wavelength_max_nm > modelled.highest_nm) {
        throw InputError(
            {.where = "wavelength_min_nm, wavelength_max_nm",
             .problem = fmt::format("{} to {} nm reaches outside the tables", configuration.wavelength_min_nm,
                                    configuration.wavelength_max_nm),
             .why = fmt::format("the pigments are tabulated from {} to {} nm", modelled.lowest_nm, modelled.highest_nm),
             .remedy = "narrow the window of the fit"});
    }
    if (spectrum.wavelength_nm.front() > configuration.wavelength_max_nm ||
        spectrum.wavelength_nm.back() < configuration.wavelength_min_nm) {
        throw InputError({.where = spectrum.source,
                          .problem = fmt::format("measured from {} to {} nm", spectrum.wavelength_nm.front(),
                                                 spectrum.wavelength_nm.back()),
                          .why = fmt::format("nothing of it lies in the window of the fit, {} to {} nm",
                                             configuration.wavelength_min_nm, configuration.wavelength_max_nm),
                          .remedy = fmt::format("check that wavelengths are in nm, or move the window with --set "
                                                "wavelength_min_nm=... and wavelength_max_nm=... within {} to {} nm",
                                                modelled.lowest_nm, modelled.highest_nm)});
    }
}

Configuration with_geometry(Configuration configuration, const Geometry& geometry) {
    if (!configuration.viewing_cone_deg) configuration.viewing_cone_deg = geometry.viewing_cone_deg;
    const bool cone = configuration.viewing_cone_deg.has_value();
    configuration.incidence_deg = configuration.incidence_deg.value_or(
        geometry.incidence_deg.value_or(cone ? default_incidence_deg_with_cone : default_incidence_deg));
    configuration.specular = configuration.specular.value_or(
        geometry.specular.value_or(cone ? default_specular_with_cone : default_specular));
    return configuration;
}

}  // namespace

Experiment make_experiment(const Configuration& configuration, const Geometry& geometry) {
    const Configuration complete = with_geometry(configuration, geometry);
    std::optional<double> viewing_cone_rad;
    if (complete.viewing_cone_deg) viewing_cone_rad = *complete.viewing_cone_deg * rad_per_deg;
    return {.values = configuration.values,
            .edition = configuration.edition,
            .layers = configuration.layers,
            .base = resolved_base(configuration),
            .incidence_rad = *complete.incidence_deg * rad_per_deg,
            .specular = *complete.specular,
            .viewing_cone_rad = viewing_cone_rad};
}

Configuration resolved(Configuration configuration, const Spectrum& spectrum) {
    configuration = with_geometry(configuration, spectrum.geometry);
    configuration.base = resolved_base(configuration);
    configuration.quantity = configuration.quantity.value_or(spectrum.quantity.value_or(default_quantity));
    return configuration;
}

FitProblem make_problem(const Configuration& configuration, const Spectrum& spectrum) {
    if (configuration.engine == Engine::walk) {
        throw InputError({.where = "engine",
                          .problem = "walk cannot be fitted",
                          .why = "its result moves in steps of one ray",
                          .remedy = "set engine=paths, engine=solver or engine=emulator"});
    }
    check_viewing_cone(configuration);
    check_wavelengths(configuration, spectrum);
    FitProblem problem{.experiment = make_experiment(configuration, spectrum.geometry),
                       .quantity = configuration.quantity.value(),
                       .wavelength_nm = {},
                       .measured = {},
                       .sigma = {},
                       .sigma_source = spectrum.sigma.empty()
                                           ? fmt::format("{} at every wavelength (setting noise)", configuration.noise)
                                           : "as the file states",
                       .free = {},
                       .walk = {.incidence_rad = configuration.incidence_deg.value() * rad_per_deg,
                                .rays = configuration.rays,
                                .seed = configuration.seed}};
    for (std::size_t i = 0; i < spectrum.wavelength_nm.size(); ++i) {
        const double wavelength_nm = spectrum.wavelength_nm[i];
        if (wavelength_nm < configuration.wavelength_min_nm || wavelength_nm > configuration.wavelength_max_nm)
            continue;
        problem.wavelength_nm.push_back(wavelength_nm);
        problem.measured.push_back(spectrum.value[i]);
        problem.sigma.push_back(spectrum.sigma.empty() ? configuration.noise : spectrum.sigma[i]);
    }
    for (const Parameter parameter : free_parameters(configuration)) {
        const FreeParameter free{.parameter = parameter,
                                 .start = value_of(configuration.values, parameter),
                                 .bounds = configuration.bounds[static_cast<std::size_t>(parameter)]};
        check_free(free, configuration);
        check_shift(problem, free);
        problem.free.push_back(free);
    }
    if (problem.free.empty()) {
        throw InputError({.where = "free",
                          .problem = "no parameter is free",
                          .why = "there is nothing to fit",
                          .remedy = "free some with --free, or use `skinfit simulate`"});
    }
    if (problem.wavelength_nm.size() < problem.free.size()) {
        throw InputError({.where = spectrum.source,
                          .problem = fmt::format("{} wavelengths in the window of the fit for {} free parameters",
                                                 problem.wavelength_nm.size(), problem.free.size()),
                          .why = "fewer measurements than unknowns leave the answer open",
                          .remedy = "fix parameters with --fix, or measure more wavelengths"});
    }
    return problem;
}

}  // namespace skinfit
