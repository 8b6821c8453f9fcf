#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace skinfit {

/// JSON with its keys in the order in which they were written.
using Json = nlohmann::ordered_json;

/// `json` as it stands in messages: on one line, cut where it is long; bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string shown(const Json& json);

/// What `parsed_json` makes of the texts in a file.
enum class Texts {
    printable,    ///< as `printable` shows them, since they end in messages and reports
    as_they_are,  ///< with their line ends: they hold files
};

/// The JSON in `text`, comments allowed; `example`, a clause, says where a good one is to be seen. Throws InputError
/// naming `where` for text that is no JSON, gives a name twice or one with control characters, nests more than 64 deep,
/// or has more than 1000 names in one object.
[[nodiscard]] Json parsed_json(std::string_view text, const std::string& where, const std::string& example,
                               Texts texts = Texts::printable);

}  // namespace skinfit
