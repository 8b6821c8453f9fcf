#include "report/fit_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fit/gnuplot.hpp"
#include "measurements/words.hpp"
#include "report/html.hpp"
#include "report/tic_step.hpp"

namespace skinfit {
namespace {

// Pixels.
constexpr int cell_width = 900;
constexpr int cell_height = 620;
constexpr int left_margin = 95;
constexpr int right_margin = 25;
constexpr int above = 45;
constexpr int between = 26;
constexpr int residual_height = 165;
constexpr int below = 66;

constexpr std::size_t most_columns = 3;
constexpr std::size_t most_error_bars = 80;  // more would hide the points

/// Where in the picture a spectrum stands.
struct Cell {
    int column;
    int row;
};

/// Two curves over the same wavelengths as the outline of the area between them.
std::string area_data(const std::string& name, const std::vector<double>& x, const std::vector<double>& low,
                      const std::vector<double>& high) {
    std::vector<double> around = x;
    std::vector<double> outline = high;
    around.insert(around.end(), x.rbegin(), x.rend());
    outline.insert(outline.end(), low.rbegin(), low.rend());
    return gnuplot_data(name, around, outline);
}

std::vector<double> sum(const std::vector<double>& values, double factor, const std::vector<double>& sigma) {
    std::vector<double> result = values;
    for (std::size_t i = 0; i < values.size(); ++i) result[i] += factor * sigma[i];
    return result;
}

std::string bars_data(const std::string& name, const FittedSpectrum& spectrum) {
    std::string block = fmt::format("${} << END\n", name);
    for (std::size_t i = 0; i < spectrum.measured.size(); ++i) {
        block += fmt::format("{} {} {}\n", spectrum.wavelength_nm[i], spectrum.measured[i], spectrum.sigma[i]);
    }
    return block + "END\n";
}

/// All that is drawn of spectrum `k`.
std::string data_of(const FittedSpectrum& spectrum, std::size_t k) {
    const std::vector<double>& nm = spectrum.wavelength_nm;
    const std::vector<double> zero(nm.size(), 0.0);
    std::vector<double> residual = spectrum.modelled;
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] -= spectrum.measured[i];
    std::vector<double> low;
    std::vector<double> high;
    for (const Bounds& interval : spectrum.modelled_95) {
        low.push_back(interval.lower);
        high.push_back(interval.upper);
    }
    std::string data =
        bars_data(fmt::format("measured{}", k), spectrum) +
        gnuplot_data(fmt::format("modelled{}", k), nm, spectrum.modelled) +
        gnuplot_data(fmt::format("residual{}", k), nm, residual) +
        area_data(fmt::format("noise{}", k), nm, sum(zero, -1.0, spectrum.sigma), sum(zero, 1.0, spectrum.sigma)) +
        area_data(fmt::format("sigma{}", k), nm, sum(spectrum.measured, -1.0, spectrum.sigma),
                  sum(spectrum.measured, 1.0, spectrum.sigma));
    if (!low.empty()) data += area_data(fmt::format("band{}", k), nm, low, high);
    return data;
}

std::string frame(const PictureSize& size, const Cell& cell, int top, int bottom) {
    const double left = cell.column * cell_width + left_margin;
    const double right = (cell.column + 1) * cell_width - right_margin;
    const double first = cell.row * cell_height;
    return fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset bmargin at screen {}\n",
        left / size.width, right / size.width, 1.0 - (first + top) / size.height, 1.0 - (first + bottom) / size.height);
}

/// The name, cut where it is long.
std::string short_name(const FittedSpectrum& spectrum) {
    const std::string quoted = in_quotes(spectrum.name);
    return valid_utf8(quoted.substr(1, quoted.size() - 2));
}

