#include "validation/angular_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

namespace skinfit {

Ratio directionality(const AngularCurve& curve) {
    const auto steps = static_cast<double>(curve.ring.size());
    const auto mirror = static_cast<std::size_t>(curve.incidence_deg / 90.0 * steps);
    const double mean = curve.mean(0, curve.ring.size());
    // The error of the mean over all rays is far below that of one step.
    return {.value = curve.forward.at(mirror).per_sr / mean,
            .standard_error = curve.forward.at(mirror).standard_error / mean};
}

Finding more_directional_in_order(std::span<const AngularCurve> curves) {
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

Finding near_lambertian(std::span<const AngularCurve> curves) {
    assert(!curves.empty());
    constexpr double cone_deg = 60.0;
    constexpr double largest_departure = 0.1;
    double departure = -1.0;
    double error = 0.0;
    std::string where;
    for (const AngularCurve& curve : curves) {
        const auto rings = static_cast<std::size_t>(cone_deg / 90.0 * static_cast<double>(curve.ring.size()));
        const double mean = curve.mean(0, rings);
        for (std::size_t i = 0; i < rings; ++i) {
            const double relative = curve.ring[i].per_sr / mean - 1.0;
            if (std::abs(relative) <= departure) continue;
            departure = std::abs(relative);
            error = curve.ring[i].standard_error / mean;
            where = fmt::format("{:+.1f} % for {} at {} to {} degrees", 100.0 * relative, curve.name, curve.edge_deg(i),
                                curve.edge_deg(i + 1));
        }
    }
    return {.verdict = verdict_of(departure <= largest_departure),
            .number = departure,
            .measure =
                fmt::format("largest departure from Lambertian within {} degrees, <= {}", cone_deg, largest_departure),
            .why = fmt::format("the worst is {}, standard error {:.1f} %", where, 100.0 * error)};
}

}  // namespace skinfit
