#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/uniform.hpp>
#include <cmath>

#include "fit/emulation.hpp"
#include "fit/problem.hpp"
#include "fit/simulation.hpp"
#include "model/emulator.hpp"
#include "study/manifest.hpp"
#include "tests/study/small_cohort.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit::test {
namespace {

/// The share of a distribution below x among what lies within the bounds.
template <class Law>
double share_below(const Law& law, double lower, double upper, double x) {
    const double below = cdf(law, lower);
    return (cdf(law, x) - below) / (cdf(law, upper) - below);
}

SimulatedCohort many_subjects() {
    Json json = small_cohort();
    json["groups"] = Json::array({{{"name", "all"}, {"subjects", 2000}}});
    return simulate(cohort_of(json), without_cache());
}

/// The p-value that the values of `parameter` have the distribution that `share` is of.
template <class Share>
double p_value(const SimulatedCohort& cohort, Parameter parameter, const Share& share) {
    std::vector<double> shares;
    for (const SimulatedSubject& subject : cohort.subjects)
        shares.push_back(share(value_of(subject.values, parameter)));
    return uniformity_p_value(shares);
}

TEST(CohortLaws, EveryParameterHasItsDistributionWithinItsBoundsAndNoShiftedOne) {
    namespace law = boost::math;
    const SimulatedCohort cohort = many_subjects();
    const auto check = [&cohort](Parameter parameter, const auto& share, double shift) {
        EXPECT_GT(p_value(cohort, parameter, share), passing_p_value) << info(parameter).name;
        const auto shifted = [&](double x) { return std::clamp(share(x + shift), 0.0, 1.0); };
        EXPECT_LT(p_value(cohort, parameter, shifted), passing_p_value) << info(parameter).name;
    };
    // Shifts of a third of a standard deviation.
    check(
        Parameter::melanosome_fraction,
        [](double x) { return share_below(law::uniform_distribution<double>(0.01, 0.1), 0.01, 0.1, x); }, 0.009);
    check(
        Parameter::hemoglobin_g_per_l,
        [](double x) { return share_below(law::normal_distribution<double>(150, 10), 134, 173, x); }, 3);
    check(
        Parameter::oxygen_saturation,
        [](double x) { return share_below(law::beta_distribution<double>(6, 3), 0, 1, std::min(x, 1.0)); }, 0.05);
    check(
        Parameter::bilirubin_g_per_l,
        [](double x) { return share_below(law::lognormal_distribution<double>(std::log(0.2), 1), 0, 3, x); }, 0.06);
}

/// A cohort of one group whose noise is looked at.
Json noisy(std::uint64_t subjects, std::uint64_t repeats, const Json& discrepancy) {
    Json json = small_cohort();
    json["wavelengths"] = "450,470,480,520,600";
    json["discrepancy"] = discrepancy;
    json["repeats"] = repeats;
    json["groups"] = Json::array({{{"name", "all"}, {"subjects", subjects}}});
    return json;
}

/// The covariance of departure and noise: [RASMUSSEN06, Eqs. 4.9, 4.17] and its diagonal.
Eigen::MatrixXd covariance(const std::vector<double>& nm, double noise, double sigma, double length_nm, bool matern) {
    const auto count = static_cast<Eigen::Index>(nm.size());
    return Eigen::MatrixXd::NullaryExpr(count, count, [&](Eigen::Index a, Eigen::Index b) {
        const double d = std::abs(nm[static_cast<std::size_t>(a)] - nm[static_cast<std::size_t>(b)]) / length_nm;
        const double correlation =
            matern ? (1 + std::sqrt(3.0) * d) * std::exp(-std::sqrt(3.0) * d) : std::exp(-d * d / 2);
        return sigma * sigma * correlation + (a == b ? noise * noise : 0.0);
    });
}

/// The two-sided p-value that `differences` are normal with that covariance: of the sum of their whitened squares, and
/// of the shares of each whitened number.
double p_value(const std::vector<Eigen::VectorXd>& differences, const Eigen::MatrixXd& covariance) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance);
    double squares = 0.0;
    std::vector<double> shares;
    for (const Eigen::VectorXd& difference : differences) {
        const Eigen::VectorXd white = cholesky.matrixL().solve(difference);
        squares += white.squaredNorm();
        for (const double number : white) shares.push_back(0.5 * std::erfc(-number / std::sqrt(2.0)));
    }
    const double above = chi_square_p_value(squares, static_cast<double>(shares.size()));
    return std::min({2.0 * above, 2.0 * (1.0 - above), uniformity_p_value(shares)});
}

