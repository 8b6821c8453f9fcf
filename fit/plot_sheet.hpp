#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skinfit {

/// How the line of a sheet is drawn.
enum class LineStyle {
    model,     ///< solid and coloured
    reference  ///< dashed and black: what the others are compared with
};

/// One curve: points in the order in which they are joined, at least one.
struct SheetLine {
    std::string label;  ///< UTF-8, printed as it is
    std::vector<double> x;
    std::vector<double> y;  ///< as many as `x`
    LineStyle style = LineStyle::model;
};

/// A patch of colour.
struct Swatch {
    std::string colour;  ///< "#rrggbb"
    std::string label;   ///< short, printed on the patch
};

/// One plot of a sheet, with a strip of patches above it where there are any.
struct SheetPanel {
    std::string title;
    std::vector<SheetLine> lines;  ///< at least one
    std::vector<Swatch> swatches;
};

/// Plots side by side with the same axes. Their lines are told apart by their place in `lines`; the legend beside the
/// row is that of the first panel.
struct SheetRow {
    std::string x_label;  ///< with unit
    std::string y_label;  ///< with unit
    double x_low;         ///< where the axis begins
    double x_high;        ///< where the axis ends, above `x_low`
    std::vector<SheetPanel> panels;
};

/// Rows of plots in one picture; all rows have as many panels as the first.
struct PlotSheet {
    std::string title;
    std::vector<SheetRow> rows;
};

/// Draws `sheet` as `draw(Plot, path)` does, with the same errors.
void draw(const PlotSheet& sheet, const std::filesystem::path& path);

}  // namespace skinfit
