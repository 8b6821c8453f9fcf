#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace skinfit {

/// What became of one spectrum of a study, or of one pixel of a map.
enum class FitStatus : std::uint8_t {
    pending,   ///< not yet looked at
    fitted,    ///< with a consistent answer
    suspect,   ///< with an answer and reasons to doubt it
    rejected,  ///< not fitted: a quality finding says that no fit could be trusted
    failed,    ///< without an answer: unreadable, or the fit did not converge
    masked,    ///< not to be fitted: a pixel outside the mask or the rectangle, or masked in the cube itself
};
inline constexpr std::array<std::string_view, 6> fit_status_names = {"pending",  "fitted", "suspect",
                                                                     "rejected", "failed", "masked"};

/// The word for `status` in tables and JSON.
[[nodiscard]] constexpr std::string_view name_of(FitStatus status) {
    return fit_status_names[static_cast<std::size_t>(status)];
}

/// Whether there are estimates to be used: those of a search that did not converge are none.
[[nodiscard]] constexpr bool has_answer(FitStatus status) {
    return status == FitStatus::fitted || status == FitStatus::suspect;
}

}  // namespace skinfit
