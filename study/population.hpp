#pragma once

#include <string>

#include "core/json.hpp"
#include "fit/configuration.hpp"

namespace skinfit {

/// `configuration` with the quantities that `population` names: a parameter given as a number has that value in every
/// subject; one given as a prior, in the form of `read_priors`, is free and drawn from it, within `lower` and `upper`
/// where the prior has such entries beside its own. A derived quantity may have a prior. Throws InputError for anything
/// else, naming `where`.
[[nodiscard]] Configuration with_population(Configuration configuration, const Json& population,
                                            const std::string& where);

/// The names that `base` and `changes`, both populations, have together, each as `changes` says where that says
/// something.
[[nodiscard]] Json changed_population(Json base, const Json& changes);

}  // namespace skinfit
