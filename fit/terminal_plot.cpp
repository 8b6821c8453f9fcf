#include "fit/terminal_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace skinfit {
namespace {

constexpr int columns = 68;  // of characters
constexpr int rows = 13;     // odd: one of them is the middle
constexpr int dots_x = 2;    // per character
constexpr int dots_y = 4;

/// Smallest and largest of something.
struct Span {
    double low;
    double high;
};

/// Dots on a grid, four by two to a character.
class Canvas {
public:
    /// `column` and `row` count dots from the lower left; those outside are not drawn.
    void set(int column, int row) {
        if (column < 0 || column >= columns * dots_x || row < 0 || row >= rows * dots_y) return;
        const int from_top = rows * dots_y - 1 - row;
        // Unicode numbers the dots of a cell so; braille had six dots at first, the lowest two came later.
        constexpr std::array<std::array<std::uint8_t, dots_x>, dots_y> bits = {
            {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};
        cells_.at(place(column / dots_x, from_top / dots_y)) |=
            bits.at(static_cast<std::size_t>(from_top % dots_y)).at(static_cast<std::size_t>(column % dots_x));
    }

    /// One row of characters, counted from the top.
    [[nodiscard]] std::string row(int number) const {
        std::string text;
        for (int column = 0; column < columns; ++column) {
            const std::uint8_t cell = cells_.at(place(column, number));
            // U+2800 and the cell's dots, in UTF-8.
            text += {'\xe2', static_cast<char>(0xa0 + (cell >> 6)), static_cast<char>(0x80 + (cell & 0x3f))};
        }
        return text;
    }

private:
    /// Of a cell; `row` is counted from the top.
    static std::size_t place(int column, int row) {
        return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
    }

    std::array<std::uint8_t, static_cast<std::size_t>(columns* rows)> cells_{};
};

Span span_of(const std::vector<TerminalCurve>& curves, std::vector<double> TerminalCurve::*member) {
    Span span{.low = HUGE_VAL, .high = -HUGE_VAL};
    for (const TerminalCurve& curve : curves) {
        for (const double each : curve.*member) {
            span = {.low = std::min(span.low, each), .high = std::max(span.high, each)};
        }
    }
    return span;
}

/// The y axis: from 0 or below, to a round number above the highest.
Span axis_of(const Span& values) {
    const double low = std::min(0.0, values.low);
    const double height = std::max(values.high - low, 1e-9);
    const double power = std::pow(10.0, std::floor(std::log10(height)));
    const double step = height / power > 5 ? power : height / power > 2 ? power / 2 : power / 5;
    return {.low = std::floor(low / step) * step, .high = std::ceil(values.high / step) * step};
}

double y_at(const TerminalCurve& curve, const std::vector<double>& y, double x) {
    const auto above = std::ranges::lower_bound(curve.x, x);
    if (above == curve.x.begin()) return y.front();
    if (above == curve.x.end()) return y.back();
    const auto i = static_cast<std::size_t>(above - curve.x.begin());
    const double share = (x - curve.x[i - 1]) / (curve.x[i] - curve.x[i - 1]);
    return y[i - 1] + share * (y[i] - y[i - 1]);
}

int dot_of(double y, const Span& axis) {
    return static_cast<int>(std::lround((y - axis.low) / (axis.high - axis.low) * (rows * dots_y - 1)));
}

void draw(Canvas& canvas, const TerminalCurve& curve, const Span& x_axis, const Span& y_axis) {
    int previous = -1;
    for (int column = 0; column < columns * dots_x; ++column) {
        const double x = x_axis.low + (x_axis.high - x_axis.low) * column / (columns * dots_x - 1);
        if (x < curve.x.front() || x > curve.x.back()) continue;
        const int low = dot_of(y_at(curve, curve.y, x), y_axis);
        if (!curve.top.empty()) {
            const int high = dot_of(y_at(curve, curve.top, x), y_axis);
            for (int row = low; row <= high; ++row) {
                if (row == low || row == high || (column % 4 == 0 && row % 4 == 0)) canvas.set(column, row);
            }
            continue;
        }
        const int from = previous < 0 ? low : previous;  // steep lines have no gaps
        for (int row = std::min(from, low); row <= std::max(from, low); ++row) canvas.set(column, row);
        previous = low;
    }
}

}  // namespace

std::string terminal_plot(const std::vector<TerminalCurve>& curves, const std::string& x_label) {
    assert(!curves.empty());
    const Span x_axis = span_of(curves, &TerminalCurve::x);
    const Span lines = span_of(curves, &TerminalCurve::y);
    const Span tops = span_of(curves, &TerminalCurve::top);
    const Span y_axis = axis_of({.low = std::min(lines.low, tops.low), .high = std::max(lines.high, tops.high)});
    Canvas canvas;
    for (const TerminalCurve& curve : curves) draw(canvas, curve, x_axis, y_axis);
    std::string text;
    for (int row = 0; row < rows; ++row) {
        const double y = y_axis.low + (y_axis.high - y_axis.low) * (rows - 1 - row) / (rows - 1);
        const bool has_label = row == 0 || row == rows - 1 || row == (rows - 1) / 2;
        text += fmt::format("{:>8} {}{}\n", has_label ? fmt::format("{:.3g}", y) : "", has_label ? "┤" : "│",
                            canvas.row(row));
    }
    const std::string first = fmt::format("{:g}", x_axis.low);
    const std::string last = fmt::format("{:g} {}", x_axis.high, x_label);
    text += fmt::format("{:>10}{:<{}}{}\n", "", first, columns - static_cast<int>(last.size()), last);
    return text;
}

}  // namespace skinfit
