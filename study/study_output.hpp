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

[[nodiscard]] StudyCounts counts_of(const Ledger& ledger);

/// The configuration of the fits, JSON, as the last run noted it. Throws InputError where none has come so far.
[[nodiscard]] std::string configuration_in(const Ledger& ledger);

/// For people: one line per kind.
[[nodiscard]] std::string status_text(const StudyCounts& counts);

/// For programs.
[[nodiscard]] Json status_json(const StudyCounts& counts);

/// The results as a table, a line per spectrum: file, number and name; status, verdict and reason; the metadata; value,
/// sigma, both ends of the 95 % interval and status of each parameter; value and sigma of each index; the probability
/// of each indicator; correlations; misfit; hashes; seconds. Metadata with the name of another column get `metadata_`
/// before theirs.
[[nodiscard]] std::string study_csv(const Study& study, const std::vector<AnsweredRow>& rows);

/// The same as JSON, with the study's name, the configuration of its fits, the definitions of indicators and indices,
/// repeatability and assessments, and the cubes. Throws InputError as `pairs_of`.
[[nodiscard]] Json results_json(const Study& study, const Ledger& ledger, const std::vector<AnsweredRow>& rows);

/// `text` as one cell of a table: in quotes where it needs them, with blanks for ends of lines.
[[nodiscard]] std::string csv_cell(const std::string& text);

}  // namespace skinfit
