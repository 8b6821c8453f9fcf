#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// One line of JCAMP-DX data: the abscissa it starts with and its ordinates, as integers or decimals of the file.
struct JcampLine {
    double abscissa = 0.0;
    std::vector<double> ordinates;
    bool ends_in_difference = false;  ///< the next line repeats the last ordinate, as a check
};

/// Decodes a line of `(X++(Y..Y))` in any of the ASCII squeezed difference forms, which may be mixed (McDonald and
/// Wilks 1988, Appl. Spectrosc. 42, 151, Sec. 5): AFFN numbers between blanks or commas; PAC, where signs separate;
/// SQZ, where a first digit `@` or A to I is 0 or 1 to 9 and a to i is -1 to -9; DIF, where `%` or J to R is a
/// difference of 0 or 1 to 9 from the ordinate before and j to r is -1 to -9; DUP, where S to Z or s says that the
/// ordinate or difference before stands 1 to 8 or 9 times; ordinary digits may follow each of these. `?` is a missing
/// ordinate: NaN.
///
/// Throws InputError at `where` for what has none of these forms, and for a line that decodes to more than a million
/// ordinates.
[[nodiscard]] JcampLine decode_jcamp_line(std::string_view text, const std::string& where);

/// The numbers of a line in AFFN, separated by blanks, commas or semicolons. Throws InputError for anything else.
[[nodiscard]] std::vector<double> decode_affn(std::string_view line, const std::string& where);

}  // namespace skinfit
