#include "fit/synthetic_starts.hpp"

#include <cmath>
#include <limits>

namespace skinfit {

using Index = Eigen::Index;

SyntheticStarts::SyntheticStarts(const LeanModel& model, Index free_count) {
    constexpr Index spectra = 512;
    positions_.resize(free_count, spectra);
    // Kronecker's low-discrepancy sequence to the root of x^(free + 1) = x + 1; half of it crowded at the lower
    // bounds, where spectra differ most.
    double root = 2.0;
    for (int i = 0; i < 60; ++i) root = std::pow(1.0 + root, 1.0 / static_cast<double>(free_count + 1));
    for (Index column = 0; column < spectra; ++column) {
        for (Index row = 0; row < free_count; ++row) {
            const double turns = static_cast<double>(column + 1) * std::pow(root, -static_cast<double>(row + 1));
            const double place = turns - std::floor(turns);
            positions_(row, column) = column % 2 == 0 ? place : place * place * place;
        }
        const Eigen::VectorXd reading =
            model.at({positions_.col(column).data(), static_cast<std::size_t>(free_count)}).reading;
        if (column == 0) readings_.resize(reading.size(), spectra);
        readings_.col(column) = reading;
    }
}

std::vector<FewNumbers> SyntheticStarts::closest(const Eigen::VectorXd& measured, int count) const {
    constexpr double apart = 0.5;
    Eigen::RowVectorXd distance = (readings_.colwise() - measured).colwise().squaredNorm();
    std::vector<FewNumbers> found;
    while (found.size() < static_cast<std::size_t>(count)) {
        Index column = 0;
        if (!std::isfinite(distance.minCoeff(&column))) break;
        found.emplace_back(positions_.col(column));
        for (Index other = 0; other < distance.size(); ++other) {
            if ((positions_.col(other) - found.back()).norm() < apart) {
                distance[other] = std::numeric_limits<double>::infinity();
            }
        }
    }
    return found;
}

}  // namespace skinfit
