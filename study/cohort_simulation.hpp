#pragma once

#include <cstddef>
#include <vector>

#include "model/disk_cache.hpp"
#include "study/cohort.hpp"

namespace skinfit {

/// One subject: what is true of the skin, and what was read of it.
struct SimulatedSubject {
    std::size_t group;                         ///< place among the cohort's groups
    std::uint64_t number;                      ///< within the group, from 1
    ParameterValues values;                    ///< of skin and instrument
    std::vector<double> noise_free;            ///< what the model reads, a fraction per wavelength
    std::vector<std::vector<double>> reading;  ///< one spectrum per repeat
};

/// Every subject of a cohort, group by group.
struct SimulatedCohort {
    std::vector<double> wavelength_nm;
    std::vector<SimulatedSubject> subjects;
};

/// Draws and measures every subject: reading = model + departure + noise. The model's departure from real skin belongs
/// to the skin: it is drawn once for a subject and is in all of the repeats; noise is independent in every value.
///
/// The random numbers of a subject depend on seed, name of the group and number of the subject alone: they stay the
/// same on any number of threads, and when groups, subjects or repeats are added. Progress of what has to be built
/// first goes to `cache`. Throws InputError where the engine cannot compute what the cohort asks for.
[[nodiscard]] SimulatedCohort simulate(const Cohort& cohort, const DiskCache& cache);

}  // namespace skinfit
