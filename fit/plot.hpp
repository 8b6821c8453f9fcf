#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skinfit {

/// One curve of a plot: points in the order in which they are joined, at least one.
struct PlotLine {
    std::string label;  ///< UTF-8, printed as it is
    std::vector<double> x;
    std::vector<double> y;  ///< as many as `x`
};

/// A plot of lines over one pair of axes, with the legend beside it.
struct Plot {
    std::string title;
    std::string x_label;  ///< with unit
    std::string y_label;  ///< with unit
    std::vector<PlotLine> lines;
};

/// Draws `plot` with gnuplot into the file `path`, an .svg, .png or .pdf by its suffix; the file holds all of the old
/// or all of the new. Throws InputError when the suffix is another, gnuplot is missing or fails, or the file cannot be
/// written; then nothing has changed.
void draw(const Plot& plot, const std::filesystem::path& path);

}  // namespace skinfit
