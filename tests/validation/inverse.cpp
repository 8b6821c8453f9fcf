#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "core/input_error.hpp"
#include "fit/configuration_json.hpp"
#include "tests/support/statistics.hpp"
#include "validation/inverse_run.hpp"
#include "validation/inverse_summary.hpp"

namespace skinfit::test {
namespace {

DiskCache no_cache() {
    return {.folder = std::nullopt, .warn = [](const std::string&) {}, .inform = [](const std::string&) {}};
}

/// Few parameters, so that an emulator is quickly built.
Configuration quick_study() {
    return with_freedom(study_configuration(), "papillary_blood_fraction,bilirubin_g_per_l", false, "test");
}

InverseStudy study(const Configuration& configuration, Engine simulator, std::uint64_t spectra,
                   const std::array<bool, uncertainty_method_count>& intervals) {
    RecoveryDesign design;
    design.spectra = spectra;
    design.intervals = intervals;
    return run_inverse_study(configuration, simulator, design, no_cache());
}

TEST(InverseStudy, FiftySpectraOfTheSolverAreRecoveredByTheEmulator) {
    const InverseStudy found = study(study_configuration(), Engine::solver, 50, {true, true, true});
    const RecoverySummary summary = summarised(found.spectra, found.free);
    EXPECT_EQ(summary.not_converged, 0U);
    EXPECT_GE(summary.best_minimum.agreeing, 49U);
    // Of 1000 such posteriors 27 had not mixed (docs/inverse.md): ten or more of 50 have a probability below 1e-6.
    EXPECT_LE(summary.not_mixed, 9U);
    for (const ParameterRecovery& row : summary.parameters) {
        const std::string_view name = info(row.parameter).name;
        for (const UncertaintyMethod method : {UncertaintyMethod::profile, UncertaintyMethod::posterior}) {
            const Coverage& coverage = *row.coverage[static_cast<std::size_t>(method)];
            // The tests of this project pass above 1e-6: of 50 a share of 95 % loses 13 or more as rarely.
            EXPECT_LE(coverage.identifiable - coverage.covered, 12U) << name;
        }
        EXPECT_GT(*row.rank_p_value, passing_p_value) << name;
    }
}

TEST(InverseStudy, SpectraOfTheWalkAreRecoveredByPathsOfOtherRays) {
    Configuration configuration = quick_study();
    configuration.engine = Engine::paths;
    configuration.rays = 40'000;
    configuration.noise = 0.005;
    const InverseStudy found = study(configuration, Engine::walk, 10, {false, true, false});
    const RecoverySummary summary = summarised(found.spectra, found.free);
    EXPECT_EQ(summary.not_converged, 0U);
    for (const ParameterRecovery& row : summary.parameters) {
        const Coverage& coverage = *row.coverage[static_cast<std::size_t>(UncertaintyMethod::profile)];
        // The tests of this project pass above 1e-6: of 10 a share of 95 % loses 7 or more as rarely.
        EXPECT_LE(coverage.identifiable - coverage.covered, 6U) << info(row.parameter).name;
    }
}

TEST(InverseStudy, AWalkWithMoreNoiseThanTheStudyIsRefused) {
    Configuration configuration = quick_study();
    configuration.rays = 1000;
    EXPECT_THROW((void)study(configuration, Engine::walk, 1, {true, false, false}), InputError);
}

TEST(InverseStudy, OnlyTheIntervalsAskedForAreComputed) {
    const InverseStudy found = study(quick_study(), Engine::emulator, 2, {false, true, false});
    for (const ParameterRecovery& row : summarised(found.spectra, found.free).parameters) {
        EXPECT_FALSE(row.coverage[0].has_value());
        EXPECT_TRUE(row.coverage[1].has_value());
        EXPECT_FALSE(row.rank_p_value.has_value());
    }
}

TEST(InverseStudy, IsTheSameOnAnyNumberOfThreads) {
    const auto csv = [](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const InverseStudy found = study(quick_study(), Engine::emulator, 25, {true, true, false});
        return recovery_csv(found.spectra, found.free);
    };
    EXPECT_EQ(csv(1), csv(2));
}

TEST(InverseStudy, TellsThatIntervalsAreHalfAsWideAsTheyShouldBe) {
    const Configuration configuration = quick_study();
    const InverseStudy right = study(configuration, Engine::emulator, 60, {true, false, false});
    std::vector<RecoveredSpectrum> wrong = right.spectra;
    for (RecoveredSpectrum& spectrum : wrong) {
        for (RecoveredParameter& parameter : spectrum.parameters) {
            Bounds& interval = parameter.intervals[0]->interval_95;
            const double middle = parameter.estimate;
            interval = {middle + 0.5 * (interval.lower - middle), middle + 0.5 * (interval.upper - middle)};
        }
    }
    // Half as wide, intervals cover 67 %: of 60 about 20 are lost, where chance allows 10.
    const RecoverySummary summary = summarised(wrong, right.free);
    for (const ParameterRecovery& row : summary.parameters) {
        if (row.coverage[0]->identifiable < 50) continue;
        EXPECT_FALSE(row.coverage[0]->passes().value_or(true)) << info(row.parameter).name;
    }
}

RecoveredSpectrum recovered(double truth, const Bounds& interval, int rank) {
    const RecoveredParameter::Interval found{.status = Status::free, .interval_95 = interval};
    return {.parameters = {{.truth = truth, .estimate = 0.5, .intervals = {found, found, found}, .rank = rank}},
            .converged = true,
            .cost = 25.0,
            .best_cost = 25.0,
            .other_cost = 25.0,
            .other_sigmas = 0.0,
            .worst_r_hat = 1.0,
            .divergences = 0};
}

TEST(RecoverySummary, JudgesCoverageRanksAndSearches) {
    const std::vector<FreeParameter> free = {
        {.parameter = Parameter::oxygen_saturation, .start = 0.5, .bounds = {0.0, 1.0}}};
    std::vector<RecoveredSpectrum> spectra;
    for (int k = 0; k < 1000; ++k) spectra.push_back(recovered(k % 20 == 0 ? 0.9 : 0.6, {0.4, 0.7}, k % 100));
    RecoverySummary summary = summarised(spectra, free);
    EXPECT_TRUE(passes(summary));
    EXPECT_EQ(summary.parameters[0].coverage[1]->share(), 0.95);
    EXPECT_EQ(*summary.parameters[0].rank_p_value, 1.0);
    EXPECT_NEAR(summary.parameters[0].bias, 0.5 - (0.95 * 0.6 + 0.05 * 0.9), 1e-12);

    std::vector<RecoveredSpectrum> other = spectra;
    const auto with_other_minima = [&](int count) {
        std::vector<RecoveredSpectrum> found = spectra;
        for (int k = 0; k < count; ++k) found[static_cast<std::size_t>(k)].best_cost = 24.0;
        return summarised(found, free);
    };
    // Of 1000 spectra, each of which misses with a probability of 0.005: 13 or more in 0.19 % of studies, 14 or more in
    // 0.07 %.
    EXPECT_TRUE(passes(with_other_minima(13)));
    EXPECT_FALSE(passes(with_other_minima(14)));
    EXPECT_EQ(recovery_text(with_other_minima(13)).find("FAILS"), std::string::npos);

    other = spectra;
    for (RecoveredSpectrum& each : other) *each.parameters[0].rank /= 2;
    EXPECT_FALSE(passes(summarised(other, free)));

    other = spectra;
    for (int k = 0; k < 30; ++k) other[static_cast<std::size_t>(k)].other_sigmas = 0.06;
    EXPECT_FALSE(passes(summarised(other, free)));

    other = spectra;
    for (int k = 0; k < 1000; k += 40) other[static_cast<std::size_t>(k) + 1].parameters[0].truth = 0.9;
    EXPECT_FALSE(passes(summarised(other, free)));
}

TEST(RecoverySummary, TheVerdictIsThatOfItsLines) {
    const std::vector<FreeParameter> free = {
        {.parameter = Parameter::oxygen_saturation, .start = 0.5, .bounds = {0.0, 1.0}}};
    std::vector<RecoveredSpectrum> spectra;
    for (int k = 0; k < 100; ++k) spectra.push_back(recovered(k % 20 == 0 ? 0.9 : 0.6, {0.4, 0.7}, k));
    // Intervals by covariance that never hold the truth are judged by nobody.
    for (RecoveredSpectrum& each : spectra) each.parameters[0].intervals[0]->interval_95 = {0.1, 0.2};
    EXPECT_TRUE(recovery_text(summarised(spectra, free)).starts_with("verdict: passes"));
    EXPECT_EQ(recovery_text(summarised(spectra, free)).find("FAILS"), std::string::npos);
    EXPECT_TRUE(
        recovery_json(summarised(spectra, free))["parameters"]["oxygen_saturation"]["coverage"]["covariance"]["passes"]
            .is_null());
    std::vector<RecoveredSpectrum> uneven = spectra;
    for (RecoveredSpectrum& each : uneven) *each.parameters[0].rank /= 4;
    const std::string text = recovery_text(summarised(uneven, free));
    EXPECT_TRUE(text.starts_with("verdict: FAILS"));
    EXPECT_NE(text.find("FAILS", 20), std::string::npos) << "the line that fails says so";
}

TEST(RecoverySummary, WhatChanceMakesPasses) {
    // Of 100, each of which misses with a probability of 0.01: 2 or more in 26 % of studies, 5 or more in 0.34 %, 6 or
    // more in 0.05 %.
    const auto passes_without = [](std::size_t missing) {
        return Agreement{.spectra = 100, .agreeing = 100 - missing, .wanted_share = 0.99}.passes();
    };
    EXPECT_TRUE(passes_without(2));
    EXPECT_TRUE(passes_without(5));
    EXPECT_FALSE(passes_without(6));
    // 95 % intervals of five: 2 or more missing in 2.3 % of studies, 4 or more in 3e-5, all 5 covered in 77 %.
    EXPECT_TRUE((Coverage{.identifiable = 5, .covered = 3}.passes().value()));
    EXPECT_FALSE((Coverage{.identifiable = 5, .covered = 1}.passes().value()));
    EXPECT_TRUE((Coverage{.identifiable = 5, .covered = 5}.passes().value()));
    EXPECT_FALSE((Coverage{.identifiable = 0, .covered = 0}.passes().has_value()));
}

}  // namespace
}  // namespace skinfit::test
