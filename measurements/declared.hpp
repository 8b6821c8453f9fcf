#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace skinfit {

/// A number that a file states about its table, to be held against it.
struct Declared {
    std::size_t line;     ///< counted from 1
    std::string key;      ///< as written
    std::string meaning;  ///< `count`, `first x`, `last x`, `first y`, `largest y` or `smallest y`
    double number;
    double step;  ///< of its last decimal
};

/// What NPOINTS, FIRSTX, LASTX, FIRSTY, MAXY, MINY and their kin declare; nothing for other keys and words.
[[nodiscard]] std::optional<Declared> declared_by(std::size_t line, std::string_view key, std::string_view value);

/// Throws InputError where the table has not the numbers that its file declares. `x` and `y` are as in the file, in
/// its order; `y` is empty where there are several columns.
void check_declared(const std::string& source, std::span<const Declared> declared, std::span<const double> x,
                    std::span<const double> y);

/// Letters and digits of a key alone, in lower case: `Y Units`, `y_units` and `YUNITS` are one key.
[[nodiscard]] std::string bare_key(std::string_view key);

}  // namespace skinfit
