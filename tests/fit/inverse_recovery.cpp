#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "tests/fit/synthetic.hpp"
#include "tests/support/statistics.hpp"
#include "validation/inverse_summary.hpp"

namespace skinfit::test {
namespace {

/// How many spectra: 50, or as SKINFIT_RECOVERY_SPECTRA says.
std::uint64_t spectra_count() {
    const char* const text = std::getenv("SKINFIT_RECOVERY_SPECTRA");
    return text == nullptr ? 50 : std::stoull(text);
}

TEST(InverseRecovery, IntervalsCoverAndRanksAreUniform) {
    Configuration configuration = quick_configuration();
    configuration.noise = 0.003;
    const Task task(configuration, modelled_spectrum(configuration, grid_nm(400, 700, 10)));
    const PathEnsemble ensemble = PathEnsemble::trace(task.problem.experiment.sample(), task.problem.wavelength_nm,
                                                      {.rays = 1000, .seed = configuration.seed});
    const Objective truth(task.problem, ensemble);
    const Simulator simulate = [&](std::span<const double> values) { return truth.model(values).reading; };
    const Minimiser minimise = [](const Objective& objective) {
        return minimise_by_ceres(objective, starts(objective.problem()));
    };
    const std::vector<RecoveredSpectrum> spectra =
        recover(task.problem, ensemble, simulate, minimise, {.spectra = spectra_count()});
    const RecoverySummary summary = summarised(spectra, task.problem.free);
    std::cout << recovery_text(summary);
    if (std::getenv("SKINFIT_RECOVERY_CSV") != nullptr) std::cerr << recovery_csv(spectra, task.problem.free);
    for (const ParameterRecovery& row : summary.parameters) {
        EXPECT_GT(row.rank_p_value, passing_p_value) << info(row.parameter).name;
        for (const std::size_t method : {1U, 2U}) {
            EXPECT_TRUE(row.coverage[method].passes().value_or(true)) << info(row.parameter).name << " " << method;
        }
    }
}

}  // namespace
}  // namespace skinfit::test
