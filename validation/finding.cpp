#include "validation/finding.hpp"

#include <array>

namespace skinfit {

std::string_view name_of(ClaimVerdict verdict) {
    static constexpr std::array<std::string_view, 3> names = {"reproduced", "not reproduced", "skipped"};
    return names.at(static_cast<std::size_t>(verdict));
}

ClaimVerdict verdict_of(bool met) {
    return met ? ClaimVerdict::reproduced : ClaimVerdict::not_reproduced;
}

}  // namespace skinfit
