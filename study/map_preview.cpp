#include "study/map_preview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "fit/gnuplot.hpp"
#include "model/parameters.hpp"
#include "study/fit_status.hpp"
#include "study/map_reduction.hpp"
#include "study/pixel_fitter.hpp"

namespace skinfit {
namespace {

constexpr std::size_t most_pixels = 600;

// Pixels.
constexpr int left_margin = 60;
constexpr int beside_panel = 260;  // for the colour bar and its labels
constexpr int above_panel = 70;
constexpr int below_panel = 60;
constexpr int least_width = 200;   // of the place of a panel
constexpr int least_height = 200;  // of the colour bar

constexpr std::string_view viridis =
    "set palette maxcolors 0\nset palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', "
    "5 '#28ae80', 6 '#5ec962', 7 '#addc30', 8 '#fde725')\n";

/// Of the statuses, told apart by most who see colours differently too.
constexpr std::array<std::string_view, fit_status_names.size()> status_colours = {"#ffffff", "#0072b2", "#e69f00",
                                                                                  "#cc3311", "#000000", "#d8d8d8"};
/// Of the reasons; those that reject in reds and browns, those that raise doubt in others.
constexpr std::array<std::string_view, pixel_reason_names.size()> reason_colours = {
    "#0072b2", "#fddbc7", "#f4a582", "#d6604d", "#b2182b", "#67001f", "#8c510a", "#bf812d",
    "#dfc27d", "#c51b7d", "#f1b6da", "#000000", "#e69f00", "#f0e442", "#56b4e9", "#009e73"};

/// Where colours begin and end.
struct ColourRange {
    double low;
    double high;
};

ColourRange colour_range(const ReducedPlane& plane) {
    constexpr double left_out = 0.02;
    std::vector<float> values;
    std::ranges::copy_if(plane.value, std::back_inserter(values), [](float value) { return std::isfinite(value); });
    if (values.empty()) return {.low = 0.0, .high = 1.0};
    std::ranges::sort(values);
    const auto last = static_cast<double>(values.size() - 1);
    const double low = values[static_cast<std::size_t>(std::lround(left_out * last))];
    const double high = values[static_cast<std::size_t>(std::lround((1.0 - left_out) * last))];
    // Colours need a range even where all values are the same.
    const double least = std::max(1e-3 * std::abs(low), 1e-9);
    return {.low = low, .high = std::max(high, low + least)};
}

/// The size of the panels and of a picture with two of them.
struct Layout {
    int width;  ///< of a panel
    int height;
    PictureSize picture;
};

Layout layout_of(const ReducedMap& map) {
    const auto enlarged = static_cast<int>(std::max<std::size_t>(1, most_pixels / std::max(map.samples, map.lines)));
    const int width = enlarged * static_cast<int>(map.samples);
    const int height = enlarged * static_cast<int>(map.lines);
    return {.width = width,
            .height = height,
            .picture = {.width = 2 * (left_margin + std::max(width, least_width) + beside_panel),
                        .height = above_panel + std::max(height, least_height) + below_panel}};
}

/// The frame of panel `column`, 0 or 1, its axes, which count the pixels of the map, and the place of its colour bar.
std::string frame_script(const ReducedMap& map, const Layout& layout, int column, std::string_view title) {
    constexpr int gap = 12;
    constexpr int bar_width = 22;
    const double left = left_margin + 0.5 * column * layout.picture.width;
    const double width = layout.picture.width;
    const double height = layout.picture.height;
    const double bar_height = std::max(layout.height, least_height);
    const auto block = static_cast<double>(map.block);
    std::string script = column == 0 ? "" : "unset label\n";  // the note stands once
    script += fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset bmargin at screen {}\n",
        left / width, (left + layout.width) / width, 1.0 - above_panel / height,
        1.0 - (above_panel + layout.height) / height);
    script += fmt::format("set colorbox user origin screen {},screen {} size screen {},screen {}\n",
                          (left + layout.width + gap) / width, 1.0 - (above_panel + bar_height) / height,
                          bar_width / width, bar_height / height);
    return script + fmt::format("set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nset title {}\n",
                                static_cast<double>(map.samples) * block - 0.5,
                                static_cast<double>(map.lines) * block - 0.5, gnuplot_string(title));
}

/// Every number twice in both directions.
std::vector<float> doubled(const std::vector<float>& value, std::size_t samples) {
    std::vector<float> result;
    for (std::size_t i = 0; i < 4 * value.size(); ++i) {
        result.push_back(value[i / (4 * samples) * samples + i % (2 * samples) / 2]);
    }
    return result;
}

/// Draws numbers as gnuplot reads them behind the command.
std::string image_script(const ReducedMap& map, const std::vector<float>& value) {
    // gnuplot draws no picture of a single line or column.
    const bool is_thin = std::min(map.samples, map.lines) == 1;
    const std::vector<float> drawn = is_thin ? doubled(value, map.samples) : value;
    const std::size_t times = is_thin ? 2 : 1;
    const double step = static_cast<double>(map.block) / static_cast<double>(times);
    const double origin = 0.5 * (step - 1.0);  // the middle of the first number, where that of the first pixel is 0
    std::string script =
        fmt::format("plot '-' binary array=({},{}) dx={} dy={} origin=({},{}) format='%float32' endian={} with image\n",
                    times * map.samples, times * map.lines, step, step, origin, origin,
                    std::endian::native == std::endian::little ? "little" : "big");
    script.append(reinterpret_cast<const char*>(drawn.data()), drawn.size() * sizeof(float));
    return script + "\n";
}

std::string_view unit_of(std::string_view plane) {
    constexpr std::string_view sigma = "_sigma";
    if (plane == "rmse") return "fraction";
    if (plane.ends_with(sigma)) plane.remove_suffix(sigma.size());
    const std::optional<Parameter> parameter = find_parameter(plane);
    return parameter ? info(*parameter).unit : "";
}

std::string scaled_panel(const ReducedMap& map, const Layout& layout, int column, const ReducedPlane& plane) {
    const ColourRange range = colour_range(plane);
    return frame_script(map, layout, column, plane.name) + std::string(viridis) +
           fmt::format("set cbtics autofreq format '%g'\nset cblabel {}\nset cbrange [{}:{}]\n",
                       gnuplot_string(unit_of(plane.name)), range.low, range.high) +
           image_script(map, plane.value);
}

/// Throws InputError where a number of `plane` stands for no word.
void check_words(const ReducedPlane& plane, std::size_t words, const std::filesystem::path& path) {
    for (const auto& [number, pixels] : plane.pixels) {
        if (number >= 0.0F && number < static_cast<float>(words) && number == std::floor(number)) continue;
        throw InputError({.where = path.string(),
                          .problem = fmt::format("has the number {} in its band {}", number, plane.name),
                          .why = "no status or reason has this number",
                          .remedy = "give a map that skinfit made"});
    }
}

/// Numbers that stand for words; the colour bar is their legend, with the share of all pixels.
std::string worded_panel(const ReducedMap& map, const Layout& layout, int column, const ReducedPlane& plane,
                         std::span<const std::string_view> words, std::span<const std::string_view> colours) {
    std::string palette;
    std::string legend;
    std::vector<float> place(words.size(), std::numeric_limits<float>::quiet_NaN());
    int count = 0;
    for (const auto& [number, pixels] : plane.pixels) {
        const auto word = static_cast<std::size_t>(number);
        place[word] = static_cast<float>(count);
        const double percent = 100.0 * static_cast<double>(pixels) / static_cast<double>(map.pixels);
        // Labels of tics are formats: of two percent signs one is printed.
        legend += fmt::format("{}'{} {:.3g} %%' {}", count == 0 ? "" : ", ", words[word], percent, count);
        palette += fmt::format("{}{} '{}'", count == 0 ? "" : ", ", count, colours[word]);
        // A palette of a single colour is none.
        if (plane.pixels.size() == 1) palette += fmt::format(", 1 '{}'", colours[word]);
        ++count;
    }
    std::vector<float> value = plane.value;
    for (float& number : value) {
        if (!std::isnan(number)) number = place[static_cast<std::size_t>(number)];
    }
    return frame_script(map, layout, column, plane.name) +
           fmt::format("set palette maxcolors {} defined ({})\nset cbtics ({})\nunset cblabel\nset cbrange [-0.5:{}]\n",
                       std::max(count, 1), count > 0 ? palette : "0 '#b0b0b0', 1 '#b0b0b0'", legend,
                       std::max(count, 1) - 0.5) +
           image_script(map, value);
}

std::string head_script(const ReducedMap& map, const Layout& layout, std::string_view title, bool is_scaled) {
    std::string note = is_scaled ? "colours span the quantiles 0.02 to 0.98; grey: no value" : "grey: no value";
    if (map.block > 1) {
        note +=
            fmt::format("; {} {} x {} pixels", is_scaled ? "means of" : "the most frequent of", map.block, map.block);
    }
    return fmt::format(
        "set encoding utf8\n{}set multiplot title {}\nset label {} at screen 0.01,screen {} left\nunset key\n"
        "set tics out nomirror\nset object rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#b0b0b0' "
        "fillstyle solid noborder\n",
        gnuplot_terminal("map.png", layout.picture), gnuplot_string(title), gnuplot_string(note),
        14.0 / layout.picture.height);
}

const ReducedPlane& plane_called(const ReducedMap& map, const std::string& name, const std::filesystem::path& path) {
    const auto found = std::ranges::find(map.planes, name, &ReducedPlane::name);
    if (found != map.planes.end()) return *found;
    throw InputError({.where = path.string(),
                      .problem = fmt::format("has no band called {}", name),
                      .why = "every map has",
                      .remedy = "give a map that skinfit made"});
}

}  // namespace

