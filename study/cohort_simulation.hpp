#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "model/disk_cache.hpp"
#include "study/cohort.hpp"

namespace skinfit {

/// One subject: what is true of the skin, and what was read of it.
struct SimulatedSubject {
    std::size_t group;                         ///< place among the cohort's groups
    std::uint64_t number;                      ///< within the group, from 1
    ParameterValues values;                    ///< of skin and instrument
    std::optional<ScatteringLaw> scattering;   ///< of a cohort by transport
    std::vector<double> noise_free;            ///< what the model or the transport reads, a fraction per wavelength
    std::vector<std::vector<double>> reading;  ///< one spectrum per repeat
};

/// Every subject of a cohort, group by group.
struct SimulatedCohort {
    std::vector<double> wavelength_nm;
    std::vector<SimulatedSubject> subjects;
};

/// Whoever waits for a simulation.
struct SimulationWatch {
    std::stop_token stop{};  ///< asks for an end: Cancelled is thrown
    /// How many wavelengths the transport has done, which takes minutes; empty: nobody listens.
    std::function<void(std::size_t done)> progress{};
};

/// Draws and measures every subject: reading = model + departure + noise. The model's departure from real skin belongs
/// to the skin: it is drawn once for a subject and is in all of the repeats; noise is independent in every value.
///
/// A cohort by transport has its readings from `skin_spectra` in place of a model: skins of like scattering share
/// traces, with the cohort's seed, so their Monte Carlo errors are in common; see docs/studies.md.
///
/// The random numbers of a subject depend on seed, name of the group and number of the subject alone: they stay the
/// same on any number of threads, and when groups, subjects or repeats are added. Progress of what has to be built
/// first goes to `cache`. Throws InputError where the engine cannot compute what the cohort asks for.
[[nodiscard]] SimulatedCohort simulate(const Cohort& cohort, const DiskCache& cache, const SimulationWatch& watch = {});

}  // namespace skinfit
