#include "fit/model_band.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "fit/chain_statistics.hpp"

namespace skinfit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double tail = 0.025;

std::vector<Bounds> band_of_draws(const Objective& objective, const MatrixXd& draws) {
    constexpr Index most = 400;
    const Index count = std::min(most, draws.cols());
    MatrixXd readings(static_cast<Index>(objective.reading_count()), count);
    for (Index i = 0; i < count; ++i) {
        const VectorXd values = draws.col(i * draws.cols() / count);
        readings.col(i) = objective.readings({values.data(), static_cast<std::size_t>(values.size())});
    }
    std::vector<Bounds> band;
    for (Index row = 0; row < readings.rows(); ++row) {
        const MatrixXd drawn = readings.row(row);
        band.push_back({.lower = quantile(drawn, tail), .upper = quantile(drawn, 1.0 - tail)});
    }
    return band;
}

/// Per unit of its bounds, so that all parameters are of one size; zero for those held at a bound.
VectorXd free_widths(const Objective& objective, const Uncertainty& uncertainty) {
    VectorXd widths(static_cast<Index>(objective.free_count()));
    for (std::size_t i = 0; i < objective.free_count(); ++i) {
        const Bounds& bounds = objective.problem().free[i].bounds;
        const Status status = uncertainty.parameters[i].status;
        const bool is_held = status == Status::at_lower_bound || status == Status::at_upper_bound;
        widths[static_cast<Index>(i)] = is_held ? 0.0 : bounds.upper - bounds.lower;
    }
    return widths;
}

}  // namespace

std::vector<Bounds> model_band(const Objective& objective, const Inference& inference) {
    if (inference.posterior) return band_of_draws(objective, inference.posterior->draws);
    const std::vector<double>& values = inference.minimum.values;
    const Objective::Modelled modelled = objective.model(values);
    const VectorXd widths = free_widths(objective, inference.uncertainty);
    const MatrixXd information_root = objective.misfit(values).jacobian * widths.asDiagonal();
    const MatrixXd errors =
        modelled.jacobian * widths.asDiagonal() * information_root.completeOrthogonalDecomposition().pseudoInverse();
    const double sigmas = boost::math::quantile(boost::math::complement(boost::math::normal(), tail));
    std::vector<Bounds> band;
    for (Index row = 0; row < errors.rows(); ++row) {
        const double half_width = sigmas * errors.row(row).norm();
        band.push_back({.lower = modelled.reading[row] - half_width, .upper = modelled.reading[row] + half_width});
    }
    return band;
}

}  // namespace skinfit
