#include "fit/forward_model.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>

namespace skinfit {
namespace {

using Index = Eigen::Index;

/// The derivatives of a share by parameters that absorb, from those by the layers' optical depths.
Eigen::RowVectorXd by_parameters(const PerLayer<double>& by_optical_depth, const Skin& skin, const Extinction& pigments,
                                 std::span<const Parameter> parameters) {
    Eigen::RowVectorXd by = Eigen::RowVectorXd::Zero(static_cast<Index>(parameters.size()));
    for (Index column = 0; column < by.size(); ++column) {
        const PerLayer<double> depth_by =
            optical_depth_derivative(skin, pigments, parameters[static_cast<std::size_t>(column)]);
        for (std::size_t layer = 0; layer < layer_count; ++layer)
            by[column] += by_optical_depth[layer] * depth_by[layer];
    }
    return by;
}

std::vector<EscapedLight> light_of_model(const PathEnsemble& ensemble, const Experiment& experiment, Side side,
                                         const std::vector<double>& wavelengths_nm,
                                         std::span<const Parameter> parameters) {
    const Skin& skin = experiment.values.skin;
    const std::vector<Extinction> pigments =
        extinctions(true_wavelengths_nm(experiment, wavelengths_nm), experiment.edition);
    const std::vector<EnsembleResponse> responses = ensemble.respond(optical_depths(skin, pigments));
    std::vector<EscapedLight> lights;
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        const Escape& escape = responses[i][side];
        lights.push_back({.surface = ensemble.surface_share(),
                          .share = escape.share,
                          .standard_error = escape.standard_error,
                          .surface_by = Eigen::RowVectorXd::Zero(static_cast<Index>(parameters.size())),
                          .share_by = by_parameters(escape.by_optical_depth, skin, pigments[i], parameters)});
    }
    return lights;
}

std::vector<EscapedLight> light_of_model(const Emulator& emulator, const Experiment& experiment, Side /*side*/,
                                         const std::vector<double>& wavelengths_nm,
                                         std::span<const Parameter> parameters) {
    const Skin& skin = experiment.values.skin;
    const std::vector<Extinction> pigments =
        extinctions(true_wavelengths_nm(experiment, wavelengths_nm), experiment.edition);
    const std::vector<EmulatedShare> shares = emulator.respond(optical_depths(skin, pigments));
    std::vector<EscapedLight> lights;
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        lights.push_back({.surface = emulator.surface_share(),
                          .share = shares[i].share,
                          .standard_error = emulator.certified_error(i),
                          .surface_by = Eigen::RowVectorXd::Zero(static_cast<Index>(parameters.size())),
                          .share_by = by_parameters(shares[i].by_optical_depth, skin, pigments[i], parameters)});
    }
    return lights;
}

const AngularShare& share_of(const AngularResponse& response, Side side) {
    return side == Side::top ? response.viewed : response.transmitted;
}

EscapedLight solved_light(const AngularSolver& solver, double wavelength_nm, Side side,
                          std::span<const Parameter> parameters) {
    constexpr double half_step_nm = 0.05;
    const AngularResponse response = parameters.empty() ? solver.shares(wavelength_nm) : solver.respond(wavelength_nm);
    const AngularShare& share = share_of(response, side);
    const auto columns = static_cast<Index>(parameters.size());
    EscapedLight light{.surface = response.surface.share,
                       .share = share.share,
                       .standard_error = 0.0,
                       .surface_by = Eigen::RowVectorXd(columns),
                       .share_by = Eigen::RowVectorXd(columns)};
    for (Index column = 0; column < columns; ++column) {
        const Parameter parameter = parameters[static_cast<std::size_t>(column)];
        light.surface_by[column] = response.surface.by_parameter[static_cast<std::size_t>(parameter)];
        light.share_by[column] = share.by_parameter[static_cast<std::size_t>(parameter)];
        if (parameter == Parameter::wavelength_shift_nm) {
            // One-sided at the ends of the tables.
            const double above_nm = std::min(wavelength_nm + half_step_nm, modelled_wavelengths().highest_nm);
            const double below_nm = std::max(wavelength_nm - half_step_nm, modelled_wavelengths().lowest_nm);
            const double above = share_of(solver.shares(above_nm), side).share;
            const double below = share_of(solver.shares(below_nm), side).share;
            light.share_by[column] = (above - below) / (above_nm - below_nm);
        }
    }
    return light;
}

std::vector<EscapedLight> light_of_model(const AngularSolver& solver, const Experiment& experiment, Side side,
                                         const std::vector<double>& wavelengths_nm,
                                         std::span<const Parameter> parameters) {
    const AngularSolver of_this_skin = solver.with(experiment.values.skin);
    const std::vector<double> true_nm = true_wavelengths_nm(experiment, wavelengths_nm);
    std::vector<EscapedLight> lights(true_nm.size());
    tbb::parallel_for(std::size_t{0}, true_nm.size(),
                      [&](std::size_t i) { lights[i] = solved_light(of_this_skin, true_nm[i], side, parameters); });
    return lights;
}

}  // namespace

std::vector<EscapedLight> light_of(const ForwardModel& model, const Experiment& experiment, Side side,
                                   const std::vector<double>& wavelengths_nm, std::span<const Parameter> parameters) {
    return std::visit(
        [&](const auto& engine) { return light_of_model(engine, experiment, side, wavelengths_nm, parameters); },
        model);
}

}  // namespace skinfit
