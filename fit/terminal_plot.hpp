#pragma once

#include <string>
#include <vector>

namespace skinfit {

/// Something to draw over an x axis: a line, or all between two lines.
struct TerminalCurve {
    std::vector<double> x;      ///< ascends, at least one
    std::vector<double> y;      ///< one per `x`
    std::vector<double> top{};  ///< of a shaded band, one per `x`; none: a line
};

/// The curves as lines of UTF-8 text, in dots of braille characters, at most 80 columns wide, with axes; y begins at 0
/// where no value is negative.
[[nodiscard]] std::string terminal_plot(const std::vector<TerminalCurve>& curves, const std::string& x_label);

}  // namespace skinfit
