#include "study/power.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skinfit {
namespace {

constexpr TwoGroupDesign unit{.between_subject_sd = 1.0, .measurement_sd = 0.0};

/// The examples of R's `power.t.test`: 20 subjects find one standard deviation with 0.8689528; 0.90 needs 22.02110.
TEST(Power, AgreesWithR) {
    EXPECT_NEAR(power_of(unit, 20, 1.0), 0.8689528, 1e-6);  // R leaves out the far tail, below 1e-6
    EXPECT_EQ(subjects_needed(unit, 1.0, 0.90), 23U);
    EXPECT_GT(std::abs(power_of(unit, 21, 1.0) - 0.8689528), 1e-2);
}

/// [COHEN88, Table 2.4.1], medium and large effects at 0.80.
TEST(Power, AgreesWithCohen) {
    EXPECT_EQ(subjects_needed(unit, 0.5, 0.80), 64U);
    EXPECT_EQ(subjects_needed(unit, 0.8, 0.80), 26U);
}

TEST(Power, WithoutADifferenceItIsTheSignificanceLevel) {
    EXPECT_EQ(power_of(unit, 10, 0.0), 0.05);
    EXPECT_NEAR(power_of(unit, 10, 1e-7), 0.05, 1e-12);
    EXPECT_EQ(power_of(unit, 10, -0.7), power_of(unit, 10, 0.7));
}

/// For many subjects t is normal: the sum of the quantiles at 97.5 % and 80 %.
TEST(Power, ForManySubjectsItIsThatOfTheNormalTest) {
    const double subjects = 1e6;
    const double normal = (1.959963984540054 + 0.8416212335729143) * std::sqrt(2.0 / subjects);
    // the deviates of t differ by their relative (z^2 + 1) / (4 nu), below 2 / subjects
    EXPECT_NEAR(detectable_difference(unit, 1'000'000, 0.8).value() / normal, 1.0, 4.0 / subjects);
}

TEST(Power, TheDetectableDifferenceIsFoundWithThePowerAsked) {
    for (const std::size_t subjects : {2U, 3U, 10U, 200U}) {
        for (const double power : {0.06, 0.5, 0.8, 0.99}) {
            const double difference = detectable_difference(unit, subjects, power).value();
            EXPECT_NEAR(power_of(unit, subjects, difference), power, 1e-9);
            EXPECT_GT(power_of(unit, subjects, 1.01 * difference), power + 1e-5);
        }
    }
}

TEST(Power, AsManySubjectsAsNeededSufficeAndOneLessDoesNot) {
    for (const double difference : {0.05, 0.3, 1.0, 2.5}) {
        const std::size_t subjects = subjects_needed(unit, difference, 0.9).value();
        EXPECT_GE(power_of(unit, subjects, difference), 0.9);
        EXPECT_LT(power_of(unit, subjects - 1, difference), 0.9);
    }
    EXPECT_EQ(subjects_needed(unit, 100.0, 0.9), 2U);
    EXPECT_FALSE(subjects_needed(unit, 1e-5, 0.9));
    EXPECT_FALSE(subjects_needed(unit, 0.0, 0.9));
}

TEST(Power, RepeatsAverageMeasurementsOnly) {
    const TwoGroupDesign design{.between_subject_sd = 3.0, .measurement_sd = 8.0, .repeats = 4};
    EXPECT_EQ(subject_sd(design), 5.0);
    EXPECT_NEAR(power_of(design, 12, 5.0), power_of(unit, 12, 1.0), 1e-14);
}

TEST(Power, ShrunkEstimatesNeedALargerDifference) {
    TwoGroupDesign shrunk = unit;
    shrunk.slope = 0.5;
    EXPECT_NEAR(detectable_difference(shrunk, 15, 0.8).value(), 2.0 * detectable_difference(unit, 15, 0.8).value(),
                1e-9);
    EXPECT_EQ(power_of(shrunk, 15, 1.0), power_of(unit, 15, 0.5));
    shrunk.slope = 0.0;
    EXPECT_FALSE(detectable_difference(shrunk, 15, 0.8));
    EXPECT_FALSE(subjects_needed(shrunk, 1.0, 0.8));
}

TEST(Power, HugeDifferencesAreCertain) {
    for (const std::size_t subjects : {2U, 3U, 100U, 1'000'000U}) {
        for (const double difference : {1e3, 1e6, 1e12}) EXPECT_EQ(power_of(unit, subjects, difference), 1.0);
    }
}

}  // namespace
}  // namespace skinfit
