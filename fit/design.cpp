#include "fit/design.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/input_error.hpp"
#include "fit/identifiability.hpp"
#include "fit/minimum.hpp"
#include "fit/models.hpp"
#include "fit/wavelength_sets.hpp"

namespace skinfit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The problem of fitting the spectrum that the configuration itself predicts; what was measured does not matter.
FitProblem planned_problem(const ResolvedConfiguration& configuration, const std::vector<double>& wavelength_nm) {
    Spectrum spectrum{};
    spectrum.source = "design";
    spectrum.wavelength_nm = wavelength_nm;
    for (std::size_t i = 0; i < wavelength_nm.size(); ++i) {
        spectrum.value.push_back(0.5 + 0.01 * static_cast<double>(i % 2));
    }
    return make_problem(configuration, spectrum);
}

Index column_of(const FitProblem& problem, Parameter parameter) {
    const auto found = std::ranges::find(problem.free, parameter, &FreeParameter::parameter);
    return found - problem.free.begin();
}

DetectionLimit limit_of(double variance) {
    const double sigma = std::sqrt(variance);
    return {.sigma = sigma, .limit = detection_factor() * sigma};
}

void check_request(const DesignRequest& request, const MatrixXd& jacobian, Index column) {
    const std::string_view name = info(request.parameter).name;
    if (jacobian.col(column).isZero(0.0)) {
        throw InputError({.where = std::string(name),
                          .problem = "has no effect on this reading",
                          .why = "its derivative is zero at every wavelength",
                          .remedy = "choose another parameter, or change layers, quantity or wavelengths"});
    }
    if (request.best <= static_cast<std::size_t>(jacobian.rows())) return;
    throw InputError({.where = "--best",
                      .problem = fmt::format("{} wavelengths cannot be chosen", request.best),
                      .why = fmt::format("there are {}", jacobian.rows()),
                      .remedy = "ask for fewer, or give more with --wavelengths"});
}

/// `rows` with the member at `place` exchanged for whatever helps most; whether anything helped.
bool exchange(const MatrixXd& jacobian, const VectorXd& prior_sigma, Index column, std::size_t place,
              std::vector<Index>& rows, double& variance) {
    const Index before = rows[place];
    Index best = before;
    for (Index row = 0; row < jacobian.rows(); ++row) {
        if (std::ranges::find(rows, row) != rows.end()) continue;
        std::vector<Index> trial = rows;
        trial[place] = row;
        const double reached = variance_of(jacobian, prior_sigma, trial, column);
        if (reached < variance * (1.0 - 1e-12)) {
            variance = reached;
            best = row;
        }
    }
    rows[place] = best;
    return best != before;
}

/// Adds to the one row given, each time the row that helps most, and exchanges rows as long as any exchange helps; the
/// variance reached.
double improved_choice(const MatrixXd& jacobian, const VectorXd& prior_sigma, std::size_t count, Index column,
                       std::vector<Index>& rows) {
    double variance = variance_of(jacobian, prior_sigma, rows, column);
    while (rows.size() < count) {
        Index unused = 0;
        while (std::ranges::find(rows, unused) != rows.end()) ++unused;
        rows.push_back(unused);
        variance = variance_of(jacobian, prior_sigma, rows, column);
        exchange(jacobian, prior_sigma, column, rows.size() - 1, rows, variance);
    }
    for (bool improved = true; improved;) {
        improved = false;
        for (std::size_t place = 0; place < rows.size(); ++place) {
            improved = exchange(jacobian, prior_sigma, column, place, rows, variance) || improved;
        }
    }
    return variance;
}

}  // namespace

double detection_factor() {
    constexpr double quantile_95 = 1.6448536269514722;  // of the normal distribution
    constexpr double quantile_80 = 0.8416212335729142;
    return quantile_95 + quantile_80;
}

double variance_of(const MatrixXd& jacobian, const VectorXd& prior_sigma, const std::vector<Index>& rows,
                   Index column) {
    // In units of prior_sigma, so that the numbers are comparable.
    const MatrixXd scaled = MatrixXd(jacobian(rows, Eigen::all)) * prior_sigma.asDiagonal();
    MatrixXd information = scaled.transpose() * scaled;
    std::vector<Index> others(static_cast<std::size_t>(jacobian.cols()));
    std::iota(others.begin(), others.end(), Index{0});
    others.erase(others.begin() + column);
    for (const Index other : others) information(other, other) += 1.0;
    double own = information(column, column);
    if (!others.empty()) {
        const VectorXd shared = information(others, column);
        own -= shared.dot(MatrixXd(information(others, others)).ldlt().solve(shared));
    }
    return own > 0.0 ? prior_sigma[column] * prior_sigma[column] / own : std::numeric_limits<double>::infinity();
}

std::vector<Index> best_rows(const MatrixXd& jacobian, const VectorXd& prior_sigma, std::size_t count, Index column) {
    constexpr Index most_starts = 32;
    const Index starts_count = std::min(most_starts, jacobian.rows());
    std::vector<Index> best;
    double least = std::numeric_limits<double>::infinity();
    for (Index start = 0; start < starts_count; ++start) {
        std::vector<Index> rows = {start * jacobian.rows() / starts_count};
        const double variance = improved_choice(jacobian, prior_sigma, count, column, rows);
        if (best.empty() || variance < least) {
            least = variance;
            best = rows;
        }
    }
    std::ranges::sort(best);
    return best;
}

Design design(const Configuration& configuration, const DesignRequest& request) {
    ResolvedConfiguration complete = resolved(configuration);
    complete.free[static_cast<std::size_t>(request.parameter)] = true;
    Design result{.configuration = complete,
                  .parameter = request.parameter,
                  .value = value_of(complete.values, request.parameter),
                  .wavelength_nm = parse_wavelengths(complete.wavelengths, "wavelengths"),
                  .others_free = {},
                  .others_fixed = {},
                  .best_nm = {},
                  .by_best = {}};
    complete.wavelength_min_nm = result.wavelength_nm.front();
    complete.wavelength_max_nm = result.wavelength_nm.back();
    const FitProblem problem = planned_problem(complete, result.wavelength_nm);
    const Objective objective(problem, make_models(problem, complete.engine, request.cache));
    const MatrixXd jacobian = objective.model(starts(problem)).jacobian / complete.noise;
    const Index column = column_of(problem, request.parameter);
    check_request(request, jacobian, column);
    VectorXd prior(jacobian.cols());
    for (Index i = 0; i < prior.size(); ++i) {
        const FreeParameter& free = problem.free[static_cast<std::size_t>(i)];
        prior[i] = prior_step(free, free.start);
    }
    std::vector<Index> all(static_cast<std::size_t>(jacobian.rows()));
    std::iota(all.begin(), all.end(), Index{0});
    result.others_free = limit_of(variance_of(jacobian, prior, all, column));
    result.others_fixed = limit_of(1.0 / jacobian.col(column).squaredNorm());
    if (request.best > 0) {
        const std::vector<Index> rows = best_rows(jacobian, prior, request.best, column);
        for (const Index row : rows) result.best_nm.push_back(result.wavelength_nm[static_cast<std::size_t>(row)]);
        result.by_best = limit_of(variance_of(jacobian, prior, rows, column));
    }
    return result;
}

}  // namespace skinfit
