#include "fit/bulk.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/fit_scale.hpp"
#include "fit/lean_model.hpp"

namespace skinfit {
namespace {

using Index = Eigen::Index;
constexpr int most_free = static_cast<int>(parameter_count);
using Vector = FewNumbers;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_free, most_free>;

/// chi2 at some positions, half its gradient and half its approximate Hessian.
struct Point {
    Vector positions;
    Eigen::VectorXd residuals;
    double chi2;
    Vector gradient;
    Matrix curvature;

    Point(const LeanModel& model, const Eigen::VectorXd& measured, const Vector& at) : positions(at) {
        const LeanModel::Modelled modelled = model.at({at.data(), static_cast<std::size_t>(at.size())});
        residuals = modelled.reading - measured;
        chi2 = residuals.squaredNorm();
        gradient.noalias() = modelled.jacobian.transpose() * residuals;
        curvature.noalias() = modelled.jacobian.transpose() * modelled.jacobian;
    }

    /// Whether the position is at a bound beyond which chi2 would fall.
    [[nodiscard]] bool pressed(Index i) const {
        return (positions[i] <= 0.0 && gradient[i] > 0.0) || (positions[i] >= 1.0 && gradient[i] < 0.0);
    }
};

/// What of the free parameters a step leaves alone.
using Held = std::array<bool, most_free>;

/// The least and the largest step within the box.
struct StepRange {
    Vector lowest;
    Vector highest;
};

/// From `step` to the minimum of the quadratic model over what is not held.
Vector change_to_minimum(const Matrix& curvature, const Vector& gradient, const Vector& step, const Held& held) {
    // Rows and columns of what is held are those of the identity.
    Matrix matrix = curvature;
    Vector right = -gradient - curvature * step;
    for (Index i = 0; i < step.size(); ++i) {
        if (!held[static_cast<std::size_t>(i)]) continue;
        matrix.row(i).setZero();
        matrix.col(i).setZero();
        matrix(i, i) = 1.0;
        right[i] = 0.0;
    }
    return matrix.llt().solve(right);
}

/// Adds as much of `change` to `step` as the box allows; what it is that blocks the rest, then at its bound, else -1.
Index advance(Vector& step, const Vector& change, const StepRange& range) {
    double share = 1.0;
    Index blocking = -1;
    for (Index i = 0; i < step.size(); ++i) {
        const double room = (change[i] < 0.0 ? range.lowest[i] : range.highest[i]) - step[i];
        if (std::abs(change[i]) * share <= std::abs(room)) continue;
        share = room / change[i];
        blocking = i;
    }
    step += share * change;
    if (blocking >= 0) step[blocking] = change[blocking] < 0.0 ? range.lowest[blocking] : range.highest[blocking];
    return blocking;
}

/// Which of what is held `slope` pulls into the box most; -1 where it pulls none.
Index most_pulled(const Vector& slope, const Vector& step, const StepRange& range, const Held& held) {
    Index pulled = -1;
    double pull = 0.0;
    for (Index i = 0; i < step.size(); ++i) {
        const double inward = step[i] <= range.lowest[i] ? -slope[i] : slope[i];
        if (!held[static_cast<std::size_t>(i)] || inward <= pull) continue;
        pull = inward;
        pulled = i;
    }
    return pulled;
}

/// The step to the minimum of the quadratic model within the box, `damping` times the diagonal added to its curvature:
/// a primal active-set method, which lowers the model at every turn.
Vector bounded_step(const Point& point, double damping) {
    const Index size = point.positions.size();
    constexpr double least_curvature = 1e-12;  // of the unit box: a direction without any effect
    Matrix curvature = point.curvature;
    curvature.diagonal() = curvature.diagonal() * (1.0 + damping) + Vector::Constant(size, least_curvature);
    const StepRange range{.lowest = -point.positions, .highest = Vector::Ones(size) - point.positions};
    Vector step = Vector::Zero(size);
    Held held{};
    for (Index i = 0; i < size; ++i) held[static_cast<std::size_t>(i)] = point.pressed(i);
    constexpr int most_turns = 10 * most_free;
    for (int turn = 0; turn < most_turns; ++turn) {
        const Index blocking = advance(step, change_to_minimum(curvature, point.gradient, step, held), range);
        if (blocking >= 0) {
            held[static_cast<std::size_t>(blocking)] = true;
            continue;
        }
        const Index pulled = most_pulled(point.gradient + curvature * step, step, range, held);
        if (pulled < 0) break;
        held[static_cast<std::size_t>(pulled)] = false;
    }
    return step;
}

/// Of a step, in standard deviations of what is fitted.
double length_squared(const Point& point, const Vector& step) {
    return step.dot(point.curvature * step);
}

struct Path {
    Point point;
    bool converged;
    int evaluations;
};

/// Levenberg's and Marquardt's method from `start`; damping as [NIELSEN99] has it.
Path minimise(const LeanModel& model, const Eigen::VectorXd& measured, const Vector& start) {
    constexpr int most_evaluations = 200;
    constexpr double converged = 1e-6;  // squared length of a step, in standard deviations of what is fitted
    constexpr double first_damping = 1e-3;
    Path path{.point = Point(model, measured, start), .converged = false, .evaluations = 1};
    double damping = first_damping;
    double growth = 2.0;
    while (path.evaluations < most_evaluations) {
        const Point& here = path.point;
        const Vector step = bounded_step(here, damping);
        const double length = length_squared(here, step);
        // Damping beyond all numbers: nothing that is shorter than rounding lowers chi2.
        if (!step.allFinite() || !std::isfinite(length)) return path;
        // A damped step may be short far from the minimum.
        if (length <= converged && length_squared(here, bounded_step(here, 0.0)) <= converged) {
            path.converged = true;
            return path;
        }
        const double expected = -2.0 * here.gradient.dot(step) - length;
        Point there(model, measured, (here.positions + step).cwiseMax(0.0).cwiseMin(1.0));
        ++path.evaluations;
        const double gain = (here.chi2 - there.chi2) / expected;
        if (gain > 0.0) {
            path.point = std::move(there);
            damping *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * gain - 1.0, 3.0));
            growth = 2.0;
        } else {
            damping *= growth;
            growth *= 2.0;
        }
    }
    return path;
}

