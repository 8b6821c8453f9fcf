#include "fit/profile.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/erase_repeated.hpp"
#include "fit/critical_values.hpp"

namespace skinfit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// What the others of a point of a profile may still gain: a part in 400 of the rise at the end of an interval, which
// moves that end by less than 0.002 sigma.
constexpr double cost_tolerance = 0.01;

double standard_normal_below(double x) {
    return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

/// `point` of the profile of `column`. A rise below 0 is no more than the descents leave.
ProfilePoint profile_point(const BoxPoint& point, Index column, double rise) {
    const double at = point.position[column];
    const double root = critical_root(std::min(at, 1.0 - at) / sigma_along(point, column));
    return {.at = at,
            .cost_rise = std::max(rise, 0.0),
            .cost_slope = 2.0 * point.misfit.jacobian.col(column).dot(point.misfit.residual),
            .cost_rise_95 = root * root};
}

/// The search along the profile of one position, from the minimum towards one bound.
class ProfileSearch {
public:
    ProfileSearch(const BoxMisfit& misfit, const BoxPoint& minimum, Index column, double limit)
        : misfit_(&misfit),
          minimum_(&minimum),
          column_(column),
          limit_(limit),
          inside_point_(minimum),
          last_(minimum) {}

    struct End {
        double position = 0.0;
        bool open = false;
        std::optional<VectorXd> better;  ///< met on the way
        int evaluations = 0;
        ProfileCurve curve;  ///< in the order of the search, without the minimum
    };
    [[nodiscard]] End run();

private:
    [[nodiscard]] double first_distance() const;
    [[nodiscard]] double next(double excess, double root);

    const BoxMisfit* misfit_;
    const BoxPoint* minimum_;
    Index column_;
    double limit_;
    double inside_ = 0.0;  // distances from the minimum
    std::optional<double> outside_;
    BoxPoint inside_point_;  // the farthest that is inside; the next descents start from it
    BoxPoint last_;
};

/// Where the linearised misfit has risen to the threshold.
double ProfileSearch::first_distance() const {
    const double sigma = sigma_along(*minimum_, column_);
    const double direction = limit_ > minimum_->position[column_] ? 1.0 : -1.0;
    const double slope =
        std::max(0.0, direction * 2.0 * minimum_->misfit.jacobian.col(column_).dot(minimum_->misfit.residual));
    const double curvature = 1.0 / (sigma * sigma);
    const double rise = normal_95 * normal_95;
    // The positive root of curvature d^2 + slope d = rise, in the form that survives curvature = 0.
    return 2.0 * rise / (slope + std::sqrt(slope * slope + 4.0 * curvature * rise));
}

/// Newton's next distance for a root that is `excess` above its threshold at `last_`, kept within what is known.
double ProfileSearch::next(double excess, double root) {
    const double whole = std::abs(limit_ - minimum_->position[column_]);
    const double here = std::abs(last_.position[column_] - minimum_->position[column_]);
    const double direction = limit_ > minimum_->position[column_] ? 1.0 : -1.0;
    // By the envelope theorem the slope of the profile is that of the cost with the others held.
    const double slope = direction * last_.misfit.jacobian.col(column_).dot(last_.misfit.residual) / root;
    if (excess > 0.0) {
        outside_ = here;
    } else {
        inside_ = here;
        inside_point_ = last_;
    }
    // Not too far at once: behind a ridge may lie another valley.
    const double farthest = outside_.value_or(std::min(whole, 3.0 * here));
    const double newton = slope > 0.0 ? std::min(here - excess / slope, farthest) : farthest;
    const bool is_known = newton <= inside_ || (outside_ && newton >= *outside_);
    return is_known ? 0.5 * (inside_ + farthest) : newton;
}

ProfileSearch::End ProfileSearch::run() {
    constexpr double close_enough = 0.01;  // of the root; the last step of Newton's method leaves its square
    constexpr int most_points = 40;
    const double origin = minimum_->position[column_];
    const double whole = std::abs(limit_ - origin);
    const double direction = limit_ > origin ? 1.0 : -1.0;
    End end{.position = limit_, .open = true, .better = {}, .evaluations = 0, .curve = {}};
    if (whole <= 0.0) return end;
    double distance = std::min(whole, first_distance());
    for (int k = 0; k < most_points; ++k) {
        const double target = distance >= whole ? limit_ : origin + direction * distance;
        // Not from a point outside, which may lie in another valley: from there the descents would not come back.
        const double step = target - inside_point_.position[column_];
        VectorXd start = inside_point_.position + step_along(inside_point_, column_, step);
        start[column_] = target;
        Descent descent = descend(*misfit_, start, inside_point_.bend, column_, cost_tolerance);
        end.evaluations += descent.evaluations;
        last_ = std::move(descent.point);
        const double rise = last_.cost - minimum_->cost;
        if (rise < -negligible_gain) {
            end.better = last_.position;
            return end;
        }
        const double root = std::sqrt(std::max(rise, 1e-12));
        const ProfilePoint here = profile_point(last_, column_, rise);
        const double excess = root - std::sqrt(here.cost_rise_95);
        end.curve.push_back(here);
        if (target == limit_ && excess <= 0.0) return end;
        const double tried = distance;
        distance = next(excess, root);
        if (std::abs(excess) < close_enough || std::abs(distance - tried) < 1e-9) break;
    }
    end.position = origin + direction * distance;
    end.open = false;
    return end;
}

/// The minimum and what two searches from it have met, by ascending position.
ProfileCurve curve_of(const ProfilePoint& minimum, const ProfileSearch::End& below, const ProfileSearch::End& above) {
    ProfileCurve curve = {minimum};
    for (const ProfileSearch::End* end : {&below, &above}) {
        std::ranges::copy_if(end->curve, std::back_inserter(curve), [](const ProfilePoint& point) {
            return std::isfinite(point.cost_rise) && std::isfinite(point.cost_slope);
        });
    }
    std::ranges::stable_sort(curve, {}, &ProfilePoint::at);
    erase_repeated(curve, &ProfilePoint::at);
    return curve;
}

/// The minimum over the box near `start`, to well below what matters.
Descent settle(const BoxMisfit& misfit, const VectorXd& start) {
    const Eigen::MatrixXd unknown = Eigen::MatrixXd::Zero(start.size(), start.size());
    return descend(misfit, start, unknown, std::nullopt, 1e-6);
}

}  // namespace

