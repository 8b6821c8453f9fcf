#include "model/spectrophotometer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "model/viewing_cone.hpp"

namespace skinfit {

double surface_weight(const Experiment& experiment) {
    if (experiment.viewing_cone_rad) return 0.0;
    return experiment.specular == Specular::included ? 1.0 : experiment.values.instrument.specular_fraction;
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
    const Instrument& instrument = experiment.values.instrument;
    const double collected = surface_weight(experiment);
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
        const auto standard_error = [&](double variance) {
            return instrument.scale * std::sqrt(std::max(0.0, variance) / (n - 1.0));
        };
        readings.push_back({.wavelength_nm = wavelengths_nm[i],
                            .reflectance = instrument.scale * reflected + instrument.offset,
                            .reflectance_se = standard_error(reflected_variance),
                            .transmittance = instrument.scale * transmitted + instrument.offset,
                            .transmittance_se = standard_error(transmitted_variance),
                            .surface_reflectance = surface});
    }
    return readings;
}

AngularSolver angular_solver(const Experiment& experiment) {
    return {experiment.sample(),
            {.incidence_rad = experiment.incidence_rad, .viewing_cone_rad = experiment.viewing_cone_rad}};
}

std::vector<Reading> read_by_solver(const Experiment& experiment, const std::vector<double>& wavelengths_nm) {
    const Instrument& instrument = experiment.values.instrument;
    const std::vector<double> true_nm = true_wavelengths_nm(experiment, wavelengths_nm);
    const AngularSolver solver = angular_solver(experiment);
    std::vector<Reading> readings;
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        const AngularResponse light = solver.shares(true_nm[i]);
        const double reflected = light.viewed.share + surface_weight(experiment) * light.surface.share;
        readings.push_back({.wavelength_nm = wavelengths_nm[i],
                            .reflectance = instrument.scale * reflected + instrument.offset,
                            .reflectance_se = 0.0,
                            .transmittance = instrument.scale * light.transmitted.share + instrument.offset,
                            .transmittance_se = 0.0,
                            .surface_reflectance = light.surface.share});
    }
    return readings;
}

std::vector<Reading> read_by_paths(const Experiment& experiment, const std::vector<double>& wavelengths_nm,
                                   const PathEnsemble& ensemble) {
    assert(!experiment.viewing_cone_rad);
    const Instrument& instrument = experiment.values.instrument;
    const double surface = ensemble.surface_share();
    const std::vector<EnsembleResponse> responses = ensemble.respond(optical_depths(
        experiment.values.skin, extinctions(true_wavelengths_nm(experiment, wavelengths_nm), experiment.edition)));
    std::vector<Reading> readings;
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        const Escape& top = responses[i][Side::top];
        const Escape& bottom = responses[i][Side::bottom];
        const double reflected = top.share + surface_weight(experiment) * surface;
        readings.push_back({.wavelength_nm = wavelengths_nm[i],
                            .reflectance = instrument.scale * reflected + instrument.offset,
                            .reflectance_se = instrument.scale * top.standard_error,
                            .transmittance = instrument.scale * bottom.share + instrument.offset,
                            .transmittance_se = instrument.scale * bottom.standard_error,
                            .surface_reflectance = surface});
    }
    return readings;
}

}  // namespace skinfit
