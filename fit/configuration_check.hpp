#pragma once

#include <string>

#include "fit/configuration.hpp"

namespace skinfit {

/// Throws InputError, naming `where`, where no parameter of the skin is free: a fit would tell nothing of it.
void check_freedom(const FitSettings& configuration, const std::string& where);

/// Throws InputError, naming `where`, for what every command would refuse that used it: free parameters of which
/// none is of the skin, one that starts outside its bounds, and wavelengths outside the tables.
void check_configuration(const Configuration& configuration, const std::string& where);

}  // namespace skinfit
