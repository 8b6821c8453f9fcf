#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/abscissa.hpp"
#include "measurements/columns.hpp"
#include "measurements/declared.hpp"
#include "measurements/value_statement.hpp"

namespace skinfit {

/// What the lines about a table state of it: the preamble, comments, and the log below it.
struct FileStatements {
    ValueStatement values{};             ///< by a key for the ordinate, such as YUNITS, or by a short line of its own
    std::string values_where{};          ///< `file:line` of that
    std::optional<Abscissa> abscissa{};  ///< by a key for the abscissa, such as XUNITS
    std::string abscissa_where{};
    std::optional<Specular> specular{};
    double factor = 1;  ///< by which the file says its values are to be multiplied, above 0
    std::vector<Declared> declared{};
    std::vector<std::string> remarks{};  ///< what was applied, or is in doubt
};

/// A line of the form `key: value`, `key=value`, `key<tab>value` or `key,value`.
struct KeyedLine {
    std::string_view key;
    std::string_view value;
};
[[nodiscard]] std::optional<KeyedLine> keyed_line(std::string_view line);

/// True for keys of the ordinate, as YUNITS, Mode, Measurement type or Quantity.
[[nodiscard]] bool is_ordinate_key(std::string_view key);

/// True for keys that `statements_in` reads: a line that begins with one is no header of a table.
[[nodiscard]] bool is_statement_key(std::string_view key);

/// Reads them. Throws InputError for a scale, gain or offset that is stated and could mean two things.
[[nodiscard]] FileStatements statements_in(const std::string& source, std::span<const Comment> comments,
                                           std::span<const Comment> prose);

}  // namespace skinfit