std::string spectrum_panel(const FittedSpectrum& spectrum, std::size_t k) {
    const double largest =
        std::max(*std::ranges::max_element(spectrum.measured), *std::ranges::max_element(spectrum.modelled));
    const auto quantity = static_cast<std::size_t>(spectrum.configuration.quantity);
    constexpr double room_for_legend = 1.25;
    std::string script = fmt::format("set title {}\nset ylabel {}\nset yrange [{}\nset format x ''\nunset xlabel\n",
                                     gnuplot_string(short_name(spectrum)), gnuplot_string(quantity_names.at(quantity)),
                                     largest > 0.0 ? fmt::format("0:{}]", room_for_legend * largest) : "*:*]");
    script += "set key left top Left reverse samplen 2\nset ytics autofreq\nplot ";
    const bool has_bars = spectrum.measured.size() <= most_error_bars;
    if (!has_bars) {
        script += fmt::format(
            "$sigma{} with filledcurves closed fillcolor rgb '#bdbdbd' fillstyle solid noborder "
            "title 'measured, +/- 1 sigma', ",
            k);
    }
    if (!spectrum.modelled_95.empty()) {
        script += fmt::format(
            "$band{} with filledcurves closed fillcolor rgb '#9ecae1' fillstyle solid noborder title 'model, 95 %', ",
            k);
    }
    script += fmt::format("$modelled{} with lines linewidth 2 linecolor rgb '#08519c' title 'modelled', ", k);
    // gnuplot's own error bars erase what lies around their points.
    if (has_bars) {
        script += fmt::format(
            "$measured{} using 1:($2-$3):(0):(2*$3) with vectors nohead linecolor rgb '#252525' notitle, ", k);
    }
    return script +
           fmt::format("$measured{} using 1:2 with points pointtype 7 pointsize {} linecolor rgb '#252525' {}\n", k,
                       has_bars ? 0.4 : 0.25, has_bars ? "title 'measured, +/- 1 sigma'" : "notitle");
}

std::string residual_panel(const FittedSpectrum& spectrum, std::size_t k) {
    double low = 0.0;
    double high = 0.0;
    for (std::size_t i = 0; i < spectrum.measured.size(); ++i) {
        const double residual = spectrum.modelled[i] - spectrum.measured[i];
        low = std::min({low, residual, -spectrum.sigma[i]});
        high = std::max({high, residual, spectrum.sigma[i]});
    }
    const double range = high > low ? high - low : 1.0;
    return fmt::format(
        "unset title\nset ylabel 'modelled - measured'\nset xlabel 'wavelength, nm'\nset format x '%g'\n"
        "set yrange [{1}:{2}]\nset ytics {3}\nset key left top Left reverse samplen 2\n"
        "plot $noise{0} with filledcurves closed fillcolor rgb '#d9d9d9' fillstyle solid noborder title 'noise, +/- 1 "
        "sigma', 0 with lines linecolor rgb '#636363' notitle, $residual{0} with linespoints linewidth 1.5 pointtype 7 "
        "pointsize 0.4 linecolor rgb '#08519c' notitle\n",
        k, low - 0.1 * range, high + 0.3 * range, tic_step(1.4 * range));
}

}  // namespace

std::string fit_picture(std::span<const FittedSpectrum> spectra, const std::filesystem::path& name) {
    const std::size_t columns = std::min(spectra.size(), most_columns);
    const std::size_t rows = (spectra.size() + columns - 1) / columns;
    const PictureSize size{.width = static_cast<int>(columns) * cell_width,
                           .height = static_cast<int>(rows) * cell_height};
    std::string script = "set encoding utf8\n" + gnuplot_terminal(name, size);
    for (std::size_t k = 0; k < spectra.size(); ++k) script += data_of(spectra[k], k);
    script +=
        "set grid linetype 1 linecolor rgb '#d0d0d0' linewidth 0.5\nset "
        "multiplot\n";
    for (std::size_t k = 0; k < spectra.size(); ++k) {
        const Cell cell{.column = static_cast<int>(k % columns), .row = static_cast<int>(k / columns)};
        const std::vector<double>& nm = spectra[k].wavelength_nm;
        const int split = cell_height - below - residual_height;
        script += fmt::format("set xrange [{}:{}]\n", nm.front(), nm.back());
        script += frame(size, cell, above, split - between) + spectrum_panel(spectra[k], k);
        script += frame(size, cell, split, cell_height - below) + residual_panel(spectra[k], k);
    }
    return gnuplot_picture(script + "unset multiplot\n");
}

}  // namespace skinfit
