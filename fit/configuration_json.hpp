#pragma once

#include <string>
#include <string_view>

#include "fit/configuration.hpp"
#include "fit/resolution.hpp"
#include "fit/settings.hpp"

namespace skinfit {

/// Changes `configuration` by what `json` states: settings by their names, `free` and `own` (lists of parameters, see
/// `read_parameters_list`) and `parameters` (each a number, or an object of value, lower, upper). The JSON of a fit is
/// good too: its "configuration" is taken. Throws InputError for anything unknown, naming the closest known key, and
/// for values out of range; `where` names the source in messages.
[[nodiscard]] Configuration configured(Configuration configuration, const Json& json, const std::string& where);

/// The same from text; comments are allowed.
[[nodiscard]] Configuration configured_by_text(const Configuration& configuration, std::string_view text,
                                               const std::string& where);

/// Changes the setting, list or parameter `key` to what `text` says; `where` names the option in messages.
[[nodiscard]] Configuration configured_by_word(Configuration configuration, std::string_view key, std::string_view text,
                                               const std::string& where);

/// Changes one setting or parameter by "key=value", the argument of --set.
[[nodiscard]] Configuration configured_by_assignment(const Configuration& configuration, std::string_view assignment);

/// Changes whether the parameters named in "NAME,NAME" are free; `where` names the option in messages.
[[nodiscard]] Configuration with_freedom(Configuration configuration, std::string_view names, bool free,
                                         const std::string& where);

/// Gives the parameters named in "NAME,NAME" a value of their own in each of several spectra, and frees them.
[[nodiscard]] Configuration with_own(Configuration configuration, std::string_view names, const std::string& where);

/// The whole configuration, such that `configured(default_configuration(), to_json(c), ...)` is c again.
/// Edition and layers that are left open stand as their defaults.
[[nodiscard]] Json to_json(const Configuration& configuration);

/// The same of what is decided.
[[nodiscard]] Json to_json(const ResolvedConfiguration& configuration);

/// The JSON Schema (draft 7) of a configuration.
[[nodiscard]] Json configuration_schema();

}  // namespace skinfit
