#include "study/figure_script.hpp"

#include <fmt/format.h>

#include "core/file.hpp"
#include "fit/plot_colours.hpp"

namespace skinfit {

std::string svg_of(const StudyFigure& figure) {
    return gnuplot_picture(gnuplot_terminal("figure.svg", figure.size) + figure.script);
}

void draw(const StudyFigure& figure, const std::filesystem::path& path) {
    write_file_atomically(path, gnuplot_picture(gnuplot_terminal(path, figure.size) + figure.script));
}

std::string figure_head(const FigureLabels& labels) {
    return fmt::format(
        "set encoding utf8\nset title {}\nset xlabel {}\nset ylabel {}\n"
        "set grid linetype 1 linecolor rgb '#d0d0d0' linewidth 0.5\nset key Left reverse samplen 2 spacing 1.2\n",
        gnuplot_string(labels.title), gnuplot_string(labels.x), gnuplot_string(labels.y));
}

std::string legend_below(int rows, const PictureSize& size) {
    constexpr double row_height = 21.0;  // pixels, as the next two
    constexpr double tics_and_label = 58.0;
    constexpr double left = 60.0;
    const double top = row_height * rows + 6.0;
    return fmt::format("set bmargin at screen {}\nset key at screen {},screen {} left top vertical maxrows {}\n",
                       (top + tics_and_label) / size.height, left / size.width, top / size.height, rows);
}

std::string legend_text(const std::string& text) {
    return "1/0 with points pointtype 0 linecolor rgb '#ffffff' title " + gnuplot_string(text);
}

std::string line_look(std::size_t colour) {
    return fmt::format("linewidth 2 dashtype 1 linecolor rgb '{}'", plot_colours.at(colour));
}

std::string point_look(std::size_t colour) {
    return fmt::format("linewidth 1.2 dashtype 1 pointtype 7 pointsize 0.8 linecolor rgb '{}'",
                       plot_colours.at(colour));
}

std::string reference_look() {
    return "linewidth 1.5 dashtype (8,5) linecolor rgb '#000000'";
}

std::string with_unit(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

std::string p_value_text(double p_value) {
    return p_value < 1e-6 ? "p < 1e-6" : fmt::format("p = {:.2g}", p_value);
}

}  // namespace skinfit
