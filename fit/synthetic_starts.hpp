#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/lean_model.hpp"

namespace skinfit {

/// One number per free parameter; on the stack.
using FewNumbers = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, static_cast<int>(parameter_count), 1>;

/// Synthetic spectra over the box, from the closest of which a fit starts.
class SyntheticStarts {
public:
    /// Makes the readings of its points once, by `model`.
    SyntheticStarts(const LeanModel& model, Eigen::Index free_count);

    /// The positions in the unit box of the `count` spectra closest to `measured`, in sigmas; none within half the
    /// box's width of a closer one. Empty where no distance is a number.
    [[nodiscard]] std::vector<FewNumbers> closest(const Eigen::VectorXd& measured, int count) const;

private:
    Eigen::MatrixXd positions_;  // free parameters x spectra
    Eigen::MatrixXd readings_;   // wavelengths x spectra, in sigmas
};

}  // namespace skinfit
