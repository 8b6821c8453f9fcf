#include "fit/emulation.hpp"

#include "fit/reading.hpp"

namespace skinfit {

EmulatorDomain emulator_domain(const FitProblem& problem, std::size_t number) {
    const Measurement& measurement = problem.measurements[number];
    EmulatorDomain domain{
        .sample = measurement.experiment.sample(),
        .incidence_rad = measurement.experiment.incidence_rad,
        .side = measured_side(measurement.quantity),
        .wavelengths_nm = true_wavelengths_nm(measurement.experiment, measurement.bands.wavelength_nm),
        .ranges = {}};
    for (const FreeParameter& free : problem.free) {
        if (belongs_to_instrument(free.parameter) || !free.belongs_to(number)) continue;
        domain.ranges.push_back({free.parameter, free.bounds.lower, free.bounds.upper});
    }
    return domain;
}

EmulatorDomain emulator_domain(const Configuration& configuration, Side side,
                               const std::vector<double>& wavelengths_nm) {
    const Experiment experiment = make_experiment(configuration);
    EmulatorDomain domain{.sample = experiment.sample(),
                          .incidence_rad = experiment.incidence_rad,
                          .side = side,
                          .wavelengths_nm = true_wavelengths_nm(experiment, wavelengths_nm),
                          .ranges = {}};
    for (const Parameter parameter : free_parameters(configuration)) {
        if (belongs_to_instrument(parameter) || info(parameter).steers) continue;
        const Bounds& bounds = configuration.bounds[static_cast<std::size_t>(parameter)];
        domain.ranges.push_back({parameter, bounds.lower, bounds.upper});
    }
    return domain;
}

}  // namespace skinfit
