#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// Parts of gnuplot scripts, and gnuplot itself.
namespace skinfit {

/// Of a picture, in pixels of its .png and .svg.
struct PictureSize {
    int width;
    int height;
};

/// The line that chooses what gnuplot writes by the suffix of `path`, .svg, .png or .pdf. Throws InputError for
/// another.
[[nodiscard]] std::string gnuplot_terminal(const std::filesystem::path& path, const PictureSize& size);

/// `text` as a string of gnuplot's that is printed as it is, but for control characters, which become blanks, and an
/// apostrophe that comes first, which becomes a typographic one.
[[nodiscard]] std::string gnuplot_string(std::string_view text);

/// The lines that define the data block `$name`, one point of `x` and `y` each.
[[nodiscard]] std::string gnuplot_data(std::string_view name, const std::vector<double>& x,
                                       const std::vector<double>& y);

/// The same with as many columns as each of `rows` has, of which there is at least one.
[[nodiscard]] std::string gnuplot_table(std::string_view name, const std::vector<std::vector<double>>& rows);

/// Throws InputError where no gnuplot is found: for a check before long work.
void require_gnuplot();

/// The picture that gnuplot makes of `script`. Throws InputError when gnuplot is missing, fails, or is ended by
/// `kill_children`.
[[nodiscard]] std::string gnuplot_picture(const std::string& script);

}  // namespace skinfit