std::vector<std::filesystem::path> draw_map(const std::filesystem::path& path, const std::filesystem::path& folder) {
    const ReducedMap map = reduced_map(path, most_pixels);
    const ReducedPlane& status = plane_called(map, "status", path);
    const ReducedPlane& reason = plane_called(map, "reason", path);
    const ReducedPlane& rmse = plane_called(map, "rmse", path);
    const ReducedPlane& chi2 = plane_called(map, "chi2", path);
    check_words(status, fit_status_names.size(), path);
    check_words(reason, pixel_reason_names.size(), path);
    const Layout layout = layout_of(map);
    const std::string stem = path.stem().string();
    std::vector<std::filesystem::path> pictures;
    const auto draw = [&](const std::string& name, bool is_scaled, const std::string& panels) {
        pictures.push_back(folder / fmt::format("{}_{}.png", stem, name));
        write_file_atomically(
            pictures.back(), gnuplot_picture(head_script(map, layout, stem, is_scaled) + panels + "unset multiplot\n"));
    };
    const auto scaled = [&](const ReducedPlane& left, const ReducedPlane& right) {
        return scaled_panel(map, layout, 0, left) + scaled_panel(map, layout, 1, right);
    };
    for (const ReducedPlane& plane : map.planes) {
        const auto sigma = std::ranges::find(map.planes, plane.name + "_sigma", &ReducedPlane::name);
        if (sigma != map.planes.end()) draw(plane.name, true, scaled(plane, *sigma));
    }
    draw("status", false,
         worded_panel(map, layout, 0, status, fit_status_names, status_colours) +
             worded_panel(map, layout, 1, reason, pixel_reason_names, reason_colours));
    draw("misfit", true, scaled(rmse, chi2));
    return pictures;
}

}  // namespace skinfit
