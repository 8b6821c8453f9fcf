#pragma once

#include <string>
#include <string_view>

namespace skinfit {

/// What became of a claim.
enum class ClaimVerdict {
    reproduced,
    not_reproduced,
    skipped  ///< what it is compared with is not here
};

/// The verdict on one claim about one set of curves.
struct ClaimFinding {
    ClaimVerdict verdict = ClaimVerdict::skipped;
    double number = 0.0;  ///< that decided; 0 where skipped
    std::string measure;  ///< what the number is, with its unit and the rule it had to meet
    std::string why;      ///< one sentence
};

/// "reproduced", "not reproduced" or "skipped".
[[nodiscard]] std::string_view name_of(ClaimVerdict verdict);

/// The verdict on a claim that was `met` or not.
[[nodiscard]] ClaimVerdict verdict_of(bool met);

}  // namespace skinfit
