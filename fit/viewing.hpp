#pragma once

#include "fit/resolution.hpp"

namespace skinfit {

/// Throws InputError where `configuration` looks through a viewing cone with an engine that does not know
/// where light leaves, at the transmitted light, or at the surface reflection.
void check_viewing_cone(const ResolvedConfiguration& configuration);

}  // namespace skinfit
