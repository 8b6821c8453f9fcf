#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/answers.hpp"
#include "study/cube_ledger.hpp"

namespace skinfit {

/// The counts of a study: spectra and pixels with each status.
struct StudyCounts {
    StatusCounts spectra{};
    StatusCounts pixels{};
    std::size_t cubes = 0;
    std::size_t maps = 0;   ///< cubes whose map is written
    std::size_t tiles = 0;  ///< of all cubes
    std::size_t tiles_done = 0;
    std::vector<std::pair<std::string, std::string>> unread_cubes;  ///< source and reason
};

/// Of the spectra and images of `ledger`.
[[nodiscard]] StudyCounts counts_of(const Ledger& ledger);

/// The configuration of the fits as the last run noted it. Throws InputError where none has come so far and where the
/// note is damaged.
[[nodiscard]] Json configuration_in(const Ledger& ledger);

/// For people: one line per kind.
[[nodiscard]] std::string status_text(const StudyCounts& counts);

/// For programs.
[[nodiscard]] Json status_json(const StudyCounts& counts);

/// The results of `study_csv` as JSON, with the study's name, the configuration of its fits, the definitions of
/// indicators and indices, repeatability and assessments, and the cubes. Throws InputError as `pairs_of`.
[[nodiscard]] Json results_json(const Study& study, const Ledger& ledger, const std::vector<AnsweredRow>& rows);

}  // namespace skinfit
