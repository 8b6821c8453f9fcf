#include "fit/forward_model.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>

namespace skinfit {
namespace {

using Index = Eigen::Index;

EscapedLight blank_light(std::size_t wavelengths, std::size_t parameters) {
    const auto rows = static_cast<Index>(wavelengths);
    const auto columns = static_cast<Index>(parameters);
    return {.surface = Eigen::VectorXd(rows),
            .share = Eigen::VectorXd(rows),
            .standard_error = Eigen::VectorXd::Zero(rows),
            .surface_by = Eigen::MatrixXd::Zero(rows, columns),
            .share_by = Eigen::MatrixXd::Zero(rows, columns)};
}

/// What models whose light only absorption changes, or the fibrils too, say of one wavelength.
struct LayerResponse {
    double share;
    double standard_error;
    const PerLayer<double>& by_optical_depth;
    double by_fibril_radius_nm = 0.0;
};

/// The light of such a model: `response(i)` at wavelength i.
template <class Respond>
EscapedLight absorbed_light(double surface_share, const Skin& skin, const std::vector<Extinction>& pigments,
                            std::span<const Parameter> parameters, const Respond& respond) {
    EscapedLight light = blank_light(pigments.size(), parameters.size());
    light.surface.setConstant(surface_share);
    for (std::size_t i = 0; i < pigments.size(); ++i) {
        const auto row = static_cast<Index>(i);
        const LayerResponse response = respond(i);
        light.share[row] = response.share;
        light.standard_error[row] = response.standard_error;
        for (std::size_t k = 0; k < parameters.size(); ++k) {
            light.share_by(row, static_cast<Index>(k)) =
                parameters[k] == Parameter::fibril_radius_nm
                    ? response.by_fibril_radius_nm
                    : pigment_derivative(response.by_optical_depth, skin, pigments[i], parameters[k]);
        }
    }
    return light;
}

EscapedLight light_of_model(const PathEnsemble& ensemble, const Experiment& experiment, Side side,
                            const ModelWavelengths& wavelengths, std::span<const Parameter> parameters) {
    const Skin& skin = experiment.values.skin;
    const std::vector<EnsembleResponse> responses = ensemble.respond(optical_depths(skin, wavelengths.pigments));
    return absorbed_light(ensemble.surface_share(), skin, wavelengths.pigments, parameters, [&](std::size_t i) {
        const Escape& escape = responses[i][side];
        return LayerResponse{escape.share, escape.standard_error, escape.by_optical_depth};
    });
}

EscapedLight light_of_model(const Emulator& emulator, const Experiment& experiment, Side /*side*/,
                            const ModelWavelengths& wavelengths, std::span<const Parameter> parameters) {
    const Skin& skin = experiment.values.skin;
    const std::vector<EmulatedShare> shares = emulator.respond(optical_depths(skin, wavelengths.pigments));
    return absorbed_light(emulator.surface_share(), skin, wavelengths.pigments, parameters, [&](std::size_t i) {
        return LayerResponse{shares[i].share, emulator.certified_error(i), shares[i].by_optical_depth};
    });
}

EscapedLight light_of_model(const RadiusEmulator& emulator, const Experiment& experiment, Side /*side*/,
                            const ModelWavelengths& wavelengths, std::span<const Parameter> parameters) {
    const Skin& skin = experiment.values.skin;
    const std::vector<RadiusShare> shares =
        emulator.respond(optical_depths(skin, wavelengths.pigments), skin.fibril_radius_nm);
    return absorbed_light(emulator.surface_share(), skin, wavelengths.pigments, parameters, [&](std::size_t i) {
        return LayerResponse{shares[i].share, emulator.certified_error(i), shares[i].by_optical_depth,
                             shares[i].by_fibril_radius_nm};
    });
}

const AngularShare& share_of(const AngularResponse& response, Side side) {
    return side == Side::top ? response.viewed : response.transmitted;
}

/// The derivative of the share by the wavelength, one-sided at the ends of the tables.
double by_wavelength(const AngularSolver& solver, double wavelength_nm, Side side) {
    constexpr double half_step_nm = 0.05;
    const double above_nm = std::min(wavelength_nm + half_step_nm, modelled_wavelengths().highest_nm);
    const double below_nm = std::max(wavelength_nm - half_step_nm, modelled_wavelengths().lowest_nm);
    const double above = share_of(solver.shares(above_nm), side).share;
    const double below = share_of(solver.shares(below_nm), side).share;
    return (above - below) / (above_nm - below_nm);
}

/// Row `row` of `light`.
void solve(const AngularSolver& solver, double wavelength_nm, Side side, std::span<const Parameter> parameters,
           Index row, EscapedLight& light) {
    const AngularResponse response = parameters.empty() ? solver.shares(wavelength_nm) : solver.respond(wavelength_nm);
    const AngularShare& share = share_of(response, side);
    light.surface[row] = response.surface.share;
    light.share[row] = share.share;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        const auto column = static_cast<Index>(k);
        const auto place = static_cast<std::size_t>(parameters[k]);
        light.surface_by(row, column) = response.surface.by_parameter[place];
        light.share_by(row, column) = parameters[k] == Parameter::wavelength_shift_nm
                                          ? by_wavelength(solver, wavelength_nm, side)
                                          : share.by_parameter[place];
    }
}

EscapedLight light_of_model(const AngularSolver& solver, const Experiment& experiment, Side side,
                            const ModelWavelengths& wavelengths, std::span<const Parameter> parameters) {
    const AngularSolver of_this_skin = solver.with(experiment.values.skin);
    EscapedLight light = blank_light(wavelengths.true_nm.size(), parameters.size());
    tbb::parallel_for(std::size_t{0}, wavelengths.true_nm.size(), [&](std::size_t i) {
        solve(of_this_skin, wavelengths.true_nm[i], side, parameters, static_cast<Index>(i), light);
    });
    return light;
}

}  // namespace

std::optional<double> certified_error(const ForwardModel& model) {
    if (const auto* const emulator = std::get_if<Emulator>(&model)) return emulator->certified_error();
    if (const auto* const emulator = std::get_if<RadiusEmulator>(&model)) return emulator->certified_error();
    return std::nullopt;
}

ModelWavelengths model_wavelengths(const Experiment& experiment, const std::vector<double>& wavelengths_nm) {
    std::vector<double> true_nm = true_wavelengths_nm(experiment, wavelengths_nm);
    std::vector<Extinction> pigments = extinctions(true_nm, experiment.edition);
    return {.true_nm = std::move(true_nm), .pigments = std::move(pigments)};
}

EscapedLight light_of(const ForwardModel& model, const Experiment& experiment, Side side,
                      const ModelWavelengths& wavelengths, std::span<const Parameter> parameters) {
    return std::visit(
        [&](const auto& engine) { return light_of_model(engine, experiment, side, wavelengths, parameters); }, model);
}

}  // namespace skinfit
