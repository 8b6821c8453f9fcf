#include "fit/problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input_error.hpp"
#include "fit/prior.hpp"
#include "model/chromophores.hpp"
#include "model/emulator.hpp"

namespace skinfit {
namespace {

std::string key(const FreeParameter& free) {
    return fmt::format("free parameter {}", info(free.parameter).name);
}

void check_free(const FreeParameter& free, const FitSettings& configuration) {
    const ParameterInfo& row = info(free.parameter);
    if (free.parameter == Parameter::fold_aspect_ratio) {
        throw InputError({.where = key(free),
                          .problem = "has no effect",
                          .why = "folds turn the surface reflection without making it more or less",
                          .remedy = fmt::format("fix it (--fix {})", row.name)});
    }
    if (configuration.engine == Engine::emulator) refuse_to_emulate(free.parameter);
    if (row.steers && configuration.engine == Engine::paths) {
        throw InputError({.where = key(free),
                          .problem = "cannot be adjusted by engine paths",
                          .why = "it changes where light goes, so every recorded path would have to be traced again",
                          .remedy = fmt::format("set engine=solver, or fix it (--fix {})", row.name)});
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
    const double median = prior_median(*free.prior);
    if (!(median >= bounds.lower && median <= bounds.upper)) {
        throw InputError({.where = where,
                          .problem = fmt::format("has its median at {:.6g}, outside the bounds", median),
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

FreeParameter free_parameter(const FitSettings& configuration, Parameter parameter) {
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

void check_own(const FitSettings& configuration) {
    for (const ParameterInfo& row : parameter_table()) {
        const auto place = static_cast<std::size_t>(row.parameter);
        if (!configuration.own[place] || configuration.free[place]) continue;
        throw InputError({.where = fmt::format("own: {}", row.name),
                          .problem = "is not free",
                          .why = "only what is adjusted can have a value of its own in each spectrum",
                          .remedy = fmt::format("free it (--own {} does), or leave it out", row.name)});
    }
}

/// Once for all measurements, or once for each where the parameter is its own.
void add_free(const FitSettings& configuration, Parameter parameter, FitProblem& problem) {
    FreeParameter free = free_parameter(configuration, parameter);
    const bool own = configuration.own[static_cast<std::size_t>(parameter)] && problem.measurements.size() > 1;
    if (!own) {
        problem.free.push_back(free);
        return;
    }
    for (std::size_t number = 0; number < problem.measurements.size(); ++number) {
        free.measurement = number;
        problem.free.push_back(free);
    }
}

/// Those on quantities that the fit changes: of each measurement where a parameter of theirs is its own.
void add_derived_priors(const FitSettings& configuration, FitProblem& problem) {
    for (std::size_t i = 0; i < derived_count; ++i) {
        const std::optional<Prior>& prior = configuration.derived_priors[i];
        const auto quantity = static_cast<Derived>(i);
        bool moves = false;
        bool own = false;
        for (const FreeParameter& free : problem.free) {
            if (!depends_on(quantity, free.parameter)) continue;
            moves = true;
            own = own || free.measurement.has_value();
        }
        if (!prior || !moves) continue;
        for (std::size_t number = 0; number < (own ? problem.measurements.size() : 1); ++number) {
            problem.derived_priors.push_back({.quantity = quantity, .prior = *prior, .measurement = number});
        }
    }
}

void check_count(const FitProblem& problem) {
    const auto with_prior = static_cast<std::size_t>(std::ranges::count_if(
                                problem.free, [](const FreeParameter& free) { return free.prior.has_value(); })) +
                            problem.derived_priors.size();
    std::size_t readings = 0;
    std::string sources;
    for (const Measurement& measurement : problem.measurements) {
        readings += measurement.wavelength_nm.size();
        sources += (sources.empty() ? "" : ", ") + measurement.source;
    }
    if (readings + with_prior >= problem.free.size()) return;
    throw InputError({.where = sources,
                      .problem = fmt::format("{} wavelengths in the window of the fit for {} free parameters", readings,
                                             problem.free.size()),
                      .why = "fewer measurements and priors than unknowns leave the answer open",
                      .remedy = "fix parameters with --fix, state priors, or measure more wavelengths"});
}

/// A free shift must not lead the model outside the tables.
void check_shift(const Measurement& measurement, const FreeParameter& free) {
    const WavelengthRange modelled = modelled_wavelengths();
    const double lowest = measurement.bands.wavelength_nm.front() + free.bounds.lower;
    const double highest = measurement.bands.wavelength_nm.back() + free.bounds.upper;
    if (lowest >= modelled.lowest_nm && highest <= modelled.highest_nm) return;
    throw InputError(
        {.where = key(free),
         .problem = fmt::format("may lead to {} and {} nm", lowest, highest),
         .why = fmt::format("the pigments are tabulated from {} to {} nm", modelled.lowest_nm, modelled.highest_nm),
         .remedy = "narrow its bounds or the window of the fit"});
}

void check_specular_fraction(const FitProblem& problem, const FreeParameter& free) {
    bool reflects = false;
    for (std::size_t number = 0; number < problem.measurements.size(); ++number) {
        const Measurement& measurement = problem.measurements[number];
        if (!free.belongs_to(number) || measurement.quantity != Quantity::reflectance) continue;
        if (measurement.experiment.specular == Specular::excluded) return;
        reflects = true;
    }
    throw InputError({.where = key(free),
                      .problem = "has no effect",
                      .why = reflects ? "it scales the surface reflectance where specular is excluded"
                                      : "it scales the surface reflectance, and what was transmitted holds none",
                      .remedy = reflects ? "fix it (--fix specular_fraction), or set specular=excluded"
                                         : "fix it (--fix specular_fraction)"});
}

/// What depends on the measurements in which a parameter is free.
void check_effects(const FitProblem& problem) {
    for (const FreeParameter& free : problem.free) {
        if (free.parameter == Parameter::specular_fraction) check_specular_fraction(problem, free);
        if (free.parameter != Parameter::wavelength_shift_nm) continue;
        for (std::size_t number = 0; number < problem.measurements.size(); ++number) {
            if (free.belongs_to(number)) check_shift(problem.measurements[number], free);
        }
    }
}

}  // namespace

std::string name_of(const FreeParameter& free) {
    const std::string_view name = info(free.parameter).name;
    return free.measurement ? fmt::format("{}[{}]", name, *free.measurement + 1) : std::string(name);
}

FitProblem make_problem(const FitInput& input) {
    const FitSettings& configuration = input.parts.front().configuration;
    if (configuration.engine == Engine::walk) {
        throw InputError({.where = "engine",
                          .problem = "walk cannot be fitted",
                          .why = "its result moves in steps of one ray",
                          .remedy = "set engine=solver, which fits whatever can be fitted"});
    }
    FitProblem problem{.measurements = {},
                       .free = {},
                       .seed = configuration.seed,
                       .discrepancy = configuration.discrepancy,
                       .loss = configuration.loss,
                       .loss_scale = configuration.loss_scale.value_or(default_loss_scale(configuration.loss))};
    for (const FitInput::Part& part : input.parts) {
        problem.measurements.push_back(make_measurement(part.configuration, part.spectrum));
    }
    check_consistency(problem.measurements);
    check_own(configuration);
    for (const Parameter parameter : free_parameters(configuration)) add_free(configuration, parameter, problem);
    if (problem.free.empty()) {
        throw InputError({.where = "free",
                          .problem = "no parameter is free",
                          .why = "there is nothing to fit",
                          .remedy = "free some with --free, or use `skinfit simulate`"});
    }
    check_effects(problem);
    add_derived_priors(configuration, problem);
    check_count(problem);
    return problem;
}

FitProblem make_problem(const Configuration& configuration, std::span<const Spectrum> spectra) {
    return make_problem(fit_input(configuration, spectra));
}

FitProblem make_problem(const Configuration& configuration, const Spectrum& spectrum) {
    return make_problem(configuration, std::span(&spectrum, 1));
}

FitProblem make_problem(const ResolvedConfiguration& configuration, const Spectrum& spectrum) {
    return make_problem({.stated = as_stated(configuration), .parts = {{configuration, spectrum}}});
}

}  // namespace skinfit
