#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/settings.hpp"

namespace skinfit {

/// What can have a prior: the names of all parameters, then of all derived quantities.
[[nodiscard]] std::vector<std::string_view> prior_names();

/// Changes the priors of `configuration` by a word (`uniform`, `physiological`) or by an object that maps names of
/// parameters and derived quantities to one of
///   {"kind": "uniform"}, {"kind": "normal", "mean", "sigma"}, {"kind": "log_normal", "median", "sigma_log"},
///   {"kind": "beta", "a", "b"},
/// on top of the set named by its entry "set", if there is one. Throws InputError for anything else and for numbers out
/// of range, as for a beta that has no maximum inside.
void read_priors(Configuration& configuration, const Json& value, const std::string& where);

/// One prior in the form that such an object holds, and back: nothing for a uniform one. Throws InputError as
/// `read_priors` does.
[[nodiscard]] std::optional<Prior> read_prior(const Json& value, const std::string& where);
[[nodiscard]] Json to_json(const Prior& prior);

/// The priors that are not uniform, in the form `read_priors` takes.
[[nodiscard]] Json write_priors(const Configuration& configuration);

/// The JSON Schema of that form.
[[nodiscard]] Json priors_schema();

/// One prior in words: "log-normal, median 0.0748, sigma_log 1.75".
[[nodiscard]] std::string in_words(const Prior& prior);

}  // namespace skinfit
