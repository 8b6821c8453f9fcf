#include "explore/simulation.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "fit/band_sampling.hpp"
#include "fit/problem.hpp"
#include "fit/reading.hpp"
#include "fit/viewing.hpp"
#include "fit/wavelength_sets.hpp"
#include "model/lab.hpp"
#include "model/srgb.hpp"

namespace skinfit {
namespace {

using Eigen::Index;

/// Columns of what the model says of a wavelength: shares of the incident light.
constexpr Index viewed = 0, surface = 1, reflected = 2, transmitted = 3, absorbed = 4;

std::vector<double> checked_wavelengths(const Configuration& configuration) {
    constexpr std::size_t most = 600;
    std::vector<double> wavelengths_nm = parse_wavelengths(configuration.wavelengths, "wavelengths");
    if (wavelengths_nm.size() <= most) return wavelengths_nm;
    throw InputError({.where = "wavelengths",
                      .problem = fmt::format("{} of them", wavelengths_nm.size()),
                      .why = fmt::format("more than {} take too long to follow a slider", most),
                      .remedy = "choose a wider step, or use `skinfit simulate`"});
}

/// Wavelengths x columns.
Eigen::MatrixXd shares(const AngularSolver& solver, const std::vector<double>& true_nm, Side side) {
    Eigen::MatrixXd rows(static_cast<Index>(true_nm.size()), absorbed + static_cast<Index>(layer_count));
    tbb::parallel_for(std::size_t{0}, true_nm.size(), [&](std::size_t i) {
        const AngularResponse light = solver.shares(true_nm[i]);
        auto row = rows.row(static_cast<Index>(i));
        row[viewed] = side == Side::top ? light.viewed.share : light.transmitted.share;
        row[surface] = light.surface.share;
        row[reflected] = light.reflected.share;
        row[transmitted] = light.transmitted.share;
        for (std::size_t layer = 0; layer < layer_count; ++layer) {
            row[absorbed + static_cast<Index>(layer)] = light.absorbed[layer];
        }
    });
    return rows;
}

bool same_but_for_skin(const Experiment& a, const Experiment& b) {
    return a.edition == b.edition && a.layers == b.layers && a.base == b.base && a.incidence_rad == b.incidence_rad &&
           a.viewing_cone_rad == b.viewing_cone_rad;
}

std::vector<double> list(const Eigen::VectorXd& column) {
    return {column.begin(), column.end()};
}

Json colour_json(const Simulation& simulation) {
    try {
        const SeenColour seen = colour_of({simulation.wavelength_nm, list(simulation.reading)}, {});
        const Rgb encoded = encoded_srgb(linear_srgb(seen.xyz, seen.white));
        const Lab lab = lab_from_xyz(seen.xyz, seen.white);
        const std::optional<double> angle_deg = individual_typology_angle_deg(lab);
        return {{"hex", hex_string(clipped_to_srgb_gamut(encoded))},
                {"in_gamut", in_srgb_gamut(encoded)},
                {"lab", {lab.l, lab.a, lab.b}},
                {"individual_typology_angle_deg", angle_deg ? Json(*angle_deg) : Json()},
                {"skin_colour", angle_deg ? Json(name_of(skin_colour(*angle_deg))) : Json()}};
    } catch (const InputError& too_short) {
        // The spectrum is good without one: its wavelengths do not reach far enough.
        return {{"unknown", too_short.what()}};
    }
}

}  // namespace

AngularSolver LiveSimulator::solver_of(const Experiment& experiment) {
    constexpr std::size_t most_kept = 4;  // geometries: as many as a page draws at a time
    {
        const std::scoped_lock lock(mutex_);
        const auto found = std::ranges::find_if(
            latest_, [&](const Prepared& each) { return same_but_for_skin(each.experiment, experiment); });
        if (found != latest_.end()) {
            std::rotate(latest_.begin(), found, found + 1);
            latest_.front().solver = latest_.front().solver.with(experiment.values.skin);
            return latest_.front().solver;
        }
    }
    AngularSolver solver = angular_solver(experiment);
    const std::scoped_lock lock(mutex_);
    latest_.push_front(Prepared{experiment, solver});
    if (latest_.size() > most_kept) latest_.pop_back();
    return solver;
}

Simulation LiveSimulator::simulate(const Configuration& configuration) {
    Simulation simulation{.configuration = resolved(configuration),
                          .wavelength_nm = checked_wavelengths(configuration),
                          .reading = {},
                          .surface = {},
                          .reflected = {},
                          .absorbed = {},
                          .transmitted = {}};
    simulation.configuration.engine = Engine::solver;
    check_viewing_cone(simulation.configuration);
    const Quantity quantity = simulation.configuration.quantity;
    const Experiment experiment = make_experiment(simulation.configuration);
    const BandSampling bands = sample_bands(simulation.wavelength_nm, bandpass_of(simulation.configuration));
    const std::vector<double> true_nm = true_wavelengths_nm(experiment, bands.wavelength_nm);
    (void)extinctions(true_nm, experiment.edition);  // refuses wavelengths outside the tables before any work
    const Eigen::MatrixXd found = bands.readings(shares(solver_of(experiment), true_nm, measured_side(quantity)));
    const ReadingLaw law = reading_law(experiment, quantity);
    simulation.reading = found.col(viewed).binaryExpr(found.col(surface), [&](double share, double reflected_share) {
        return law.reading(law.light(share, reflected_share));
    });
    simulation.surface = found.col(surface);
    simulation.reflected = found.col(reflected);
    simulation.transmitted = found.col(transmitted);
    simulation.absorbed = found.rightCols(static_cast<Index>(layer_count));
    return simulation;
}

Json simulation_json(const Simulation& simulation) {
    Json shares = {{"surface", list(simulation.surface)}, {"reflected", list(simulation.reflected)}};
    const auto layers = static_cast<std::size_t>(simulation.configuration.layers);
    for (std::size_t layer = 0; layer < layers; ++layer) {
        shares[std::string(layer_names[layer])] = list(simulation.absorbed.col(static_cast<Index>(layer)));
    }
    shares["transmitted"] = list(simulation.transmitted);
    return {{"quantity", quantity_names[static_cast<std::size_t>(simulation.configuration.quantity)]},
            {"wavelength_nm", simulation.wavelength_nm},
            {"reading", list(simulation.reading)},
            {"shares", shares},
            {"colour", colour_json(simulation)}};
}

}  // namespace skinfit
