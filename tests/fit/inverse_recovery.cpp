#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <iostream>

#include "tests/fit/synthetic.hpp"
#include "tests/support/statistics.hpp"
#include "validation/inverse_summary.hpp"

namespace skinfit::test {
namespace {

/// How many spectra: 20, or as SKINFIT_RECOVERY_SPECTRA says.
std::uint64_t spectra_count() {
    const char* const text = std::getenv("SKINFIT_RECOVERY_SPECTRA");
    return text == nullptr ? 20 : std::stoull(text);
}

/// Posteriors over recorded walks take minutes: only where SKINFIT_RECOVERY_POSTERIOR is set.
bool with_posterior() {
    return std::getenv("SKINFIT_RECOVERY_POSTERIOR") != nullptr;
}

/// The best of Ceres' minima from the start and from points spread over the box.
Minimum best_of_several(const Objective& objective) {
    const FitProblem& problem = objective.problem();
    Minimum best = minimise_by_ceres(objective, starts(problem));
    const auto size = static_cast<Eigen::Index>(problem.free.size());
    for (int k = 1; k <= 6; ++k) {
        // Richtmyer's sequence: multiples of the roots of primes.
        Eigen::ArrayXd position = k * Eigen::ArrayXd::Map(std::array{2.0, 3.0, 5.0, 7.0, 11.0}.data(), size).sqrt();
        position -= position.floor();
        const Minimum other = minimise_by_ceres(objective, values_at(problem, position.matrix()));
        if (other.chi2 < best.chi2) best = other;
    }
    return best;
}

/// Living skin, not too dark for its blood to show.
Configuration physiological() {
    Configuration configuration = quick_configuration();
    configuration.noise = 0.003;
    const auto bound = [&](Parameter parameter, double lower, double upper) {
        configuration.bounds[static_cast<std::size_t>(parameter)] = {lower, upper};
    };
    bound(Parameter::melanosome_fraction, 0.01, 0.08);
    bound(Parameter::papillary_blood_fraction, 0.002, 0.07);
    bound(Parameter::reticular_blood_fraction, 0.002, 0.07);
    bound(Parameter::oxygen_saturation, 0.2, 1.0);
    return configuration;
}

TEST(InverseRecovery, IntervalsCoverAndRanksAreUniform) {
    const Configuration configuration = physiological();
    const Task task(configuration, modelled_spectrum(configuration, grid_nm(400, 700, 10)));
    const PathEnsemble ensemble = PathEnsemble::trace(task.problem.experiment.sample(), task.problem.wavelength_nm,
                                                      {.rays = 1000, .seed = configuration.seed});
    const Objective truth(task.problem, ensemble);
    const Simulator simulate = [&](std::span<const double> values) { return truth.model(values).reading; };
    const std::vector<RecoveredSpectrum> spectra =
        recover(task.problem, ensemble, simulate, best_of_several,
                {.spectra = spectra_count(), .with_posterior = with_posterior()});
    const RecoverySummary summary = summarised(spectra, task.problem.free);
    std::cout << recovery_text(summary);
    if (std::getenv("SKINFIT_RECOVERY_CSV") != nullptr) std::cerr << recovery_csv(spectra, task.problem.free);
    for (const ParameterRecovery& row : summary.parameters) {
        EXPECT_TRUE(row.coverage[1].passes().value_or(true)) << info(row.parameter).name;
        if (!with_posterior()) continue;
        EXPECT_TRUE(row.coverage[2].passes().value_or(true)) << info(row.parameter).name;
        EXPECT_GT(row.rank_p_value, passing_p_value) << info(row.parameter).name;
    }
}

}  // namespace
}  // namespace skinfit::test
