#pragma once

#include "model/lab.hpp"

namespace skinfit {

/// The colour difference CIEDE2000 under reference conditions (all three parametric factors 1), 0 or more; about 1 is
/// just seen. Symmetric. As the formula is, it jumps where two hues are opposite. [CIE15], implemented after [SHARMA05]
[[nodiscard]] double ciede2000(const Lab& first, const Lab& second);

}  // namespace skinfit
