#include "validation/inverse_run.hpp"

#include "core/input_error.hpp"
#include "fit/fit.hpp"
#include "fit/settings.hpp"

namespace skinfit {
namespace {

/// Stands for a measurement until one is drawn; a ramp, since a constant spectrum would be refused.
Spectrum placeholder(const Configuration& configuration) {
    Spectrum spectrum{.name = "synthetic",
                      .source = "synthetic",
                      .wavelength_nm = parse_wavelengths(configuration.wavelengths, "wavelengths"),
                      .value = {},
                      .sigma = {},
                      .quantity = {},
                      .geometry = {},
                      .unit_rule = "fractions, as computed"};
    const auto count = static_cast<double>(spectrum.wavelength_nm.size());
    for (std::size_t i = 0; i < spectrum.wavelength_nm.size(); ++i) {
        spectrum.value.push_back(static_cast<double>(i) / count);
    }
    return spectrum;
}

}  // namespace

Configuration study_configuration() {
    Configuration configuration = default_configuration();
    configuration.engine = Engine::emulator;
    configuration.noise = 0.003;
    const auto bound = [&](Parameter parameter, const Bounds& bounds) {
        configuration.bounds[static_cast<std::size_t>(parameter)] = bounds;
    };
    bound(Parameter::melanosome_fraction, {0.01, 0.08});        // not too dark for its blood to show
    bound(Parameter::papillary_blood_fraction, {0.002, 0.07});  // [KA04]
    bound(Parameter::reticular_blood_fraction, {0.002, 0.07});  // [KA04]
    return configuration;
}

InverseStudy run_inverse_study(const Configuration& configuration, Engine simulator, RecoveryDesign design,
                               const EnsembleCache& cache) {
    if (configuration.discrepancy) {
        throw InputError({.where = "discrepancy",
                          .problem = "no recovery study with one",
                          .why = "the spectra are those of the model, with noise alone",
                          .remedy = "leave it out"});
    }
    const Spectrum spectrum = placeholder(configuration);
    const Configuration complete = resolved(configuration, spectrum);
    const FitProblem problem = make_problem(complete, spectrum);
    FitProblem simulated = problem;
    ++simulated.only().walk.seed;
    const Objective truth(simulated, make_models(simulated, simulator, cache));
    design.noise = complete.noise;
    design.seed = complete.seed;
    design.starts = complete.starts;
    design.thorough_starts = 4 * complete.starts;
    return {.free = problem.free,
            .spectra = recover(
                problem, make_models(problem, complete.engine, cache),
                [&truth](std::span<const double> values) { return truth.readings(values); }, design)};
}

}  // namespace skinfit
