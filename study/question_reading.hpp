#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"
#include "study/study.hpp"

namespace skinfit {

/// The indicators of a study: a list of
///
///   {"name", "parameter" or "index", "above" or "below": number, "source", "prevalence" with a parameter of the skin}
///   {"name", "parameter" or "index", "above" or "below": {"same": "subject", "where": {"site": "forearm"}}, "source"}
///
/// Throws InputError naming `where` for anything else, for a parameter or index there is none of, a threshold that a
/// parameter cannot have, and a name that is given twice.
[[nodiscard]] std::vector<Indicator> read_indicators(const Json& json, const std::string& where);

/// Throws InputError naming `where` where `quantity` is neither an index nor a parameter or quantity of the tissue
/// that fits with `settings` adjust.
void check_quantity(const std::string& quantity, const FitSettings& settings, const std::string& where);

/// The assessments of a study: a list of
///
///   {"indicator", "label", "positive", "thresholds": [probabilities]}   {"parameter" or "index", "reference"}
///
/// Throws InputError naming `where` for anything else and for an indicator that is none of `indicators`.
[[nodiscard]] std::vector<Assessment> read_assessments(const Json& json, const std::vector<Indicator>& indicators,
                                                       const std::string& where);

}  // namespace skinfit