double critical_root(double distance) {
    constexpr double coverage = 0.95;
    if (distance >= normal_95) return normal_95;
    // A measurement below the bound, too, excludes the value once it is `reach` below it.
    const auto covered = [distance](double root) {
        const double reach = root <= distance ? root : (distance * distance + root * root) / (2.0 * distance);
        return standard_normal_below(root) - normal_share_below(-reach);
    };
    double low = 1.6;
    double high = normal_95;
    for (int k = 0; k < 50; ++k) {
        const double middle = 0.5 * (low + high);
        (covered(middle) < coverage ? low : high) = middle;
    }
    return high;
}

Profile profile_intervals(const BoxMisfit& misfit, const VectorXd& minimum) {
    constexpr int most_restarts = 10;
    Descent best = settle(misfit, minimum);
    Profile profile{.intervals = {}, .minimum = {}, .cost = 0.0, .better_minimum = false, .evaluations = 0};
    const double given_cost = misfit(minimum).residual.squaredNorm();
    profile.evaluations = best.evaluations + 1;
    for (int restart = 0; restart < most_restarts; ++restart) {
        profile.intervals.clear();
        std::optional<VectorXd> better;
        for (Index column = 0; column < minimum.size(); ++column) {
            const ProfileSearch::End below = ProfileSearch(misfit, best.point, column, 0.0).run();
            const ProfileSearch::End above = ProfileSearch(misfit, best.point, column, 1.0).run();
            profile.evaluations += below.evaluations + above.evaluations;
            if (below.better) better = below.better;
            if (above.better) better = above.better;
            profile.intervals.push_back({.lower = below.position,
                                         .upper = above.position,
                                         .open_below = below.open,
                                         .open_above = above.open,
                                         .curve = curve_of(profile_point(best.point, column, 0.0), below, above)});
        }
        if (!better) break;
        best = settle(misfit, *better);
        profile.evaluations += best.evaluations;
    }
    profile.minimum = best.point.position;
    profile.cost = best.point.cost;
    profile.better_minimum = profile.cost < given_cost - negligible_gain;
    return profile;
}

}  // namespace skinfit
