#include "validation/angular_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

namespace skinfit {
namespace {

/// How far light is from that of a Lambertian, relative to it.
struct Departure {
    double relative = 0.0;
    double standard_error = 0.0;
    std::string where;
};

Departure worse(const Departure& a, const Departure& b) {
    return std::abs(b.relative) > std::abs(a.relative) || a.where.empty() ? b : a;
}

/// The steps of a curve that end within `cone_deg` of the normal, one at least.
std::size_t steps_within(const AngularCurve& curve, double cone_deg) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(cone_deg / 90.0 * static_cast<double>(curve.ring.size())));
}

/// Of the first `count` of `steps`, taken `part` at a time.
Departure worst_of(std::span<const BrdfValue> steps, std::size_t count, std::size_t part, double mean,
                   const std::string& name) {
    const double step_deg = 90.0 / static_cast<double>(steps.size());
    Departure worst;
    for (std::size_t first = 0; first < count; first += part) {
        const std::size_t last = std::min(first + part, count);
        const BrdfValue value = mean_brdf(steps, first, last);
        worst = worse(worst, {.relative = value.per_sr / mean - 1.0,
                              .standard_error = value.standard_error / mean,
                              .where = fmt::format("{} {} to {} degrees", name, step_deg * static_cast<double>(first),
                                                   step_deg * static_cast<double>(last))});
    }
    return worst;
}

}  // namespace

Ratio directionality(const AngularCurve& curve) {
    const auto steps = static_cast<double>(curve.ring.size());
    const auto mirror = static_cast<std::size_t>(curve.incidence_deg / 90.0 * steps);
    const double mean = mean_brdf(curve.ring, 0, curve.ring.size()).per_sr;
    // The error of the mean over all rays is far below that of one step.
    return {.value = curve.forward.at(mirror).per_sr / mean,
            .standard_error = curve.forward.at(mirror).standard_error / mean};
}

ClaimFinding more_directional_in_order(std::span<const AngularCurve> curves) {
    assert(curves.size() >= 2);
    double smallest_z = std::numeric_limits<double>::infinity();
    std::string values = fmt::format("{:.2f}", directionality(curves.front()).value);
    for (std::size_t i = 1; i < curves.size(); ++i) {
        const Ratio before = directionality(curves[i - 1]);
        const Ratio after = directionality(curves[i]);
        const double error = std::hypot(before.standard_error, after.standard_error);
        smallest_z = std::min(smallest_z, error > 0.0 ? (after.value - before.value) / error : 0.0);
        values += fmt::format(", {:.2f}", after.value);
    }
    return {.verdict = verdict_of(smallest_z >= decisive_z),
            .number = smallest_z,
            .measure = fmt::format("smallest growth of directionality in standard errors, >= {}", decisive_z),
            .why = fmt::format("the BRDF in mirror direction is {} times the mean of the hemisphere", values)};
}

ClaimFinding near_lambertian(std::span<const AngularCurve> curves) {
    assert(!curves.empty());
    constexpr double largest_departure = 0.1;
    Departure worst;
    for (const AngularCurve& curve : curves) {
        const std::size_t rings = steps_within(curve, 60.0);
        const double mean = mean_brdf(curve.ring, 0, rings).per_sr;
        worst = worse(worst, worst_of(curve.ring, rings, 1, mean, curve.name + ", ring"));
        const std::size_t part = steps_within(curve, 20.0);
        worst = worse(worst, worst_of(curve.forward, rings, part, mean, curve.name + ", forward"));
        worst = worse(worst, worst_of(curve.backward, rings, part, mean, curve.name + ", backward"));
    }
    return {.verdict = verdict_of(std::abs(worst.relative) <= largest_departure),
            .number = std::abs(worst.relative),
            .measure = fmt::format("largest departure from Lambertian within 60 degrees, <= {}", largest_departure),
            .why = fmt::format("the worst is {:+.1f} % at {}, standard error {:.1f} %", 100.0 * worst.relative,
                               worst.where, 100.0 * worst.standard_error)};
}

}  // namespace skinfit