/// The lowest minimum from several starts; evaluations are those of all.
Path lowest(const LeanModel& model, const Eigen::VectorXd& measured, const std::vector<Vector>& starts) {
    Path best = minimise(model, measured, starts.front());
    for (std::size_t i = 1; i < starts.size(); ++i) {
        Path other = minimise(model, measured, starts[i]);
        const int evaluations = best.evaluations + other.evaluations;
        if (other.point.chi2 < best.point.chi2) best = std::move(other);
        best.evaluations = evaluations;
    }
    return best;
}

BulkFit described(const FitProblem& problem, const Path& path) {
    const Point& point = path.point;
    const Index size = point.positions.size();
    BulkFit fit{.converged = path.converged,
                .values = from_unit_box(problem, {point.positions.data(), problem.free.size()}),
                .statuses = std::vector<Status>(problem.free.size(), Status::free),
                .covariance = Eigen::MatrixXd::Zero(size, size),
                .chi2 = point.chi2,
                .rmse = 0.0,
                .evaluations = path.evaluations};
    double squares = 0.0;
    for (Index i = 0; i < point.residuals.size(); ++i) {
        const double difference = point.residuals[i] * problem.only().sigma[static_cast<std::size_t>(i)];
        squares += difference * difference;
    }
    fit.rmse = std::sqrt(squares / static_cast<double>(point.residuals.size()));
    std::vector<Index> inner;
    for (Index i = 0; i < size; ++i) {
        Status& status = fit.statuses[static_cast<std::size_t>(i)];
        const Bounds& bounds = problem.free[static_cast<std::size_t>(i)].bounds;
        const double share = (fit.values[static_cast<std::size_t>(i)] - bounds.lower) / (bounds.upper - bounds.lower);
        if (share <= touching_share && point.gradient[i] >= 0.0) status = Status::at_lower_bound;
        if (1.0 - share <= touching_share && point.gradient[i] <= 0.0) status = Status::at_upper_bound;
        if (status == Status::free) inner.push_back(i);
    }
    if (inner.empty()) return fit;
    Matrix curvature = point.curvature(inner, inner);
    constexpr double least_curvature = 1e-12;  // a direction without any effect has a variance far beyond identifiable
    curvature.diagonal().array() += least_curvature;
    const Matrix covariance = curvature.ldlt().solve(Matrix::Identity(curvature.rows(), curvature.cols()));
    const std::vector<double> slopes = unit_box_slopes(problem, {point.positions.data(), problem.free.size()});
    for (std::size_t a = 0; a < inner.size(); ++a) {
        const auto row = static_cast<std::size_t>(inner[a]);
        for (std::size_t b = 0; b < inner.size(); ++b) {
            fit.covariance(inner[a], inner[b]) = covariance(static_cast<Index>(a), static_cast<Index>(b)) *
                                                 slopes[row] * slopes[static_cast<std::size_t>(inner[b])];
        }
        const double width = problem.free[row].bounds.upper - problem.free[row].bounds.lower;
        const double uniform_variance = width * width / 12.0;  // over the bounds
        if (!(fit.covariance(inner[a], inner[a]) < uniform_variance)) fit.statuses[row] = Status::not_identifiable;
    }
    return fit;
}

/// Of a spectrum with values that are no numbers, or so large that chi2 is none.
BulkFit not_fitted(std::size_t free_count) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const auto size = static_cast<Index>(free_count);
    return {.converged = false,
            .values = std::vector<double>(free_count, none),
            .statuses = std::vector<Status>(free_count, Status::not_identifiable),
            .covariance = Eigen::MatrixXd::Zero(size, size),
            .chi2 = none,
            .rmse = none,
            .evaluations = 0};
}

}  // namespace

BulkFitter::BulkFitter(const FitProblem& problem, const Emulator& emulator, const BulkOptions& options)
    : problem_(&problem),
      options_(options),
      model_(problem, emulator),
      starts_(model_, static_cast<Index>(problem.free.size())) {
    assert(options.starts > 0);
}

BulkFit BulkFitter::fit(const Eigen::VectorXd& spectrum) const {
    assert(spectrum.size() == static_cast<Index>(problem_->only().wavelength_nm.size()));
    const Eigen::VectorXd measured =
        spectrum.cwiseQuotient(Eigen::Map<const Eigen::VectorXd>(problem_->only().sigma.data(), spectrum.size()));
    const std::vector<Vector> starts = starts_.closest(measured, options_.starts);
    if (starts.empty()) return not_fitted(problem_->free.size());
    return described(*problem_, lowest(model_, measured, starts));
}

std::vector<BulkFit> fit_in_bulk(const FitProblem& problem, const Emulator& emulator, const Eigen::MatrixXd& spectra,
                                 const BulkOptions& options) {
    const BulkFitter fitter(problem, emulator, options);
    std::vector<BulkFit> fits(static_cast<std::size_t>(spectra.cols()));
    tbb::parallel_for(Index{0}, spectra.cols(),
                      [&](Index column) { fits[static_cast<std::size_t>(column)] = fitter.fit(spectra.col(column)); });
    return fits;
}

}  // namespace skinfit
