#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit/settings.hpp"

/// What all readers of JSON files written by people have in common. Every function throws InputError naming `where`.
namespace skinfit {

/// The JSON in `text`, comments allowed; `example`, a clause, says where a good one is to be seen.
[[nodiscard]] Json parsed_json(std::string_view text, const std::string& where, const std::string& example);

/// Refuses the name `key` and names the one of `known`, at least one, that was probably meant.
[[noreturn]] void refuse_unknown(const std::string& where, std::string_view key,
                                 const std::vector<std::string_view>& known);

/// Refuses all but objects; `example` as above.
void require_object(const Json& json, const std::string& where, const std::string& example);

}  // namespace skinfit
