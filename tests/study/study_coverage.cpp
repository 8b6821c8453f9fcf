#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "study/agreement.hpp"
#include "study/calibration.hpp"
#include "study/power.hpp"
#include "study/repeatability.hpp"
#include "study/roc.hpp"
#include "tests/study/draws.hpp"
#include "tests/support/statistics.hpp"

/// Simulated studies of known truth: intervals cover it in 95 % of them, and p-values are uniform.
namespace skinfit {
namespace {

using test::Draws;
using test::passing_p_value;

/// How often intervals cover the truth, and how often intervals of half the length would.
struct Covered {
    std::size_t studies = 0;
    std::size_t by_interval = 0;
    std::size_t by_half = 0;

    void count(const IntervalEstimate& found, double truth) {
        ++studies;
        const auto [lower, upper] = found.interval_95;
        if (lower <= truth && truth <= upper) ++by_interval;
        if (0.5 * (lower + found.value) <= truth && truth <= 0.5 * (upper + found.value)) ++by_half;
    }
    [[nodiscard]] double p_value() const { return p_value_of(by_interval); }
    [[nodiscard]] double p_value_of_half() const { return p_value_of(by_half); }

private:
    /// That `covered` comes from a probability of 95 %.
    [[nodiscard]] double p_value_of(std::size_t covered) const {
        const auto n = static_cast<double>(studies);
        return test::two_sided_p_value((static_cast<double>(covered) - 0.95 * n) / std::sqrt(0.95 * 0.05 * n));
    }
};

void expect_covers(const Covered& covered) {
    EXPECT_GT(covered.p_value(), passing_p_value) << covered.by_interval << " of " << covered.studies;
    EXPECT_LT(covered.p_value_of_half(), passing_p_value);
}

/// Whether values are standard normal in mean and in mean square.
struct StandardNormal {
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;

