#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fit/problem.hpp"
#include "model/chromophores.hpp"
#include "model/emulator.hpp"

namespace skinfit {

/// The readings of one problem by its emulator, as `Objective` has them, with everything done beforehand that does not
/// depend on the free parameters. Refers to the problem, which must outlive it.
class LeanModel {
public:
    /// Throws InputError for a problem with priors, weights, a discrepancy or another loss than squares.
    LeanModel(const FitProblem& problem, Emulator emulator);

    /// In sigmas of each wavelength, and by the positions of the free parameters in the unit box (`to_unit_box`).
    struct Modelled {
        Eigen::VectorXd reading;
        Eigen::MatrixXd jacobian;  ///< wavelengths x free parameters
    };
    [[nodiscard]] Modelled at(std::span<const double> positions) const;

private:
    [[nodiscard]] Experiment experiment_at(std::span<const double> positions) const;

    const FitProblem* problem_;
    Emulator emulator_;
    std::vector<Extinction> pigments_;
    std::vector<bool> of_instrument_;  // per free parameter
};

}  // namespace skinfit
