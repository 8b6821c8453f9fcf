#pragma once

#include "fit/configuration.hpp"
#include "model/disk_cache.hpp"
#include "validation/inverse_study.hpp"

namespace skinfit {

/// The default of a recovery study: the default fit by the emulator with a noise of 0.003, uniform priors, blood
/// within the range of living skin [KA04], and not so much melanin that it hides the blood.
[[nodiscard]] Configuration study_configuration();

/// A recovery study and the parameters that it is about.
struct InverseStudy {
    std::vector<FreeParameter> free;
    std::vector<RecoveredSpectrum> spectra;
};

/// Recovers `design.spectra` skins at the configuration's `wavelengths` within its window, with its `noise` in place of
/// the design's. The spectra are simulated by `simulator`: over recorded walks with another seed where that is
/// Engine::paths, by an analog walk with a seed for each where it is Engine::walk, whose own noise counts as noise.
/// Throws InputError as `make_problem` does, and for a discrepancy, which is not simulated.
[[nodiscard]] InverseStudy run_inverse_study(const Configuration& configuration, Engine simulator,
                                             RecoveryDesign design, const DiskCache& cache,
                                             const RecoveryWatch& watch = {});

}  // namespace skinfit
