#pragma once

#include <string>

#include "study/study_figures.hpp"

/// Parts of the scripts of study figures.
namespace skinfit {

/// Readable in a column of 700 pixels.
inline constexpr PictureSize wide_figure = {.width = 700, .height = 460};

/// For axes of the same scale.
inline constexpr PictureSize square_figure = {.width = 600, .height = 690};

/// What figures are labelled with.
struct FigureLabels {
    std::string title;
    std::string x;  ///< with unit
    std::string y;
};

/// Title, labels, grid and the looks that figures share.
[[nodiscard]] std::string figure_head(const FigureLabels& labels);

/// A legend of `rows` lines of text below the axes of a picture of `size`.
[[nodiscard]] std::string legend_below(int rows, const PictureSize& size);

/// A line of the legend without a mark.
[[nodiscard]] std::string legend_text(const std::string& text);

/// How a line, or points, of number `colour` look: thick and in that colour.
[[nodiscard]] std::string line_look(std::size_t colour);
[[nodiscard]] std::string point_look(std::size_t colour);

/// Dashed and black: what the rest is compared with.
[[nodiscard]] std::string reference_look();

/// "name (unit)", or the name alone.
[[nodiscard]] std::string with_unit(const std::string& name, const std::string& unit);

/// "p = 0.012", to two digits, or "p < 1e-6".
[[nodiscard]] std::string p_value_text(double p_value);

}  // namespace skinfit
