#include "report/profile_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fit/gnuplot.hpp"
#include "report/tic_step.hpp"

namespace skinfit {
namespace {

// Pixels.
constexpr int curve_width = 310;
constexpr int curve_height = 220;
constexpr int curve_legend_height = 34;
constexpr int curve_left_margin = 52;
constexpr std::size_t columns = 3;

constexpr double highest_rise = 6.0;  // that is drawn; the threshold is at most 3.84

constexpr const char* curve_look = "linewidth 2 linecolor rgb '#08519c'";
constexpr const char* parabola_look = "linewidth 1.5 dashtype 3 linecolor rgb '#636363'";
constexpr const char* threshold_look = "linewidth 1.5 linecolor rgb '#b2182b'";
constexpr const char* end_look = "dashtype 2 linewidth 1 linecolor rgb '#252525'";
constexpr const char* beyond_look = "fillcolor rgb '#e3e3e3' fillstyle solid noborder";

/// Some lines of a cell.
struct Line {
    std::vector<double> x;
    std::vector<double> y;
};

template <class Function>
Line drawn(const Bounds& from_to, const Function& function) {
    constexpr int steps = 120;
    Line line;
    for (int i = 0; i <= steps; ++i) {
        line.x.push_back(std::lerp(from_to.lower, from_to.upper, static_cast<double>(i) / steps));
        line.y.push_back(function(line.x.back()));
    }
    return line;
}

/// The interval with room about it, so that a bound it ends at is seen.
Bounds range_of(const FittedParameter& fitted) {
    constexpr double room = 0.2;
    const Bounds& interval = fitted.uncertainty.interval_95;
    const double least = 1e-6 * (fitted.bounds.upper - fitted.bounds.lower);
    const double margin = room * std::max(interval.upper - interval.lower, least);
    return {interval.lower - margin, interval.upper + margin};
}

Bounds overlap(const Bounds& a, const Bounds& b) {
    return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

std::string points_of(const std::string& name, const ProfileCurve& curve) {
    Line line;
    for (const ProfilePoint& point : curve) {
        line.x.push_back(point.at);
        line.y.push_back(point.cost_rise);
    }
    return gnuplot_data(name, line.x, line.y);
}

std::string beyond_bounds(const Bounds& range, const Bounds& bounds) {
    std::string script;
    for (const Bounds& part : {Bounds{range.lower, bounds.lower}, Bounds{bounds.upper, range.upper}}) {
        if (!(part.lower < part.upper)) continue;
        script += fmt::format("set object rectangle from first {},graph 0 to first {},graph 1 behind {}\n", part.lower,
                              part.upper, beyond_look);
    }
    return script;
}

/// The lines of one parameter, and what is plotted of them.
std::string lines_script(const FittedParameter& fitted, const ProfileCurve& curve, std::size_t number) {
    const Bounds inside = overlap(range_of(fitted), fitted.bounds);
    const auto data = [number](const char* name, const Line& line) {
        return gnuplot_data(fmt::format("{}{}", name, number), line.x, line.y);
    };
    std::string script =
        data("curve", drawn(overlap({curve.front().at, curve.back().at}, inside),
                            [&](double at) { return cost_rise_at(curve, fitted.prior, at); })) +
        data("threshold", drawn(inside, [&](double at) { return cost_rise_95_at(curve, fitted.prior, at); })) +
        points_of(fmt::format("points{}", number), curve);
    std::string plots = fmt::format("plot $threshold{} with lines {} notitle, ", number, threshold_look);
    if (const std::optional<double>& sigma = fitted.uncertainty.sigma) {
        const auto parabola = [&](double at) { return linear_cost_rise(fitted.prior, fitted.value, *sigma, at); };
        script += data("parabola", drawn(inside, parabola));
        plots += fmt::format("$parabola{} with lines {} notitle, ", number, parabola_look);
    }
    return script + plots +
           fmt::format(
               "$curve{0} with lines {1} notitle, $points{0} with points pointtype 7 pointsize 0.5 {1} notitle\n",
               number, curve_look);
}

/// As wide as the legend, however few cells there are.
PictureSize size_for(std::size_t cells) {
    const auto rows = static_cast<int>((cells + columns - 1) / columns);
    return {.width = static_cast<int>(columns) * curve_width, .height = rows * curve_height + curve_legend_height};
}

std::string cell_script(const FittedParameter& fitted, const ProfileCurve& curve, std::size_t number,
                        const PictureSize& size) {
    const std::size_t column = number % columns;
    const std::size_t row = number / columns;
    const double left = static_cast<double>(column) * curve_width;
    const double top = curve_legend_height + static_cast<double>(row) * curve_height;
    const Bounds range = range_of(fitted);
    std::string script = fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset bmargin at screen {}\n"
        "set title {} offset 0,-0.5\nset xrange [{}:{}]\nset xtics {}\nset ylabel '{}' offset 1.8,0\n",
        (left + curve_left_margin) / size.width, (left + curve_width - 20) / size.width, 1.0 - (top + 30) / size.height,
        1.0 - (top + curve_height - 40) / size.height, gnuplot_string(fitted.name), range.lower, range.upper,
        tic_step(2.0 * (range.upper - range.lower)), number % columns == 0 ? "cost rise" : "");
    for (const double end : {fitted.uncertainty.interval_95.lower, fitted.uncertainty.interval_95.upper}) {
        script += fmt::format("set arrow from first {0},graph 0 to first {0},graph 1 nohead back {1}\n", end, end_look);
    }
    return script + beyond_bounds(range, fitted.bounds) + lines_script(fitted, curve, number) +
           "unset arrow\nunset object\nunset label\n";
}

/// What the lines mean, above the cells; it goes with the first of them.
std::string legend_script(const PictureSize& size) {
    const double y = 1.0 - 0.5 * curve_legend_height / size.height;
    const auto place = [&](double pixels) { return fmt::format("screen {},screen {}", pixels / size.width, y); };
    std::string script;
    double x = curve_left_margin;
    const auto add = [&](const char* look, const char* words, double width) {
        script += fmt::format("set arrow from {} to {} nohead {}\nset label '{}' at {} left\n", place(x),
                              place(x + 26.0), look, words, place(x + 33.0));
        x += width;
    };
    add(curve_look, "profile", 115);
    add(threshold_look, "95 % threshold", 170);
    add(end_look, "95 % interval", 160);
    add(parabola_look, "covariance", 130);
    return script + fmt::format(
                        "set object rectangle from screen {},screen {} to screen {},screen {} {}\nset label 'out of "
                        "bounds' at {} "
                        "left\n",
                        x / size.width, y - 7.0 / size.height, (x + 26.0) / size.width, y + 7.0 / size.height,
                        beyond_look, place(x + 33.0));
}

}  // namespace

std::string profile_picture(const FitResult& result) {
    const PictureSize size = size_for(result.free.size());
    std::string script = "set encoding utf8\n" + gnuplot_terminal("profiles.svg", size) +
                         fmt::format("set border 3 linecolor rgb '#808080'\nset yrange [0:{}]\n", highest_rise) +
                         "set ytics 2 nomirror out font 'sans,11'\n"
                         "set xtics nomirror out scale 0.6 offset 0,0.4 format '%g' font 'sans,11'\n"
                         "set multiplot\n" +
                         legend_script(size);
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        script += cell_script(result.free[i], result.profile->intervals[i].curve, i, size);
    }
    return gnuplot_picture(script + "unset multiplot\n");
}

}  // namespace skinfit
