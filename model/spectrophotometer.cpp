#include "model/spectrophotometer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "model/angular_error.hpp"
#include "model/viewing_cone.hpp"

namespace skinfit {

namespace {

/// The light that leaves the skin at one wavelength, as shares of the incident light, with standard errors.
struct LeavingLight {
    double reflected;  ///< or the reflectance factor of what has entered
    double reflected_se;
    double transmitted;
    double transmitted_se;
    double surface;
};

Reading reading_of(const Experiment& experiment, double wavelength_nm, const LeavingLight& light) {
    const ReadingLaw reflectance = reading_law(experiment, Quantity::reflectance);
    const ReadingLaw transmittance = reading_law(experiment, Quantity::transmittance);
    return {.wavelength_nm = wavelength_nm,
            .reflectance = reflectance.reading(reflectance.light(light.reflected, light.surface)),
            .reflectance_se = reflectance.scale * light.reflected_se,
            .transmittance = transmittance.reading(transmittance.light(light.transmitted, light.surface)),
            .transmittance_se = transmittance.scale * light.transmitted_se,
            .surface_reflectance = light.surface};
}

}  // namespace

ReadingLaw reading_law(const Experiment& experiment, Quantity quantity) {
    const Instrument& instrument = experiment.values.instrument;
    const bool collects_surface = quantity == Quantity::reflectance && !experiment.viewing_cone_rad;
    const bool collects_fraction = collects_surface && experiment.specular == Specular::excluded;
    return {.scale = instrument.scale,
            .offset = instrument.offset,
            .surface_weight = collects_fraction  ? instrument.specular_fraction
                              : collects_surface ? 1.0
                                                 : 0.0,
            .collects_fraction = collects_fraction};
}

std::vector<double> true_wavelengths_nm(const Experiment& experiment, const std::vector<double>& wavelengths_nm) {
    std::vector<double> shifted = wavelengths_nm;
    for (double& wavelength_nm : shifted) wavelength_nm += experiment.values.instrument.wavelength_shift_nm;
    return shifted;
}

std::vector<Extinction> extinctions(const std::vector<double>& wavelengths_nm, Edition edition) {
    std::vector<Extinction> result;
    for (const double wavelength_nm : wavelengths_nm) result.push_back(Extinction::at(wavelength_nm, edition));
    return result;
}

std::vector<PerLayer<double>> optical_depths(const Skin& skin, const std::vector<Extinction>& extinctions) {
    std::vector<PerLayer<double>> depths;
    for (const Extinction& extinction : extinctions) depths.push_back(optical_depth(skin, extinction));
    return depths;
}

std::vector<Reading> read_by_walk(const Experiment& experiment, const std::vector<double>& wavelengths_nm,
                                  std::uint64_t rays, std::uint64_t seed) {
    const double collected = reading_law(experiment, Quantity::reflectance).surface_weight;
    const std::vector<double> true_nm = true_wavelengths_nm(experiment, wavelengths_nm);
    const WalkOptions options{.incidence_rad = experiment.incidence_rad, .rays = rays, .seed = seed};
    const std::vector<ViewedCounts> counts =
        viewed_walk(experiment.sample(), true_nm, options, experiment.viewing_cone_rad);
    const double seen = 1.0 / white_share(experiment.viewing_cone_rad);
    std::vector<Reading> readings;
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        const auto n = static_cast<double>(rays);
        const double surface = static_cast<double>(counts[i].totals.surface_reflected) / n;
        const double viewed = static_cast<double>(counts[i].viewed) / n;
        const double transmitted = static_cast<double>(counts[i].totals.transmitted) / n;
        const double reflected = seen * viewed + collected * surface;
        // Each ray counts `seen`, `collected` or 0: the variance of that, over n.
        const double reflected_variance =
            seen * seen * viewed + collected * collected * surface - reflected * reflected;
        const double transmitted_variance = transmitted - transmitted * transmitted;
        // Where the counts do not scatter because no ray was counted, or all were, the error is what one ray counts.
        const auto standard_error = [&](double variance, double of_one_ray) {
            return variance > 0.0 ? std::sqrt(variance / (n - 1.0)) : of_one_ray / n;
        };
        const bool lets_through = experiment.base.kind != Base::Kind::hypodermis;
        readings.push_back(reading_of(experiment, wavelengths_nm[i],
                                      {.reflected = seen * viewed,
                                       .reflected_se = standard_error(reflected_variance, seen),
                                       .transmitted = transmitted,
                                       .transmitted_se = lets_through ? standard_error(transmitted_variance, 1.0) : 0.0,
                                       .surface = surface}));
    }
    return readings;
}

AngularSolver angular_solver(const Experiment& experiment, const AngularResolution& resolution) {
    return {experiment.sample(),
            {.incidence_rad = experiment.incidence_rad,
             .viewing_cone_rad = experiment.viewing_cone_rad,
             .resolution = resolution}};
}

std::vector<Reading> read_by_solver(const Experiment& experiment, const std::vector<double>& wavelengths_nm) {
    const std::vector<double> true_nm = true_wavelengths_nm(experiment, wavelengths_nm);
    const AngularSolver solver = angular_solver(experiment);
    const SolverErrorEstimate errors(solver);
    std::vector<Reading> readings;
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        const AngularResponse light = solver.shares(true_nm[i]);
        const SolverErrors error = errors.at(true_nm[i]);
        readings.push_back(reading_of(experiment, wavelengths_nm[i],
                                      {.reflected = light.viewed.share,
                                       .reflected_se = error.viewed,
                                       .transmitted = light.transmitted.share,
                                       .transmitted_se = error.transmitted,
                                       .surface = light.surface.share}));
    }
    return readings;
}

std::vector<Reading> read_by_emulator(const Experiment& experiment, const std::vector<double>& wavelengths_nm,
                                      const Emulator& top, const std::optional<Emulator>& bottom) {
    const std::vector<PerLayer<double>> depths = optical_depths(
        experiment.values.skin, extinctions(true_wavelengths_nm(experiment, wavelengths_nm), experiment.edition));
    const std::vector<EmulatedShare> reflected = top.respond(depths);
    const std::vector<EmulatedShare> transmitted =
        bottom ? bottom->respond(depths) : std::vector<EmulatedShare>(depths.size());
    std::vector<Reading> readings;
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        readings.push_back(reading_of(experiment, wavelengths_nm[i],
                                      {.reflected = reflected[i].share,
                                       .reflected_se = top.certified_error(i),
                                       .transmitted = transmitted[i].share,
                                       .transmitted_se = bottom ? bottom->certified_error(i) : 0.0,
                                       .surface = top.surface_share()}));
    }
    return readings;
}

std::vector<Reading> read_by_paths(const Experiment& experiment, const std::vector<double>& wavelengths_nm,
                                   const PathEnsemble& ensemble) {
    assert(!experiment.viewing_cone_rad);
    const std::vector<EnsembleResponse> responses = ensemble.respond(optical_depths(
        experiment.values.skin, extinctions(true_wavelengths_nm(experiment, wavelengths_nm), experiment.edition)));
    std::vector<Reading> readings;
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        const Escape& top = responses[i][Side::top];
        const Escape& bottom = responses[i][Side::bottom];
        readings.push_back(reading_of(experiment, wavelengths_nm[i],
                                      {.reflected = top.share,
                                       .reflected_se = top.standard_error,
                                       .transmitted = bottom.share,
                                       .transmitted_se = bottom.standard_error,
                                       .surface = ensemble.surface_share()}));
    }
    return readings;
}

}  // namespace skinfit
