#include "fit/problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input_error.hpp"
#include "fit/prior.hpp"
#include "fit/viewing.hpp"
#include "model/constants.hpp"

namespace skinfit {
namespace {

std::string key(const FreeParameter& free) {
    return fmt::format("free parameter {}", info(free.parameter).name);
}

void check_free(const FreeParameter& free, const Configuration& configuration) {
    const ParameterInfo& row = info(free.parameter);
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

void check_prior(const FreeParameter& free, const Bounds& bounds) {
    constexpr double least_mass = 0.1;
    if (!free.prior) return;
    const std::string where = fmt::format("priors.{}", info(free.parameter).name);
    const double most_probable = mode(*free.prior);
    if (!(most_probable >= bounds.lower && most_probable <= bounds.upper)) {
        throw InputError({.where = where,
                          .problem = fmt::format("is most probable at {:.6g}, outside the bounds", most_probable),
                          .why = fmt::format("they are {} and {}", bounds.lower, bounds.upper),
                          .remedy = "change the prior or the bounds"});
    }
    const double mass = mass_within(*free.prior, bounds);
    if (!(mass >= least_mass)) {
        throw InputError({.where = where,
                          .problem = fmt::format("has {:.2g} of its mass within the bounds", mass),
                          .why = fmt::format("prior and bounds {} to {} contradict each other below {}", bounds.lower,
                                             bounds.upper, least_mass),
                          .remedy = "change the prior or the bounds"});
    }
}

FreeParameter free_parameter(const Configuration& configuration, Parameter parameter) {
    const auto i = static_cast<std::size_t>(parameter);
    FreeParameter free{.parameter = parameter,
                       .start = value_of(configuration.values, parameter),
                       .bounds = configuration.bounds[i],
                       .prior = configuration.priors[i]};
    check_free(free, configuration);
    check_prior(free, free.bounds);
    if (!free.prior) return free;
    free.bounds = within_support(*free.prior, free.bounds);
    // A start on a bound that the prior excludes begins at the new bound.
    free.start = std::clamp(free.start, free.bounds.lower, free.bounds.upper);
    return free;
}

/// Those on quantities that the fit changes.
std::vector<DerivedPrior> derived_priors(const Configuration& configuration, const std::vector<FreeParameter>& free) {
    std::vector<DerivedPrior> priors;
    for (std::size_t i = 0; i < derived_count; ++i) {
        const std::optional<Prior>& prior = configuration.derived_priors[i];
        const auto quantity = static_cast<Derived>(i);
        const bool moves =
            std::ranges::any_of(free, [&](const FreeParameter& each) { return depends_on(quantity, each.parameter); });
        if (prior && moves) priors.push_back({.quantity = quantity, .prior = *prior});
    }
    return priors;
}

bool lies_in(double wavelength_nm, const Bounds& range_nm) {
    return wavelength_nm >= range_nm.lower && wavelength_nm <= range_nm.upper;
}

bool is_fitted(double wavelength_nm, const Configuration& configuration) {
    return lies_in(wavelength_nm, {configuration.wavelength_min_nm, configuration.wavelength_max_nm}) &&
           std::ranges::none_of(configuration.exclude_nm,
                                [&](const Bounds& range_nm) { return lies_in(wavelength_nm, range_nm); });
}

double weight_at(double wavelength_nm, const Configuration& configuration) {
    const auto found = std::ranges::find_if(
        configuration.weights, [&](const Weight& weight) { return lies_in(wavelength_nm, weight.range_nm); });
    return found == configuration.weights.end() ? 1.0 : found->weight;
}

void take_data(FitProblem& problem, const Configuration& configuration, const Spectrum& spectrum) {
    for (std::size_t i = 0; i < spectrum.wavelength_nm.size(); ++i) {
        const double wavelength_nm = spectrum.wavelength_nm[i];
        if (!is_fitted(wavelength_nm, configuration)) continue;
        problem.wavelength_nm.push_back(wavelength_nm);
        problem.measured.push_back(spectrum.value[i]);
        problem.sigma.push_back(spectrum.sigma.empty() ? configuration.noise : spectrum.sigma[i]);
        if (!configuration.weights.empty()) problem.weight.push_back(weight_at(wavelength_nm, configuration));
    }
    if (problem.wavelength_nm.empty()) {
        throw InputError({.where = "exclude_nm",
                          .problem = "leaves no wavelength of the window",
                          .why = "there is nothing to fit",
                          .remedy = "exclude less"});
    }
    const bool constant = std::ranges::adjacent_find(problem.measured, std::not_equal_to<>{}) == problem.measured.end();
    if (problem.measured.size() > 2 && constant) {
        throw InputError({.where = spectrum.source,
                          .problem = fmt::format("all {} values in the window are {}", problem.measured.size(),
                                                 problem.measured.front()),
                          .why = "no skin looks the same at every wavelength",
                          .remedy = "check the column and the file"});
    }
}

void check_count(const FitProblem& problem, const std::string& source) {
    const auto priors = static_cast<std::size_t>(std::ranges::count_if(
                            problem.free, [](const FreeParameter& free) { return free.prior.has_value(); })) +
                        problem.derived_priors.size();
    if (problem.wavelength_nm.size() + priors >= problem.free.size()) return;
    throw InputError({.where = source,
                      .problem = fmt::format("{} wavelengths in the window of the fit for {} free parameters",
                                             problem.wavelength_nm.size(), problem.free.size()),
                      .why = "fewer measurements and priors than unknowns leave the answer open",
                      .remedy = "fix parameters with --fix, state priors, or measure more wavelengths"});
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
                          .remedy = "set engine=paths or engine=solver"});
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
                                .seed = configuration.seed},
                       .discrepancy = configuration.discrepancy,
                       .loss = configuration.loss,
                       .loss_scale = configuration.loss_scale.value_or(default_loss_scale(configuration.loss))};
    take_data(problem, configuration, spectrum);
    for (const Parameter parameter : free_parameters(configuration)) {
        problem.free.push_back(free_parameter(configuration, parameter));
        check_shift(problem, problem.free.back());
    }
    if (problem.free.empty()) {
        throw InputError({.where = "free",
                          .problem = "no parameter is free",
                          .why = "there is nothing to fit",
                          .remedy = "free some with --free, or use `skinfit simulate`"});
    }
    problem.derived_priors = derived_priors(configuration, problem.free);
    check_count(problem, spectrum.source);
    return problem;
}

}  // namespace skinfit
