#include "fit/left_out_bands.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace skinfit {
namespace {

using Index = Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double band_nm = 30;  // chosen: as wide as a band of hemoglobin

/// The problem at `values`, linear.
struct LinearFit {
    VectorXd difference;  // model minus measurement
    MatrixXd jacobian;    // by positions between the bounds
    MatrixXd covariance;  // of noise and discrepancy
    VectorXd prior_residual;
    MatrixXd prior_jacobian;
    VectorXd lowest_step;  // to the bounds, in positions
    VectorXd highest_step;
};

LinearFit linear_fit(const Objective& objective, std::span<const double> values) {
    const FitProblem& problem = objective.problem();
    const Measurement& measurement = problem.only();
    const auto rows = static_cast<Index>(objective.reading_count());
    const auto columns = static_cast<Index>(objective.free_count());
    const Objective::Modelled modelled = objective.model(values);
    const Misfit priors = objective.prior_misfit(values);
    VectorXd width(columns);
    VectorXd position(columns);
    for (Index i = 0; i < columns; ++i) {
        const auto place = static_cast<std::size_t>(i);
        const Bounds& bounds = problem.free[place].bounds;
        width[i] = bounds.upper - bounds.lower;
        position[i] = (values[place] - bounds.lower) / width[i];
    }
    return {.difference = modelled.reading - Eigen::Map<const VectorXd>(measurement.measured.data(), rows),
            .jacobian = modelled.jacobian * width.asDiagonal(),
            .covariance = covariance_of(measurement.wavelength_nm, measurement.sigma, problem.discrepancy),
            .prior_residual = priors.residual,
            .prior_jacobian = priors.jacobian * width.asDiagonal(),
            .lowest_step = -position,
            .highest_step = VectorXd::Ones(columns) - position};
}

/// Model minus measurement at the places `left_out`, from what is `kept`.
VectorXd predicted_difference(const LinearFit& fit, const std::vector<Index>& kept,
                              const std::vector<Index>& left_out) {
    const Eigen::LLT<MatrixXd> known(fit.covariance(kept, kept));
    const MatrixXd jacobian = known.matrixL().solve(fit.jacobian(kept, Eigen::all));
    const VectorXd difference = known.matrixL().solve(fit.difference(kept));
    MatrixXd normal = jacobian.transpose() * jacobian + fit.prior_jacobian.transpose() * fit.prior_jacobian;
    normal.diagonal().array() += 1.0;  // a direction that nothing tells moves by no more than about the box
    const VectorXd gradient = jacobian.transpose() * difference + fit.prior_jacobian.transpose() * fit.prior_residual;
    const VectorXd step = (-normal.llt().solve(gradient)).cwiseMax(fit.lowest_step).cwiseMin(fit.highest_step);
    const VectorXd left = fit.difference + fit.jacobian * step;
    return left(left_out) - fit.covariance(left_out, kept) * known.solve(left(kept));
}

}  // namespace

double left_out_rmse(const Objective& objective, std::span<const double> values) {
    const LinearFit fit = linear_fit(objective, values);
    const std::vector<double>& wavelength_nm = objective.problem().only().wavelength_nm;
    const auto band_of = [&](std::size_t i) {
        return std::floor((wavelength_nm[i] - wavelength_nm.front()) / band_nm);
    };
    double squares = 0.0;
    for (std::size_t first = 0; first < wavelength_nm.size();) {
        std::vector<Index> kept;
        std::vector<Index> left_out;
        for (std::size_t i = 0; i < wavelength_nm.size(); ++i) {
            (band_of(i) == band_of(first) ? left_out : kept).push_back(static_cast<Index>(i));
        }
        squares += predicted_difference(fit, kept, left_out).squaredNorm();
        first += left_out.size();
    }
    return std::sqrt(squares / static_cast<double>(wavelength_nm.size()));
}

}  // namespace skinfit
