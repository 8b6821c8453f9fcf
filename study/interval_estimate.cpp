#include "study/interval_estimate.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <numbers>

namespace skinfit {
namespace {

constexpr double tail = 0.025;

}  // namespace

double normal_deviate_95() {
    static const double deviate = boost::math::quantile(boost::math::complement(boost::math::normal(), tail));
    return deviate;
}

double student_deviate_95(double degrees_of_freedom) {
    return boost::math::quantile(boost::math::complement(boost::math::students_t(degrees_of_freedom), tail));
}

double two_sided_normal_p_value(double z) {
    return std::erfc(std::abs(z) / std::numbers::sqrt2);
}

double upper_chi_square_p_value(double statistic, double degrees_of_freedom) {
    return std::isinf(statistic)
               ? 0.0
               : boost::math::cdf(boost::math::complement(boost::math::chi_squared(degrees_of_freedom), statistic));
}

Bounds standard_deviation_factors_95(double degrees_of_freedom) {
    const boost::math::chi_squared law(degrees_of_freedom);
    return {.lower = std::sqrt(degrees_of_freedom / boost::math::quantile(boost::math::complement(law, tail))),
            .upper = std::sqrt(degrees_of_freedom / boost::math::quantile(law, tail))};
}

// [WILSON27]: the probabilities p with |share - p| <= z sqrt(p (1 - p) / n).
Proportion proportion(std::size_t count, std::size_t trials) {
    assert(trials > 0 && count <= trials);
    const auto n = static_cast<double>(trials);
    const double share = static_cast<double>(count) / n;
    const double z2 = normal_deviate_95() * normal_deviate_95();
    const double centre = (share + 0.5 * z2 / n) / (1.0 + z2 / n);
    const double half = std::sqrt(z2 * (share * (1.0 - share) / n + 0.25 * z2 / (n * n))) / (1.0 + z2 / n);
    // Of none and of all, an end is 0 or 1 but for rounding.
    return {.count = count,
            .trials = trials,
            .interval_95 = {.lower = count == 0 ? 0.0 : centre - half, .upper = count == trials ? 1.0 : centre + half}};
}

}  // namespace skinfit
