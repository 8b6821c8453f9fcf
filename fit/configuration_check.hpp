#pragma once

#include <string>

#include "fit/configuration.hpp"

namespace skinfit {

/// Throws InputError, naming `where`, for what every command would refuse that used it: a free parameter that starts
/// outside its bounds, and wavelengths outside the tables.
void check_configuration(const Configuration& configuration, const std::string& where);

}  // namespace skinfit
