#pragma once

#include "fit/configuration.hpp"

namespace skinfit {

/// Throws InputError where `resolved_configuration` looks through a viewing cone with an engine that does not know
/// where light leaves, at the transmitted light, or at the surface reflection.
void check_viewing_cone(const Configuration& resolved_configuration);

}  // namespace skinfit
