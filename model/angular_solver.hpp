#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/angular_composition.hpp"
#include "model/angular_grid.hpp"
#include "model/parameters.hpp"
#include "model/path_ensemble.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// How the sample is lit and how finely directions are resolved.
struct AngularSolverOptions {
    double incidence_rad = 0.0;                                                       ///< 0 to below pi/2
    std::optional<double> viewing_cone_rad = {};                                      ///< as `Experiment` has it
    AngularResolution resolution = AngularResolution::for_accuracy(solver_accuracy);  ///< of directions
};

/// A share of the incident light and its derivatives.
struct AngularShare {
    double share = 0.0;
    std::array<double, parameter_count> by_parameter{};  ///< in the order of `Parameter`; zero for the instrument's
    PerLayer<double> by_optical_depth{};                 ///< by each layer's absorption, all else fixed
};

/// Where the light of one wavelength goes. The shares that are not `viewed` sum to one, to rounding.
struct AngularResponse {
    AngularShare surface;         ///< reflected by the surface
    AngularShare reflected;       ///< left through the surface after having entered
    AngularShare transmitted;     ///< left through the base
    AngularShare viewed;          ///< `reflected` as a reflectance factor within the viewing cone; the same without one
    PerLayer<double> absorbed{};  ///< in each layer
};

/// The walk of `RandomWalk`, solved without noise: the expected shares of `random_walk` and `PathEnsemble`, and their
/// derivatives by every absorbing and steering parameter. docs/model.md, section "Angular solver", has the equations
/// and the measured accuracy. Calls are independent of each other and may come from any thread; copies are cheap.
/// Derivatives are those of the shares as computed, to rounding; that by the index of the stratum corneum holds a
/// central difference. By a layer's refractive index the shares have a kink where neighbouring layers have the same
/// index, since a critical angle appears; a finite one-sided value is given.
class AngularSolver {
public:
    /// `sample` is copied.
    AngularSolver(const Sample& sample, const AngularSolverOptions& options);

    /// The solver of the same sample with another skin; quick when the layers' refractive indices are the same.
    [[nodiscard]] AngularSolver with(const Skin& skin) const;

    /// The solver of the same sample at `factor` times its resolution.
    [[nodiscard]] AngularSolver refined(double factor) const;

    /// The response at one wavelength. Throws InputError outside the tables.
    [[nodiscard]] AngularResponse respond(double wavelength_nm) const;
    /// The same, with all derivatives left at zero.
    [[nodiscard]] AngularResponse shares(double wavelength_nm) const;

    /// The share of the incident light that leaves through `side` below the surface's mirror reflection, per bin of the
    /// cosine of the exit angle. `cosine_edges` ascend from 0 to 1; one value fewer is returned.
    [[nodiscard]] std::vector<double> exit_shares(double wavelength_nm, Side side,
                                                  std::span<const double> cosine_edges) const;

    /// The share of the incident light that the surface reflects.
    [[nodiscard]] double surface_share() const { return entry_->reflectance; }
    /// The same sample at one wavelength, for many optical depths of its layers in place of the sample's own.
    [[nodiscard]] AngularComposition composition(double wavelength_nm) const;

private:
    /// The first interface, and the light that enters through it.
    struct Entry {
        double reflectance;
        double reflectance_by_index;
        double cosine_by_index;
        Eigen::MatrixXd means;  // per segment of the scattering table, from ForwardKernel
        Eigen::MatrixXd means_by_cosine;
    };
    struct Wavelength;
    [[nodiscard]] static Entry entry(const AngularGrid& grid, double index, double incidence_rad);
    [[nodiscard]] AngularResponse response(double wavelength_nm, bool with_derivatives) const;

    Sample sample_;
    AngularSolverOptions options_;
    std::shared_ptr<const AngularGrid> grid_;
    std::shared_ptr<const Entry> entry_;
};

}  // namespace skinfit
