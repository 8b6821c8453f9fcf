#pragma once

#include <Eigen/Core>
#include <deque>
#include <mutex>
#include <vector>

#include "fit/resolution.hpp"
#include "fit/settings.hpp"
#include "model/angular_solver.hpp"
#include "model/spectrophotometer.hpp"

namespace skinfit {

/// What becomes of the light of one described skin, by the angular solver: without noise. Entry i belongs to one
/// wavelength. The shares of the incident light, as the model has them, add up to 1.
struct Simulation {
    ResolvedConfiguration configuration;
    std::vector<double> wavelength_nm;  ///< as the instrument states it
    Eigen::VectorXd reading;            ///< of the configured quantity, a fraction
    Eigen::VectorXd surface;            ///< reflected by the surface
    Eigen::VectorXd reflected;          ///< left through the surface after having entered
    Eigen::MatrixXd absorbed;           ///< wavelengths x layers
    Eigen::VectorXd transmitted;        ///< left through the base
};

/// Simulates as sliders ask for it: one skin after the other, in few geometries. Calls may come from any thread.
class LiveSimulator {
public:
    /// The simulation at the wavelengths of the setting, whatever the configured engine. Throws InputError for more
    /// than 600 wavelengths, for wavelengths outside the tables, and for a viewing cone as `check_viewing_cone` does.
    [[nodiscard]] Simulation simulate(const Configuration& configuration);

private:
    /// A solver of everything but the skin.
    struct Prepared {
        Experiment experiment;
        AngularSolver solver;
    };
    [[nodiscard]] AngularSolver solver_of(const Experiment& experiment);

    std::mutex mutex_;
    std::deque<Prepared> latest_;  ///< the latest first
};

/// The simulation, its colour under D65 for the observer of 1931, and its typology angle.
[[nodiscard]] Json simulation_json(const Simulation& simulation);

}  // namespace skinfit
