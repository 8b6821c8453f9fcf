#include "validation/inverse_run.hpp"

#include "core/input_error.hpp"
#include "fit/configuration_check.hpp"
#include "fit/models.hpp"
#include "fit/simulation.hpp"

namespace skinfit {
namespace {

/// By the analog walk, each spectrum with a seed of its own.
Simulator walked(const FitProblem& problem) {
    return [&problem](std::span<const double> values, std::uint64_t number) {
        const Measurement& measurement = problem.only();
        Experiment experiment = measurement.experiment;
        for (std::size_t i = 0; i < values.size(); ++i) {
            value_of(experiment.values, problem.free[i].parameter) = values[i];
        }
        const auto count = static_cast<Eigen::Index>(measurement.wavelength_nm.size());
        SimulatedReadings simulated{.reading = Eigen::VectorXd(count), .standard_error = Eigen::VectorXd(count)};
        const std::vector<Reading> readings =
            read_by_walk(experiment, measurement.wavelength_nm, measurement.walk.rays, measurement.walk.seed + number);
        const bool reflected = measurement.quantity == Quantity::reflectance;
        for (Eigen::Index row = 0; row < count; ++row) {
            const Reading& reading = readings[static_cast<std::size_t>(row)];
            simulated.reading[row] = reflected ? reading.reflectance : reading.transmittance;
            simulated.standard_error[row] = reflected ? reading.reflectance_se : reading.transmittance_se;
        }
        return simulated;
    };
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
                               const DiskCache& cache, const RecoveryWatch& watch) {
    if (configuration.discrepancy) {
        throw InputError({.where = "discrepancy",
                          .problem = "no recovery study with one",
                          .why = "the spectra are those of the model, with noise alone",
                          .remedy = "leave it out"});
    }
    check_freedom(configuration, "free");
    const Spectrum spectrum = blank_spectrum(configuration);
    const ResolvedConfiguration complete = resolved(configuration, spectrum);
    const FitProblem problem = make_problem(complete, spectrum);
    FitProblem simulated = problem;
    ++simulated.only().walk.seed;
    design.noise = complete.noise;
    design.seed = complete.seed;
    design.starts = complete.starts;
    design.thorough_starts = 4 * complete.starts;
    const std::vector<ForwardModel> models = make_models(problem, complete.engine, cache);
    if (simulator == Engine::walk) {
        return {.free = problem.free, .spectra = recover(problem, models, walked(simulated), design, watch)};
    }
    const Objective truth(simulated, make_models(simulated, simulator, cache));
    const auto exact = [&truth](std::span<const double> values, std::uint64_t /*number*/) {
        const Eigen::VectorXd reading = truth.readings(values);
        return SimulatedReadings{.reading = reading, .standard_error = Eigen::VectorXd::Zero(reading.size())};
    };
    return {.free = problem.free, .spectra = recover(problem, models, exact, design, watch)};
}

}  // namespace skinfit
