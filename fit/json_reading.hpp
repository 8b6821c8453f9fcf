#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/json.hpp"

/// What all readers of JSON files written by people have in common, beside `parsed_json`. Every function throws
/// InputError naming `where`.
namespace skinfit {

/// Refuses the name `key` and names the one of `known`, at least one, that was probably meant; where there is none and
/// they are more than a few, `example` says where the names are to be seen.
[[noreturn]] void refuse_unknown(const std::string& where, std::string_view key,
                                 const std::vector<std::string_view>& known,
                                 const std::string& example = "see `skinfit config show` for the names");

/// Refuses all but objects; `example`, a clause, says where one is to be seen.
void require_object(const Json& json, const std::string& where, const std::string& example);

/// What an object must hold, and what to say where it does not.
struct RequiredNames {
    std::vector<std::string_view> names;
    std::string why;      ///< a part is needed
    std::string example;  ///< where to see one
};

/// Refuses all but objects whose names are all `known` and among which none that is required is missing.
void require_names(const Json& json, const std::vector<std::string_view>& known, const RequiredNames& required,
                   const std::string& where);

}  // namespace skinfit
