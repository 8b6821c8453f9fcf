#include "report/posterior_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "fit/gnuplot.hpp"

namespace skinfit {
namespace {

// Pixels.
constexpr int panel_width = 310;
constexpr int panel_height = 220;
constexpr std::size_t most_columns = 3;

/// One parameter with its draws.
struct Marginals {
    std::string name;
    double best;
    Bounds interval_95;
    Histogram histogram;
};

std::vector<Marginals> marginals_of(const FitResult& result) {
    constexpr std::size_t bins = 40;
    std::vector<Marginals> all;
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const Eigen::VectorXd row = result.posterior->draws.row(static_cast<Eigen::Index>(i));
        if (row.minCoeff() == row.maxCoeff()) continue;
        all.push_back({.name = result.free[i].name,
                       .best = result.free[i].value,
                       .interval_95 = result.free[i].uncertainty.interval_95,
                       .histogram = histogram({row.begin(), row.end()}, bins)});
    }
    return all;
}

std::string cell_script(const Marginals& each, std::size_t number, std::size_t columns, std::size_t rows) {
    const double width = static_cast<double>(columns) * panel_width;
    const double height = static_cast<double>(rows) * panel_height;
    const std::size_t column = number % columns;
    const std::size_t row = number / columns;
    const double left = static_cast<double>(column) * panel_width;
    const double top = static_cast<double>(row) * panel_height;
    const Histogram& bars = each.histogram;
    const double highest = *std::ranges::max_element(bars.share);
    const auto line = [&](double at, const char* look) {
        return fmt::format("set arrow from first {0},graph 0 to first {0},graph 1 nohead front {1}\n", at, look);
    };
    return gnuplot_data(fmt::format("bars{}", number), bars.centre, bars.share) +
           fmt::format(
               "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset bmargin at screen "
               "{}\nset title {} offset 0,-0.5\nset xrange [{}:{}]\nset yrange [0:{}]\n",
               (left + 15) / width, (left + panel_width - 20) / width, 1.0 - (top + 30) / height,
               1.0 - (top + panel_height - 45) / height, gnuplot_string(each.name),
               bars.centre.front() - 0.5 * bars.bin_width, bars.centre.back() + 0.5 * bars.bin_width, 1.1 * highest) +
           line(each.interval_95.lower, "dashtype 2 linewidth 1.5 linecolor rgb '#252525'") +
           line(each.interval_95.upper, "dashtype 2 linewidth 1.5 linecolor rgb '#252525'") +
           line(each.best, "linewidth 2 linecolor rgb '#b2182b'") +
           fmt::format(
               "plot $bars{} with boxes fillcolor rgb '#9ecae1' fillstyle solid border linecolor rgb '#6baed6' "
               "notitle\n"
               "unset arrow\n",
               number);
}

}  // namespace

Histogram histogram(const std::vector<double>& values, std::size_t bins) {
    const auto [low, high] = std::ranges::minmax(values);
    assert(bins > 0 && high > low);
    Histogram result{
        .centre = {}, .share = std::vector<double>(bins, 0.0), .bin_width = (high - low) / static_cast<double>(bins)};
    for (std::size_t i = 0; i < bins; ++i) {
        result.centre.push_back(low + (static_cast<double>(i) + 0.5) * result.bin_width);
    }
    for (const double value : values) {
        const auto place = static_cast<std::size_t>((value - low) / result.bin_width);
        result.share[std::min(place, bins - 1)] += 1.0 / static_cast<double>(values.size());
    }
    return result;
}

std::string posterior_picture(const FitResult& result) {
    const std::vector<Marginals> all = marginals_of(result);
    if (all.empty()) return {};
    const std::size_t columns = std::min(all.size(), most_columns);
    const std::size_t rows = (all.size() + columns - 1) / columns;
    const PictureSize size{.width = static_cast<int>(columns) * panel_width,
                           .height = static_cast<int>(rows) * panel_height};
    std::string script = "set encoding utf8\n" + gnuplot_terminal("posterior.svg", size) +
                         "unset ytics\nset border 1\nset xtics nomirror out format '%g' font 'sans,11'\n"
                         "set multiplot\n";
    for (std::size_t i = 0; i < all.size(); ++i) script += cell_script(all[i], i, columns, rows);
    return gnuplot_picture(script + "unset multiplot\n");
}

}  // namespace skinfit
