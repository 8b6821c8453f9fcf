#pragma once

#include <string>
#include <vector>

#include "study/answers.hpp"

namespace skinfit {

/// The results as a table, a line per spectrum: file, number and name; status, verdict and reason; the metadata; value,
/// sigma, both ends of the 95 % interval and status of each parameter; value and both ends of the 95 % interval of each
/// quantity of the tissue; value and sigma of each index; the probability of each indicator; correlations; misfit;
/// hashes; seconds. Metadata with the name of another column get `metadata_` before theirs.
[[nodiscard]] std::string study_csv(const Study& study, const std::vector<AnsweredRow>& rows);

}  // namespace skinfit
