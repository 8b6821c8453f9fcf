#include "fit/diagnosis.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/fit/example_result.hpp"

namespace skinfit::test {
namespace {

/// Expects exactly one reason, which begins with `rule` and says what to do, and the verdict.
void expect_only(const FitResult& result, const std::string& rule, Verdict verdict = Verdict::suspect) {
    const Diagnosis diagnosis = diagnose(result);
    EXPECT_EQ(diagnosis.verdict, verdict) << rule;
    ASSERT_EQ(diagnosis.reasons.size(), 1U) << rule;
    EXPECT_TRUE(diagnosis.reasons[0].starts_with(rule)) << diagnosis.reasons[0];
    EXPECT_NE(diagnosis.reasons[0].find("; "), std::string::npos) << diagnosis.reasons[0];
}

void expect_trusted(const FitResult& result) {
    const Diagnosis diagnosis = diagnose(result);
    EXPECT_EQ(diagnosis.verdict, Verdict::consistent);
    EXPECT_TRUE(diagnosis.reasons.empty()) << diagnosis.reasons.front();
}

FittedParameter& melanosomes(FitResult& result) {
    return result.free.front();
}

TEST(Diagnosis, TrustsWhereNothingIsWrong) {
    expect_trusted(good_result());
}

TEST(Diagnosis, WithoutConvergenceNothingElseMatters) {
    FitResult result = example_result();
    result.answer.minimum.converged = false;
    expect_only(result, "NOT CONVERGED: Function tolerance reached.", Verdict::failed);
}

TEST(Diagnosis, MisfitBelowOneInAThousand) {
    FitResult result = good_result();
    result.p_value = 0.00101;
    expect_trusted(result);
    result.p_value = 0.00099;
    expect_only(result, "MISFIT beyond the noise");
    result.p_value = 0.0;
    expect_only(result, "MISFIT beyond the noise");
}

TEST(Diagnosis, NoDegreesOfFreedom) {
    FitResult result = good_result();
    result.degrees_of_freedom = 0;
    result.p_value.reset();
    expect_only(result, "NO DEGREES OF FREEDOM");
}

TEST(Diagnosis, AtEitherBoundNamesTheParameterAndTheBound) {
    FitResult result = good_result();
    melanosomes(result).uncertainty.status = Status::at_upper_bound;
    melanosomes(result).value = 0.5;
    expect_only(result, "AT BOUND: melanosome_fraction ended at its upper bound 0.5");
    melanosomes(result).uncertainty.status = Status::at_lower_bound;
    melanosomes(result).value = 0.01;
    melanosomes(result).bounds.lower = 0.01;
    expect_only(result, "AT BOUND: melanosome_fraction ended at its lower bound 0.01");
}

TEST(Diagnosis, NoneOfAnAbsorberIsAnUpperLimitAndNoSaturationIsNot) {
    FitResult result = good_result();
    melanosomes(result).uncertainty.status = Status::at_lower_bound;
    melanosomes(result).value = 0.0;
    expect_trusted(result);
    melanosomes(result).parameter = Parameter::oxygen_saturation;
    expect_only(result, "AT BOUND");
}

TEST(Diagnosis, NotIdentifiable) {
    FitResult result = good_result();
    melanosomes(result).uncertainty.status = Status::not_identifiable;
    expect_only(result, "NOT IDENTIFIABLE: around its fitted value the spectrum says less about melanosome_fraction");
}

TEST(Diagnosis, TooFewRaysAboveHalfTheNoiseSaysHowManyAreNeeded) {
    FitResult result = good_result();
    result.monte_carlo_error = 0.5 * result.median_sigma;
    expect_trusted(result);
    // At the noise itself: the error falls with the root, so that four times the 100000 rays halve it.
    result.monte_carlo_error = result.median_sigma;
    expect_only(result, "TOO FEW RAYS");
    EXPECT_NE(diagnose(result).reasons[0].find("set rays to at least 400000"), std::string::npos);
}

TEST(Diagnosis, EmulatorTooCoarseAboveHalfTheNoise) {
    FitResult result = good_result();
    result.emulator_error = 0.5 * result.median_sigma;
    expect_trusted(result);
    result.emulator_error = 0.51 * result.median_sigma;
    expect_only(result, "EMULATOR TOO COARSE");
}

TEST(Diagnosis, ABetterMinimumThatAProfileMet) {
    FitResult result = good_result();
    result.profile = Profile{.intervals = {}, .minimum = {}, .cost = 0, .better_minimum = false, .evaluations = 0};
    expect_trusted(result);
    result.profile->better_minimum = true;
    expect_only(result, "BETTER MINIMUM");
}

FitResult with_other_answer(double cost, double sigmas_away) {
    FitResult result = good_result();
    SolverAnswer other = result.answer;
    other.solver = Solver::bobyqa;
    other.minimum.cost = cost;
    other.minimum.values[0] += sigmas_away * *melanosomes(result).uncertainty.sigma;
    result.cross_check.push_back(other);
    return result;
}

TEST(Diagnosis, SolversMayDifferByNoMoreThanStated) {
    const double cost = good_result().cost;
    expect_trusted(with_other_answer(cost, 0.0));
    expect_trusted(with_other_answer(cost - 0.0009, 0.099));
    expect_only(with_other_answer(cost - 0.0011, 0.0), "SOLVERS DISAGREE");
    expect_only(with_other_answer(cost, 0.101), "SOLVERS DISAGREE");
    expect_only(with_other_answer(cost, -0.101), "SOLVERS DISAGREE");
    // That the other solver did worse is no reason.
    expect_trusted(with_other_answer(cost + 1.0, 0.0));
    expect_trusted(with_other_answer(cost + 1.0, 5.0));
}

FitResult with_other_minimum(double cost) {
    FitResult result = good_result();
    DistinctMinimum other{.minimum = result.answer.minimum, .searches = 2};
    other.minimum.cost = cost;
    other.minimum.values[0] *= 2.0;
    result.searches.minima.push_back(other);
    return result;
}

TEST(Diagnosis, ASecondMinimumMattersWhereItIsAlmostAsGood) {
    const double cost = good_result().cost;
    expect_trusted(with_other_minimum(cost + 3.85));
    expect_only(with_other_minimum(cost + 3.83), "SECOND MINIMUM");
}

TEST(Diagnosis, ResidualsInRunsBelowOneInAThousand) {
    FitResult result = good_result();
    result.slow_residuals_p_value = 0.00101;
    expect_trusted(result);
    result.slow_residuals_p_value = 0.00099;
    expect_only(result, "RESIDUALS IN RUNS");
    EXPECT_NE(diagnose(result).reasons[0].find("set discrepancy,"), std::string::npos);
}

TEST(Diagnosis, RunsBeyondADiscrepancyAreNotToldToSetOne) {
    FitResult result = good_result();
    result.slow_residuals_p_value = 0.00099;
    result.configuration.discrepancy = Discrepancy{};
    expect_only(result, "RESIDUALS IN RUNS: their slow part is larger than the noise and a discrepancy of 0.005");
    EXPECT_EQ(diagnose(result).reasons[0].find("set discrepancy,"), std::string::npos);
    EXPECT_NE(diagnose(result).reasons[0].find("set a larger sigma or a shorter length_nm"), std::string::npos);
}

TEST(Diagnosis, ADepartureBeyondWhatMeasuredSpectraShow) {
    FitResult result = good_result();
    result.configuration.discrepancy = Discrepancy{.sigma = 0.01};
    result.departure_rms = 0.0146;
    expect_trusted(result);
    result.departure_rms = 0.0148;
    expect_only(result, "UNUSUAL DEPARTURE");
    result.configuration.discrepancy.reset();
    expect_trusted(result);
}

FitResult with_alternative(double left_out_rmse, double value) {
    FitResult result = good_result();
    result.other_assumptions = OtherAssumptions{
        .answers = {{.name = "oxygen_saturation", .value = 0.7, .interval_95 = {0.6, 0.8}}},
        .left_out_rmse = 0.005,
        .alternatives = {{.assumption = "scale free", .left_out_rmse = left_out_rmse, .values = {value}}}};
    return result;
}

TEST(Diagnosis, AnAnswerThatLeavesItsIntervalUnderAnAssumptionThatPredictsBetter) {
    expect_only(with_alternative(0.0039, 0.81),
                "DEPENDS ON AN ASSUMPTION: with scale free oxygen_saturation would be 0.81 instead of 0.7");
    expect_only(with_alternative(0.0039, 0.59), "DEPENDS ON AN ASSUMPTION: with scale free");
    expect_trusted(with_alternative(0.0039, 0.79));
    expect_trusted(with_alternative(0.0041, 0.81));
}

TEST(Diagnosis, FewerWavelengthsThanParameters) {
    FitResult result = good_result();
    result.spectra.front().measured.clear();
    result.p_value.reset();
    expect_only(result, "FEWER WAVELENGTHS THAN PARAMETERS: 0 for 1");
}

TEST(Diagnosis, EveryReasonIsListed) {
    const std::vector<std::string> reasons = diagnose(example_result()).reasons;
    const auto count = [&](const char* rule) {
        return std::ranges::count_if(reasons, [rule](const std::string& reason) { return reason.starts_with(rule); });
    };
    EXPECT_EQ(count("FEWER WAVELENGTHS THAN PARAMETERS"), 1);
    EXPECT_EQ(count("AT BOUND"), 1);
    EXPECT_EQ(count("NOT IDENTIFIABLE"), 1);
    EXPECT_EQ(count("SOLVERS DISAGREE"), 1);
    EXPECT_EQ(reasons.size(), 4U);
}

}  // namespace
}  // namespace skinfit::test
