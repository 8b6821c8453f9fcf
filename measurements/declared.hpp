#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// A number that a file states about its table, to be held against it.
struct Declared {
    std::size_t line;     ///< counted from 1
    std::string key;      ///< as written
    std::string meaning;  ///< `count`, `first x`, `last x`, `first y`, `largest y` or `smallest y`
    double number;
    double step;        ///< of its last decimal
    double factor = 1;  ///< by which the file multiplies its values; those declared may be with it or without
};

/// What a file states of the scan it comes from; the table may be a part of it.
struct DeclaredScan {
    std::string key;               ///< as written
    std::vector<double> ends{};    ///< nm; a start, an end or both
    std::optional<double> step{};  ///< nm
};

/// What NPOINTS, FIRSTX, LASTX, FIRSTY, MAXY, MINY and their kin declare; nothing for other keys and words.
[[nodiscard]] std::optional<Declared> declared_by(std::size_t line, std::string_view key, std::string_view value);

/// What `Start wavelength`, `Scan range`, `Data interval` and their kin state; nothing for other keys and words.
[[nodiscard]] std::optional<DeclaredScan> scan_declared_by(std::string_view key, std::string_view value);

/// Throws InputError where the table has not the numbers that its file declares. `x` and `y` are as in the file, in
/// its order; `y` is empty where there are several spectra. A count may be that of `spectra`, too, and of all readings.
void check_declared(const std::string& source, std::span<const Declared> declared, std::span<const double> x,
                    std::span<const double> y, std::size_t spectra = 1);

/// What of them the wavelengths `nm` of the table differ from, in words.
[[nodiscard]] std::vector<std::string> doubts_about_scans(std::span<const DeclaredScan> scans,
                                                          std::span<const double> nm);

/// Letters and digits of a key alone, in lower case: `Y Units`, `y_units` and `YUNITS` are one key.
[[nodiscard]] std::string bare_key(std::string_view key);

}  // namespace skinfit
