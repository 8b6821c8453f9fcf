#include "fit/derived.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skinfit::test {
namespace {

TEST(Derived, TotalBloodIsThatOfTheWholeDermis) {
    ParameterValues values;
    values.skin.papillary_blood_fraction = 0.04;
    values.skin.reticular_blood_fraction = 0.01;
    values.skin.papillary_dermis_thickness_cm = 0.02;
    values.skin.reticular_dermis_thickness_cm = 0.18;
    EXPECT_NEAR(derived_value(Derived::total_blood_fraction, values), (0.04 * 0.02 + 0.01 * 0.18) / 0.2, 1e-17);
}

TEST(Derived, SlopesAreDerivativesAndVanishWhereThereIsNoDependence) {
    ParameterValues values;
    values.skin.papillary_blood_fraction = 0.04;
    for (std::size_t i = 0; i < derived_count; ++i) {
        const auto quantity = static_cast<Derived>(i);
        for (const ParameterInfo& row : parameter_table()) {
            const double value = value_of(values, row.parameter);
            const double step = 1e-4 * (std::abs(value) + 1e-3);
            ParameterValues above = values;
            ParameterValues below = values;
            value_of(above, row.parameter) += step;
            value_of(below, row.parameter) -= step;
            const double difference = (derived_value(quantity, above) - derived_value(quantity, below)) / (2 * step);
            const double slope = derived_slope(quantity, values, row.parameter);
            // Relative third derivatives of ratios are below 6 / value^2, steps 1e-4 of the value; rounding: 4 ulps.
            const double error = 1e-7 * std::abs(slope) +
                                 4 * std::numeric_limits<double>::epsilon() * derived_value(quantity, values) / step;
            EXPECT_NEAR(slope, difference, error) << row.name;
            EXPECT_EQ(depends_on(quantity, row.parameter), slope != 0.0) << row.name;
        }
    }
}

}  // namespace
}  // namespace skinfit::test
