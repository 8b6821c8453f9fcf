#include "report/interval_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/gnuplot.hpp"

namespace skinfit {
namespace {

// Pixels.
constexpr int picture_width = 900;
constexpr int row_height = 62;
constexpr int range_legend_height = 34;
constexpr int name_margin = 330;
constexpr int right_margin = 30;
constexpr int bar_height = 22;
constexpr int below = 12;

/// From where to where a parameter is drawn.
struct Axis {
    Bounds range;
    bool is_logarithmic;
};

/// Holds the interval and the healthy range, where there is one, else the bounds of the fit. Logarithmic where decades
/// matter.
Axis axis_of(const FittedParameter& fitted, const std::optional<Bounds>& healthy) {
    constexpr double decades_matter = 8.0;
    constexpr double room = 0.08;
    const Bounds& interval = fitted.uncertainty.interval_95;
    if (!healthy) return {.range = fitted.bounds, .is_logarithmic = false};
    const double low = std::min({interval.lower, healthy->lower, fitted.value});
    const double high = std::max({interval.upper, healthy->upper, fitted.value});
    if (low > 0.0 && high > decades_matter * low) {
        const double factor = std::pow(high / low, room);
        return {.range = {low / factor, high * factor}, .is_logarithmic = true};
    }
    const double margin = room * (high - low);
    return {.range = {low > 0.0 ? std::max(0.0, low - margin) : low, high + margin}, .is_logarithmic = false};
}

/// Where a logarithmic axis is labelled: at 1, 2 and 5 times the powers of ten that it holds.
std::string logarithmic_tics(const Bounds& range) {
    std::string tics;
    const auto first = static_cast<int>(std::floor(std::log10(range.lower)));
    const auto last = static_cast<int>(std::floor(std::log10(range.upper)));
    for (int power = first; power <= last; ++power) {
        const double decade = std::pow(10.0, power);
        for (const double at : {decade, 2.0 * decade, 5.0 * decade}) {
            if (at >= range.lower && at <= range.upper) tics += fmt::format("{}{:.6g}", tics.empty() ? "" : ", ", at);
        }
    }
    return fmt::format("set xtics ({})\n", tics);
}

std::string row_script(const FittedParameter& fitted, std::size_t number, int height) {
    const std::optional<PhysiologicalPrior> known = known_of(fitted.parameter);
    const std::optional<Bounds> healthy = known ? known->healthy : std::nullopt;
    const Axis axis = axis_of(fitted, healthy);
    const Bounds& interval = fitted.uncertainty.interval_95;
    const int top = range_legend_height + static_cast<int>(number) * row_height + 6;
    const double top_share = 1.0 - static_cast<double>(top) / height;
    const double bottom_share = 1.0 - static_cast<double>(top + bar_height) / height;
    std::string script = fmt::format(
        "unset logscale\n{}set xrange [{}:{}]\nset tmargin at screen {}\n"
        "set bmargin at screen {}\nset label {} at screen {},screen {} right\n",
        axis.is_logarithmic ? "set logscale x\n" + logarithmic_tics(axis.range) : "set xtics autofreq\n",
        axis.range.lower, axis.range.upper, top_share, bottom_share, gnuplot_string(fitted.name),
        (name_margin - 14.0) / picture_width, 0.5 * (top_share + bottom_share));
    if (healthy) {
        script += fmt::format(
            "set object rectangle from first {},graph 0 to first {},graph 1 behind fillcolor rgb '#c7e3cf' fillstyle "
            "solid noborder\n",
            healthy->lower, healthy->upper);
    }
    script += gnuplot_data(fmt::format("interval{}", number), {interval.lower, interval.upper}, {0.5, 0.5});
    script += gnuplot_data(fmt::format("value{}", number), {fitted.value}, {0.5});
    script += fmt::format("plot $interval{} with lines linewidth 5 linecolor rgb '#6baed6' notitle", number);
    if (fitted.uncertainty.status != Status::not_identifiable) {
        script +=
            fmt::format(", $value{} with points pointtype 7 pointsize 0.9 linecolor rgb '#08306b' notitle", number);
    }
    return script + "\n";
}

/// What the colours mean, above the rows.
std::string legend_script(int height) {
    const double y = 1.0 - 0.5 * range_legend_height / height;
    const auto x = [](double pixels) { return (name_margin + pixels) / picture_width; };
    return fmt::format(
        "set label 1 '' at screen {0},screen {3} point pointtype 7 pointsize 0.9 linecolor rgb '#08306b'\n"
        "set label 4 'value' at screen {10},screen {3} left\n"
        "set arrow 1 from screen {1},screen {3} to screen {4},screen {3} nohead linewidth 5 linecolor rgb '#6baed6'\n"
        "set label 2 '95 % interval' at screen {5},screen {3} left\n"
        "set object 1 rectangle from screen {2},screen {6} to screen {7},screen {8} fillcolor rgb '#c7e3cf' fillstyle "
        "solid noborder\nset label 3 'published for healthy skin' at screen {9},screen {3} left\n",
        x(0), x(80), x(230), y, x(110), x(120), y - 8.0 / height, x(260), y + 8.0 / height, x(270), x(12));
}

}  // namespace

std::string interval_picture(const std::vector<FittedParameter>& free) {
    const int height = range_legend_height + static_cast<int>(free.size()) * row_height + below;
    std::string script =
        "set encoding utf8\n" + gnuplot_terminal("intervals.svg", {.width = picture_width, .height = height}) +
        fmt::format("set lmargin at screen {}\nset rmargin at screen {}\n",
                    static_cast<double>(name_margin) / picture_width,
                    1.0 - static_cast<double>(right_margin) / picture_width) +
        "set yrange [0:1]\nunset ytics\nset border 1 linecolor rgb '#808080'\n"
        "set xtics nomirror out scale 0.6 offset 0,0.4 format '%g' font 'sans,12' textcolor rgb '#404040'\nset "
        "multiplot\n" +
        legend_script(height);
    for (std::size_t i = 0; i < free.size(); ++i) {
        script += row_script(free[i], i, height) + "unset object\nunset label\nunset arrow\n";
    }
    return gnuplot_picture(script + "unset multiplot\n");
}

}  // namespace skinfit
