#include "study/power.hpp"

#include <algorithm>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/roots.hpp>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

namespace skinfit {
namespace {

/// The power of the test when the expected t is `noncentrality`, 0 or above.
double power_at(double noncentrality, double degrees_of_freedom, double significance_level) {
    using boost::math::complement;
    const boost::math::students_t null(degrees_of_freedom);
    const double critical = boost::math::quantile(complement(null, 0.5 * significance_level));
    if (noncentrality == 0.0) return significance_level;
    // Here the test fails with a probability below e^-800, and farther out Boost's series cannot be summed: for t below
    // the critical value, a normal deviate is below -noncentrality / 2, or chi-square is 1600 times its mean.
    if (noncentrality > 80.0 * std::max(1.0, critical)) return 1.0;
    const boost::math::non_central_t law(degrees_of_freedom, noncentrality);
    return boost::math::cdf(complement(law, critical)) + boost::math::cdf(law, -critical);
}

/// What the expected t is per difference of the estimates' means.
double noncentrality_per_difference(const TwoGroupDesign& design, std::size_t subjects_per_group) {
    return std::sqrt(0.5 * static_cast<double>(subjects_per_group)) / subject_sd(design);
}

double freedom_of(std::size_t subjects_per_group) {
    assert(subjects_per_group > 1);
    return 2.0 * static_cast<double>(subjects_per_group) - 2.0;
}

}  // namespace

double subject_sd(const TwoGroupDesign& design) {
    assert(design.repeats > 0);
    return std::hypot(design.between_subject_sd,
                      design.measurement_sd / std::sqrt(static_cast<double>(design.repeats)));
}

double power_of(const TwoGroupDesign& design, std::size_t subjects_per_group, double true_difference) {
    const double shown = std::abs(design.slope * true_difference);
    return power_at(shown * noncentrality_per_difference(design, subjects_per_group), freedom_of(subjects_per_group),
                    design.significance_level);
}

std::optional<double> detectable_difference(const TwoGroupDesign& design, std::size_t subjects_per_group,
                                            double power) {
    assert(power > design.significance_level && power < 1.0);
    if (design.slope == 0.0) return std::nullopt;
    const double freedom = freedom_of(subjects_per_group);
    const auto excess = [&](double noncentrality) {
        return power_at(noncentrality, freedom, design.significance_level) - power;
    };
    double high = 1.0;
    while (excess(high) < 0.0) high *= 2.0;
    std::uintmax_t iterations = 200;
    const auto [below, above] =
        boost::math::tools::toms748_solve(excess, 0.0, high, boost::math::tools::eps_tolerance<double>(40), iterations);
    return 0.5 * (below + above) / (noncentrality_per_difference(design, subjects_per_group) * std::abs(design.slope));
}

std::optional<std::size_t> subjects_needed(const TwoGroupDesign& design, double true_difference, double power) {
    assert(power > design.significance_level && power < 1.0);
    constexpr std::size_t most = 1'000'000;
    const auto suffice = [&](std::size_t subjects) { return power_of(design, subjects, true_difference) >= power; };
    if (suffice(2)) return 2;
    std::size_t too_few = 2;
    std::size_t enough = 4;
    while (!suffice(enough)) {
        if (enough >= most) return std::nullopt;
        too_few = enough;
        enough *= 2;
    }
    while (enough - too_few > 1) {
        const std::size_t middle = too_few + (enough - too_few) / 2;
        (suffice(middle) ? enough : too_few) = middle;
    }
    return enough > most ? std::nullopt : std::optional(enough);
}

}  // namespace skinfit
