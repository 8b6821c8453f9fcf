#include "fit/spectra_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/file.hpp"
#include "fit/gnuplot.hpp"
#include "fit/terminal_plot.hpp"
#include "measurements/interpolation.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

constexpr std::size_t most_lines = 8;  // as many as a legend and an eye tell apart

std::vector<double> wavelengths_of(std::span<const Spectrum> spectra) {
    constexpr std::size_t most = 256;
    std::vector<double> all;
    for (const Spectrum& spectrum : spectra) {
        if (spectrum.wavelength_nm == all) continue;
        std::vector<double> both;
        std::ranges::set_union(all, spectrum.wavelength_nm, std::back_inserter(both));
        all = std::move(both);
    }
    if (all.size() <= most) return all;
    std::vector<double> even;
    for (std::size_t i = 0; i < most; ++i) {
        const double share = static_cast<double>(i) / (most - 1);
        even.push_back(std::min(all.front() + share * (all.back() - all.front()), all.back()));
    }
    return even;
}

/// The value below which `share` of `values` lie; changes their order.
double quantile(std::vector<double>& values, double share) {
    const auto place = static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
    std::ranges::nth_element(values, values.begin() + place);
    return values[static_cast<std::size_t>(place)];
}

std::string many(std::span<const Spectrum> spectra) {
    return fmt::format("{} spectra: median, and the band of 5 to 95 %", spectra.size());
}

/// The name, cut where it is long.
std::string short_name(const Spectrum& spectrum) {
    const std::string quoted = in_quotes(spectrum.name);
    return quoted.substr(1, quoted.size() - 2);
}

std::string axes_script(const std::string& title, const std::filesystem::path& path) {
    return "set encoding utf8\n" + gnuplot_terminal(path, {.width = 1000, .height = 520}) +
           fmt::format("set title {}\nset xlabel 'wavelength, nm'\nset ylabel 'fraction'\n", gnuplot_string(title)) +
           "set grid linetype 1 linecolor rgb '#d0d0d0' linewidth 0.5\nset yrange [0 < *:*]\n"
           "set linetype 5 linecolor rgb '#a65628'\n"  // brown: gnuplot's yellow is faint on white
           "set key left top Left reverse\n";
}

std::string band_script(const QuantileBand& band) {
    // The outline of the band: out along its top, back along its bottom.
    std::vector<double> around_nm = band.wavelength_nm;
    std::vector<double> outline = band.high;
    around_nm.insert(around_nm.end(), band.wavelength_nm.rbegin(), band.wavelength_nm.rend());
    outline.insert(outline.end(), band.low.rbegin(), band.low.rend());
    return gnuplot_data("band", around_nm, outline) + gnuplot_data("median", band.wavelength_nm, band.median) +
           "plot $band with filledcurves closed fillcolor rgb '#9ecae1' fillstyle solid noborder title '5 to 95 %', "
           "$median with lines linewidth 2 linecolor rgb '#08519c' title 'median'\n";
}

std::string lines_script(std::span<const Spectrum> spectra) {
    std::string data;
    std::string plots;
    for (std::size_t i = 0; i < spectra.size(); ++i) {
        data += gnuplot_data(fmt::format("line{}", i), spectra[i].wavelength_nm, spectra[i].value);
        plots += fmt::format("{}$line{} with linespoints linewidth 2 pointtype 7 pointsize 0.4 title {}",
                             i == 0 ? "plot " : ", ", i, gnuplot_string(short_name(spectra[i])));
    }
    return data + plots + "\n";
}

}  // namespace

QuantileBand quantile_band(std::span<const Spectrum> spectra) {
    assert(!spectra.empty());
    QuantileBand band;
    for (const double at_nm : wavelengths_of(spectra)) {
        std::vector<double> values;
        for (const Spectrum& spectrum : spectra) {
            if (at_nm < spectrum.wavelength_nm.front() || at_nm > spectrum.wavelength_nm.back()) continue;
            values.push_back(value_at(spectrum, at_nm));
        }
        if (values.empty()) continue;  // between spectra that do not meet
        band.wavelength_nm.push_back(at_nm);
        band.low.push_back(quantile(values, 0.05));
        band.median.push_back(quantile(values, 0.5));
        band.high.push_back(quantile(values, 0.95));
    }
    return band;
}

std::string terminal_plot_of(std::span<const Spectrum> spectra) {
    std::vector<TerminalCurve> curves;
    if (spectra.size() <= most_lines) {
        for (const Spectrum& spectrum : spectra) curves.push_back({.x = spectrum.wavelength_nm, .y = spectrum.value});
        return terminal_plot(curves, "nm");
    }
    const QuantileBand band = quantile_band(spectra);
    curves.push_back({.x = band.wavelength_nm, .y = band.low, .top = band.high});
    curves.push_back({.x = band.wavelength_nm, .y = band.median});
    return terminal_plot(curves, "nm") + fmt::format("{:>10}{}\n", "", many(spectra));
}

void draw_spectra(std::span<const Spectrum> spectra, const std::string& title, const std::filesystem::path& path) {
    const bool are_many = spectra.size() > most_lines;
    const std::string script = axes_script(are_many ? title + ", " + many(spectra) : title, path) +
                               (are_many ? band_script(quantile_band(spectra)) : lines_script(spectra));
    write_file_atomically(path, gnuplot_picture(script));
}

}  // namespace skinfit