    void add(double z) {
        sum += z;
        squares += z * z;
        count += 1.0;
    }
    [[nodiscard]] double p_value() const {
        const std::vector<double> z = {sum / std::sqrt(count), (squares - count) / std::sqrt(2.0 * count)};
        return test::family_wise_p_value(z);
    }
};

TEST(StudyCoverage, AreaUnderTheCurve) {
    Draws draws(11);
    const double shift = 1.5;
    const double truth = 0.5 * std::erfc(-shift / 2.0);  // of normal scores: Phi(shift / sqrt 2)
    Covered covered;
    for (int study = 0; study < 2000; ++study) {
        std::vector<ScoredCase> cases;
        for (int i = 0; i < 140; ++i) cases.push_back({draws.normal() + (i % 2 == 0 ? shift : 0.0), i % 2 == 0});
        const RocArea area = roc_analysis(cases).area.value();
        covered.count({.value = area.value, .interval_95 = area.interval_95}, truth);
    }
    expect_covers(covered);
}

/// Labels are drawn with the probabilities; with labels of other probabilities the comparison must fail.
TEST(StudyCoverage, ExpectedAreaAndCalibrationTests) {
    Draws draws(12);
    std::vector<double> probabilities;
    for (int i = 0; i < 400; ++i) probabilities.push_back(std::pow(draws.uniform(), 2));
    const ExpectedRocArea expected = expected_roc_area(probabilities).value();
    for (const bool calibrated : {true, false}) {
        StandardNormal area;
        StandardNormal brier;
        StandardNormal positives;
        for (int study = 0; study < 500; ++study) {
            std::vector<ScoredCase> scored;
            std::vector<PredictedCase> predicted;
            for (const double p : probabilities) {
                const bool is_positive = draws.uniform() < (calibrated ? p : 0.8 * p + 0.1);
                scored.push_back({.score = p, .is_positive = is_positive});
                predicted.push_back({.probability = p, .is_positive = is_positive});
            }
            area.add((roc_analysis(scored).area->value - expected.value) / expected.standard_deviation);
            const CalibrationAnalysis found = calibration_analysis(predicted).value();
            brier.add(found.spiegelhalter_z.value());
            positives.add((static_cast<double>(found.observed_positives) - found.expected_positives) /
                          found.expected_positives_sd);
        }
        for (const StandardNormal& each : {area, brier, positives}) {
            if (calibrated) {
                EXPECT_GT(each.p_value(), passing_p_value);
            } else {
                EXPECT_LT(each.p_value(), passing_p_value);
            }
        }
    }
}

/// Estimates 1 + 0.8 reference + 0.6 normal of standard normal references.
TEST(StudyCoverage, Agreement) {
    Draws draws(13);
    Covered bias;
    Covered limit;
    Covered pearson;
    Covered concordance;
    Covered slope;
    Covered intercept;
    // differences: mean 1, variance 0.2^2 + 0.6^2; estimates: variance 0.8^2 + 0.6^2 = 1
    const double upper_limit = 1.0 + 1.959963984540054 * std::sqrt(0.4);
    for (int study = 0; study < 2000; ++study) {
        std::vector<ReferencePair> pairs;
        for (int i = 0; i < 100; ++i) {
            const double reference = draws.normal();
            pairs.push_back({.estimate = 1.0 + 0.8 * reference + 0.6 * draws.normal(),
                             .reference = reference,
                             .sigma = std::nullopt,
                             .interval_95 = std::nullopt});
        }
        const MethodAgreement found = method_agreement(pairs).value();
        bias.count(found.bias, 1.0);
        limit.count(found.upper_limit, upper_limit);
        pearson.count(found.pearson.value(), 0.8);
        concordance.count(found.concordance.value(), 2.0 * 0.8 / (1.0 + 1.0 + 1.0));  // [LIN89]
        slope.count(found.line->slope, 0.8);
        intercept.count(found.line->intercept, 1.0);
    }
    for (const Covered& each : {bias, limit, pearson, concordance, slope, intercept}) expect_covers(each);
}

TEST(StudyCoverage, Repeatability) {
    Draws draws(14);
    Covered within;
    Covered correlation;
    Covered ratio;
    std::vector<double> p_values;
    for (int study = 0; study < 2000; ++study) {
        std::vector<RepeatedEstimate> repeats;
        for (int specimen = 0; specimen < 8; ++specimen) {
            const double truth = 2.0 * draws.normal();
            for (int i = 0; i < 3; ++i) {
                repeats.push_back(
                    {.specimen = std::to_string(specimen), .estimate = truth + 3.0 * draws.normal(), .sigma = 3.0});
            }
        }
        const RepeatabilityAnalysis found = repeatability(repeats).value();
        within.count(found.within_specimen_sd, 3.0);
        correlation.count(found.intraclass_correlation.value(), 4.0 / 13.0);
        ratio.count(found.claimed->ratio, 1.0);
        p_values.push_back(found.claimed->p_value);
    }
    for (const Covered& each : {within, correlation, ratio}) expect_covers(each);
    EXPECT_GT(test::uniformity_p_value(p_values), passing_p_value);
}

/// Specimens of 1 to 5 repeats with sigmas that differ threefold.
TEST(StudyCoverage, UnequalRepeatsAndSigmas) {
    Draws draws(15);
    std::vector<double> p_values;
    std::vector<double> p_values_of_larger_scatter;
    for (int study = 0; study < 2000; ++study) {
        std::vector<RepeatedEstimate> repeats;
        std::vector<RepeatedEstimate> scattered;
        for (int specimen = 0; specimen < 10; ++specimen) {
            const double truth = 2.0 * draws.normal();
            for (int i = 0; i <= specimen % 5; ++i) {
                const double sigma = 1.0 + i;
                const double error = sigma * draws.normal();
                repeats.push_back({.specimen = std::to_string(specimen), .estimate = truth + error, .sigma = sigma});
                scattered.push_back(
                    {.specimen = repeats.back().specimen, .estimate = truth + 1.3 * error, .sigma = sigma});
            }
        }
        const RepeatabilityAnalysis found = repeatability(repeats).value();
        p_values.push_back(found.claimed->p_value);
        p_values_of_larger_scatter.push_back(repeatability(scattered)->claimed->p_value);
    }
    EXPECT_GT(test::uniformity_p_value(p_values), passing_p_value);
    EXPECT_LT(test::uniformity_p_value(p_values_of_larger_scatter), passing_p_value);
}

TEST(StudyCoverage, VarianceBetweenSpecimensIsUnbiasedForUnequalRepeats) {
    Draws draws(16);
    double sum = 0.0;
    double squares = 0.0;
    constexpr double studies = 4000;
    for (int study = 0; study < studies; ++study) {
        std::vector<RepeatedEstimate> repeats;
        for (int specimen = 0; specimen < 6; ++specimen) {
            const double truth = 2.0 * draws.normal();
            for (int i = 0; i <= specimen; ++i) {
                repeats.push_back(
                    {.specimen = std::to_string(specimen), .estimate = truth + draws.normal(), .sigma = std::nullopt});
            }
        }
        const double variance = repeatability(repeats)->between_specimen_variance.value();
        sum += variance;
        squares += variance * variance;
    }
    const double mean = sum / studies;
    const double error = std::sqrt((squares / studies - mean * mean) / studies);
    EXPECT_GT(test::two_sided_p_value((mean - 4.0) / error), passing_p_value);
    EXPECT_LT(test::two_sided_p_value((0.8 * mean - 4.0) / error), passing_p_value);
}

/// The test itself, on drawn groups: means over two repeats of 5 subjects, shrunk by 0.7.
TEST(StudyCoverage, Power) {
    Draws draws(17);
    const TwoGroupDesign design{.between_subject_sd = 1.0, .measurement_sd = 1.5, .repeats = 2, .slope = 0.7};
    constexpr std::size_t subjects = 5;
    const double difference = 3.0;
    std::uint64_t found = 0;
    constexpr std::uint64_t studies = 20'000;
    for (std::uint64_t study = 0; study < studies; ++study) {
        std::array<double, 2> mean{};
        double within = 0.0;
        for (const std::size_t group : {0U, 1U}) {
            double sum = 0.0;
            double sum_of_squares = 0.0;
            for (std::size_t i = 0; i < subjects; ++i) {
                const double subject = 0.7 * difference * static_cast<double>(group) + draws.normal();
                const double estimate = subject + 1.5 * 0.5 * (draws.normal() + draws.normal());
                sum += estimate;
                sum_of_squares += estimate * estimate;
            }
            mean[group] = sum / subjects;
            within += sum_of_squares - sum * mean[group];
        }
        const double t = (mean[1] - mean[0]) / std::sqrt(within / (2.0 * subjects - 2.0) * 2.0 / subjects);
        if (std::abs(t) > student_deviate_95(2.0 * subjects - 2.0)) ++found;
    }
    const auto p_value = [&](double power) {
        const auto n = static_cast<double>(studies);
        return test::two_sided_p_value((static_cast<double>(found) - power * n) / std::sqrt(power * (1.0 - power) * n));
    };
    EXPECT_GT(p_value(power_of(design, subjects, difference)), passing_p_value);
    EXPECT_LT(p_value(power_of(design, subjects, 1.1 * difference)), passing_p_value);
}

}  // namespace
}  // namespace skinfit