Eigen::VectorXd vector_of(const std::vector<double>& numbers) {
    return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

TEST(CohortLaws, ReadingsDepartFromTheModelByNoiseAndDiscrepancyAsStated) {
    for (const bool matern : {false, true}) {
        const Json discrepancy = {
            {"sigma", 0.006}, {"length_nm", 25}, {"kernel", matern ? "matern_3_2" : "squared_exponential"}};
        const SimulatedCohort cohort = simulate(cohort_of(noisy(1000, 1, discrepancy)), without_cache());
        std::vector<Eigen::VectorXd> differences;
        for (const SimulatedSubject& subject : cohort.subjects) {
            differences.emplace_back(vector_of(subject.reading.front()) - vector_of(subject.noise_free));
        }
        const auto p = [&](double noise, double sigma, double length_nm) {
            return p_value(differences, covariance(cohort.wavelength_nm, noise, sigma, length_nm, matern));
        };
        EXPECT_GT(p(0.004, 0.006, 25), passing_p_value);
        EXPECT_LT(p(0.004 * 1.15, 0.006, 25), passing_p_value);
        EXPECT_LT(p(0.004, 0.006 * 1.3, 25), passing_p_value);
        EXPECT_LT(p(0.004, 0.006, 50), passing_p_value);
    }
}

TEST(CohortLaws, RepeatsShareTheSkinAndItsDepartureAndDifferByNoiseAlone) {
    const SimulatedCohort cohort = simulate(cohort_of(noisy(1000, 2, {{"sigma", 0.05}})), without_cache());
    std::vector<Eigen::VectorXd> differences;
    for (const SimulatedSubject& subject : cohort.subjects) {
        ASSERT_EQ(subject.reading.size(), 2U);
        differences.emplace_back((vector_of(subject.reading[0]) - vector_of(subject.reading[1])) / std::sqrt(2.0));
    }
    EXPECT_GT(p_value(differences, covariance(cohort.wavelength_nm, 0.004, 0, 25, false)), passing_p_value);
    EXPECT_LT(p_value(differences, covariance(cohort.wavelength_nm, 0.0045, 0, 25, false)), passing_p_value);
}

/// The readings of a subject, all repeats.
using Readings = std::vector<std::vector<double>>;

std::vector<Readings> readings_of(const Json& json, const std::string& group) {
    const Cohort cohort = cohort_of(json);
    std::vector<Readings> readings;
    for (const SimulatedSubject& subject : simulate(cohort, without_cache()).subjects) {
        if (cohort.groups[subject.group].name == group) readings.push_back(subject.reading);
    }
    return readings;
}

TEST(CohortLaws, SubjectsStayTheSameWhenGroupsSubjectsOrRepeatsAreAdded) {
    const Json json = small_cohort();
    const std::vector<Readings> before = readings_of(json, "second one");
    Json more = json;
    const Json added = {{"name", "new"}, {"subjects", 2}};
    more["groups"].insert(more["groups"].begin(), added);
    EXPECT_EQ(readings_of(more, "second one"), before);
    more["groups"].back()["subjects"] = 5;
    more["repeats"] = 2;
    const std::vector<Readings> after = readings_of(more, "second one");
    ASSERT_EQ(after.size(), 5U);
    for (std::size_t k = 0; k < before.size(); ++k) EXPECT_EQ(after[k].front(), before[k].front());
}

TEST(CohortLaws, AnotherSeedOrNameIsAnotherSample) {
    Json json = small_cohort();
    const std::vector<Readings> before = readings_of(json, "first");
    json["groups"].push_back({{"name", "alike"}, {"subjects", 4}});
    EXPECT_NE(readings_of(json, "alike"), before);
    json["seed"] = 6;
    EXPECT_NE(readings_of(json, "first"), before);
}

TEST(CohortLaws, TablesAreTheSameOnAnyNumberOfThreads) {
    const Cohort cohort = cohort_of(small_cohort());
    const auto tables = [&cohort](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const SimulatedCohort simulated = simulate(cohort, without_cache());
        return cohort_spectra_csv(cohort, simulated) + manifest_csv(cohort, simulated);
    };
    EXPECT_EQ(tables(1), tables(4));
}

TEST(CohortLaws, TheEmulatorReadsWhatTheSolverDoes) {
    Json json = small_cohort();
    const SimulatedCohort solved = simulate(cohort_of(json), without_cache());
    json["model"]["engine"] = "emulator";
    const Cohort cohort = cohort_of(json);
    const SimulatedCohort emulated = simulate(cohort, without_cache());
    for (std::size_t k = 0; k < solved.subjects.size(); ++k) {
        const Configuration& configuration = cohort.groups[solved.subjects[k].group].configuration;
        const FitProblem problem = make_problem(configuration, blank_spectrum(configuration));
        const double error = Emulator::build(emulator_domain(problem)).certified_error();
        for (std::size_t i = 0; i < solved.wavelength_nm.size(); ++i) {
            EXPECT_NEAR(solved.subjects[k].noise_free[i], emulated.subjects[k].noise_free[i], error);
        }
    }
}

}  // namespace
}  // namespace skinfit::test
