#include "study/study_processes.hpp"

#include <cstdlib>

#include "core/text.hpp"

namespace skinfit {

int launched_processes() {
    // OpenMPI; MPICH and Slurm's PMI.
    for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
        const char* const text = std::getenv(name);
        const std::optional<std::uint64_t> count = text == nullptr ? std::nullopt : parse_count(text);
        if (count) return static_cast<int>(*count);
    }
    return 1;
}

}  // namespace skinfit
