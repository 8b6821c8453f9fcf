#include "fit/plot.hpp"

#include <fmt/format.h>

#include <cassert>

#include "core/file.hpp"
#include "fit/gnuplot.hpp"

namespace skinfit {
namespace {

std::string script_of(const Plot& plot, const std::filesystem::path& path) {
    assert(!plot.lines.empty());
    std::string script = "set encoding utf8\n" + gnuplot_terminal(path, {.width = 1000, .height = 520});
    for (std::size_t i = 0; i < plot.lines.size(); ++i) {
        script += gnuplot_data(fmt::format("line{}", i), plot.lines[i].x, plot.lines[i].y);
    }
    // The title is centred on the picture: centred on the axes, a long one beside a wide legend would be cut off.
    script += fmt::format("set label {} at screen 0.5,0.955 center\nset tmargin 3\nset xlabel {}\nset ylabel {}\n",
                          gnuplot_string(plot.title), gnuplot_string(plot.x_label), gnuplot_string(plot.y_label));
    script +=
        "set linetype 5 linecolor rgb '#a65628'\n"  // brown: gnuplot's yellow is faint on white
        "set grid linetype 1 linecolor rgb '#d0d0d0' linewidth 0.5\n"
        "set xzeroaxis linetype 1 linecolor rgb '#606060'\n"
        "set key outside right top Left reverse\nplot ";
    constexpr std::size_t colours = 8;  // of gnuplot; then another dash tells lines apart
    for (std::size_t i = 0; i < plot.lines.size(); ++i) {
        script += fmt::format("{}$line{} with linespoints linewidth 2 pointtype 7 pointsize 0.4 dashtype {} title {}",
                              i == 0 ? "" : ", ", i, i / colours + 1, gnuplot_string(plot.lines[i].label));
    }
    return script + "\n";
}

}  // namespace

void draw(const Plot& plot, const std::filesystem::path& path) {
    write_file_atomically(path, gnuplot_picture(script_of(plot, path)));
}

}  // namespace skinfit
