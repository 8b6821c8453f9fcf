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
#include "measurements/statement_keys.hpp"
#include "measurements/value_statement.hpp"

namespace skinfit {

/// What the lines about a table state of it: the preamble, comments, and the log below it.
struct FileStatements {
    ValueStatement values{};     ///< by a key for the ordinate, such as YUNITS; else by another key, else by prose
    std::string values_where{};  ///< `file:line` of that
    std::optional<Abscissa> abscissa{};  ///< by a key for the abscissa, such as XUNITS, or prose
    std::string abscissa_where{};
    std::optional<Specular> specular{};
    double factor = 1;  ///< by which the file says its values are to be multiplied, above 0
    std::vector<Declared> declared{};
    std::vector<DeclaredScan> scans{};   ///< of its settings, which the table need not hold all of
    std::vector<double> fill{};          ///< numbers that stand for missing values
    std::vector<std::string> remarks{};  ///< what was applied, or is in doubt
};

/// A line of the form `key: value`, `key=value`, `key<tab>value` or, where both are short, `key,value`.
struct KeyedLine {
    std::string_view key;
    std::string_view value;
};
[[nodiscard]] std::optional<KeyedLine> keyed_line(std::string_view line);

/// True for keys that `statements_in` reads: a line that begins with one is no header of a table.
[[nodiscard]] bool is_statement_key(std::string_view key);

/// Reads them. Throws InputError for a scale, gain or offset that is stated and could mean two things.
[[nodiscard]] FileStatements statements_in(const std::string& source, std::span<const Comment> comments,
                                           std::span<const Comment> prose);

}  // namespace skinfit
