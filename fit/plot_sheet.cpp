#include "fit/plot_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>

#include "core/file.hpp"
#include "fit/gnuplot.hpp"
#include "fit/plot_colours.hpp"

namespace skinfit {
namespace {

// Pixels.
constexpr int panel_width = 320;
constexpr int panel_gap = 40;
constexpr int row_height = 330;
constexpr int left_margin = 80;
constexpr int legend_width = 300;
constexpr int title_height = 45;
constexpr int above_panel = 30;
constexpr int swatch_height = 30;
constexpr int below_panel = 58;

/// Smallest and largest of something.
struct Span {
    double low;
    double high;
};

Span values_of(const SheetRow& row) {
    const double first = row.panels.front().lines.front().y.front();
    Span span{.low = first, .high = first};
    for (const SheetPanel& panel : row.panels) {
        for (const SheetLine& line : panel.lines) {
            for (const double y : line.y) span = {.low = std::min(span.low, y), .high = std::max(span.high, y)};
        }
    }
    return span;
}

/// From zero, where the values allow it, to a little above the highest.
Span axis_of(const Span& values) {
    constexpr double headroom = 0.05;
    const double low = std::min(0.0, values.low);
    const double high = values.high > low ? values.high + headroom * (values.high - low) : low + 1.0;
    return {.low = low, .high = high};
}

PictureSize size_of(const PlotSheet& sheet) {
    const auto columns = static_cast<int>(sheet.rows.front().panels.size());
    return {.width = left_margin + columns * (panel_width + panel_gap) + legend_width,
            .height = title_height + static_cast<int>(sheet.rows.size()) * row_height};
}

/// A place in the picture, as gnuplot's screen coordinates.
struct Frame {
    double left;
    double right;
    double bottom;
    double top;
};

Frame frame_of(const PictureSize& size, int row, int column, bool has_swatches) {
    const double left = left_margin + column * (panel_width + panel_gap);
    const double top = title_height + row * row_height + above_panel + (has_swatches ? swatch_height : 0);
    const double bottom = title_height + (row + 1) * row_height - below_panel;
    return {.left = left / size.width,
            .right = (left + panel_width) / size.width,
            .bottom = 1.0 - bottom / size.height,
            .top = 1.0 - top / size.height};
}

/// Whether black is easier to read on `colour` than white, by its green, which carries most of the luminance.
bool is_light(const std::string& colour) {
    assert(colour.size() == 7);
    return std::strtol(colour.substr(3, 2).c_str(), nullptr, 16) > 110;
}

std::string swatch_script(const std::vector<Swatch>& swatches, const Frame& frame, const PictureSize& size) {
    std::string script;
    const double width = (frame.right - frame.left) / static_cast<double>(swatches.size());
    const double bottom = frame.top + 4.0 / size.height;
    const double top = frame.top + (swatch_height - 2.0) / size.height;
    for (std::size_t i = 0; i < swatches.size(); ++i) {
        const double left = frame.left + static_cast<double>(i) * width;
        script += fmt::format(
            "set object rectangle from screen {},screen {} to screen {},screen {} fillcolor rgb '{}' fillstyle solid "
            "noborder\nset label {} at screen {},screen {} center front textcolor rgb '{}'\n",
            left, bottom, left + width, top, swatches[i].colour, gnuplot_string(swatches[i].label), left + 0.5 * width,
            0.5 * (bottom + top), is_light(swatches[i].colour) ? "#000000" : "#ffffff");
    }
    return script;
}

std::string lines_script(const SheetPanel& panel, const std::string& data_name) {
    std::string script = "plot ";
    std::size_t coloured = 0;
    for (std::size_t i = 0; i < panel.lines.size(); ++i) {
        const bool is_reference = panel.lines[i].style == LineStyle::reference;
        const std::string look =
            is_reference ? "linewidth 2 dashtype (8,5) linecolor rgb '#000000'"
                         : fmt::format("linewidth 2 dashtype 1 linecolor rgb '{}'", plot_colours.at(coloured++));
        script += fmt::format("{}${}_{} with lines {} title {}", i == 0 ? "" : ", ", data_name, i, look,
                              gnuplot_string(panel.lines[i].label));
    }
    return script + "\n";
}

std::string data_script(const SheetPanel& panel, const std::string& data_name) {
    std::string script;
    for (std::size_t i = 0; i < panel.lines.size(); ++i) {
        script += gnuplot_data(fmt::format("{}_{}", data_name, i), panel.lines[i].x, panel.lines[i].y);
    }
    return script;
}

std::string panel_script(const PlotSheet& sheet, std::size_t row_number, std::size_t column, const PictureSize& size) {
    const SheetRow& row = sheet.rows[row_number];
    const SheetPanel& panel = row.panels[column];
    const bool has_swatches =
        std::ranges::any_of(row.panels, [](const SheetPanel& each) { return !each.swatches.empty(); });
    const Frame frame = frame_of(size, static_cast<int>(row_number), static_cast<int>(column), has_swatches);
    const double title_height_on_screen = frame.top + ((has_swatches ? swatch_height : 0) + 12.0) / size.height;
    std::string script = "unset object\nunset label\nunset key\n";
    script += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\n", frame.left, frame.right);
    script += fmt::format("set bmargin at screen {}\nset tmargin at screen {}\n", frame.bottom, frame.top);
    script += fmt::format("set label {} at screen {},screen {} center\n", gnuplot_string(panel.title),
                          0.5 * (frame.left + frame.right), title_height_on_screen);
    if (!panel.swatches.empty()) script += swatch_script(panel.swatches, frame, size);
    if (column == 0) {
        script += fmt::format("set ylabel {}\nset format y '%g'\n", gnuplot_string(row.y_label));
        const double legend_left = frame.left + static_cast<double>(row.panels.size()) * (panel_width + panel_gap) /
                                                    static_cast<double>(size.width);
        script += fmt::format("set key at screen {},screen {} left top Left reverse samplen 3 spacing 1.2\n",
                              legend_left, frame.top);
    } else {
        script += "unset ylabel\nset format y ''\n";
    }
    return script + lines_script(panel, fmt::format("panel{}_{}", row_number, column));
}

std::string script_of(const PlotSheet& sheet, const std::filesystem::path& path) {
    assert(!sheet.rows.empty() && !sheet.rows.front().panels.empty());
    const PictureSize size = size_of(sheet);
    std::string script = "set encoding utf8\n" + gnuplot_terminal(path, size);
    for (std::size_t row = 0; row < sheet.rows.size(); ++row) {
        for (std::size_t column = 0; column < sheet.rows[row].panels.size(); ++column) {
            script += data_script(sheet.rows[row].panels[column], fmt::format("panel{}_{}", row, column));
        }
    }
    script += fmt::format("set grid linetype 1 linecolor rgb '#d0d0d0' linewidth 0.5\nset multiplot title {}\n",
                          gnuplot_string(sheet.title));
    for (std::size_t number = 0; number < sheet.rows.size(); ++number) {
        const SheetRow& row = sheet.rows[number];
        assert(row.panels.size() == sheet.rows.front().panels.size());
        const Span y = axis_of(values_of(row));
        script += fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\nset xlabel {}\n", row.x_low, row.x_high, y.low,
                              y.high, gnuplot_string(row.x_label));
        for (std::size_t column = 0; column < row.panels.size(); ++column) {
            script += panel_script(sheet, number, column, size);
        }
    }
    return script + "unset multiplot\n";
}

}  // namespace

void draw(const PlotSheet& sheet, const std::filesystem::path& path) {
    write_file_atomically(path, gnuplot_picture(script_of(sheet, path)));
}

}  // namespace skinfit
