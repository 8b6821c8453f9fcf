#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cells.hpp"
#include "measurements/jcamp_blocks.hpp"
#include "measurements/jcamp_values.hpp"
#include "measurements/limits.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// Abscissas in the file's unit and ordinates, both scaled.
struct Points {
    std::vector<double> x;
    std::vector<double> y;
};

/// Throws InputError where a line does not go on where the one before it ended: its abscissa is off by more than a step
/// (a line of differences may name the point it repeats) and the rounding of whole numbers.
void check_abscissa(const JcampBlock& block, const JcampTextLine& line, double found, double expected, double step,
                    double factor) {
    if (std::abs(found - expected) <= 1.01 * std::abs(step) + std::abs(factor)) return;
    refuse_jcamp(block.source(), line.number, fmt::format("starts at {}, not {}", found, expected),
                 "the points before it are too few or too many", "check that the file is complete and unchanged");
}

/// `(X++(Y..Y))`: equal steps from FIRSTX to LASTX.
Points equal_steps(const JcampBlock& block, const JcampRecord& data) {
    const double first = block.number("FIRSTX");
    const double last = block.number("LASTX");
    const double count = block.number("NPOINTS");
    if (!(count >= 1 && count <= static_cast<double>(most_jcamp_points))) {
        refuse_jcamp(block.source(), block.line_of("NPOINTS"), fmt::format("##NPOINTS= is {}", count),
                     fmt::format("1 to {} are read", most_jcamp_points), "correct it, or split the file");
    }
    const double x_factor = block.number("XFACTOR", 1.0);
    const double y_factor = block.number("YFACTOR", 1.0);
    const double step = count > 1 ? (last - first) / (count - 1) : 0;
    Points points;
    bool repeats_last = false;
    for (const JcampTextLine& line : std::span(data.lines).subspan(1)) {
        const JcampLine decoded = decode_jcamp_line(line.text, fmt::format("{}:{}", block.source(), line.number));
        std::span<const double> ordinates = decoded.ordinates;
        check_abscissa(block, line, decoded.abscissa * x_factor, first + step * static_cast<double>(points.y.size()),
                       step, x_factor);
        if (repeats_last && !ordinates.empty()) {
            if (ordinates.front() * y_factor != points.y.back()) {
                refuse_jcamp(block.source(), line.number,
                             fmt::format("its first ordinate is {}, and the line before ended with {}",
                                         ordinates.front(), points.y.back() / y_factor),
                             "after a line of differences it repeats that as a check",
                             "check that the file is complete and unchanged");
            }
            ordinates = ordinates.subspan(1);
        }
        repeats_last = decoded.ends_in_difference;
        for (const double ordinate : ordinates) points.y.push_back(ordinate * y_factor);
        if (static_cast<double>(points.y.size()) > count) break;
    }
    if (static_cast<double>(points.y.size()) != count) {
        refuse_jcamp(block.source(), data.line(),
                     fmt::format("holds {}{} points", points.y.size(),
                                 static_cast<double>(points.y.size()) > count ? " or more" : ""),
                     fmt::format("##NPOINTS= promises {}", count), "check that the file is complete and unchanged");
    }
    for (std::size_t i = 0; i < points.y.size(); ++i) {
        points.x.push_back(count > 1 ? first + (last - first) * static_cast<double>(i) / (count - 1) : first);
    }
    return points;
}

/// `(XY..XY)`: pairs.
Points pairs(const JcampBlock& block, const JcampRecord& data) {
    const double x_factor = block.number("XFACTOR", 1.0);
    const double y_factor = block.number("YFACTOR", 1.0);
    Points points;
    for (const JcampTextLine& line : std::span(data.lines).subspan(1)) {
        const std::vector<double> numbers = decode_affn(line.text, fmt::format("{}:{}", block.source(), line.number));
        if (numbers.size() % 2 != 0) {
            refuse_jcamp(block.source(), line.number, fmt::format("has {} numbers", numbers.size()),
                         "points are pairs of an abscissa and an ordinate",
                         "check that the file is complete and unchanged");
        }
        for (std::size_t i = 0; i < numbers.size(); i += 2) {
            points.x.push_back(numbers[i] * x_factor);
            points.y.push_back(numbers[i + 1] * y_factor);
        }
        if (points.x.size() <= most_jcamp_points) continue;
        refuse_jcamp(block.source(), line.number, "has too many points",
                     fmt::format("at most {} are read from one file", most_jcamp_points), "split the file");
    }
    const double count = block.number("NPOINTS", static_cast<double>(points.x.size()));
    if (count == static_cast<double>(points.x.size())) return points;
    refuse_jcamp(block.source(), data.line(), fmt::format("holds {} points", points.x.size()),
                 fmt::format("##NPOINTS= promises {}", count), "check that the file is complete and unchanged");
}

/// The wavelengths that abscissas in XUNITS stand for.
std::vector<double> wavelengths(const JcampBlock& block, std::vector<double> x) {
    const std::string unit = normalised_label(block.text("XUNITS"));
    if (unit == "NANOMETERS" || unit == "NANOMETRES" || unit == "NM") return x;
    const bool micrometres = unit == "MICROMETERS" || unit == "MICROMETRES" || unit == "UM" || unit == "MICRONS";
    const bool wavenumbers = unit == "1CM" || unit == "CM1" || unit == "CM^1";
    if (!micrometres && !wavenumbers) {
        refuse_jcamp(block.source(), block.line_of("XUNITS"),
                     fmt::format("##XUNITS= is {}", in_quotes(block.text("XUNITS"))),
                     "it must be NANOMETERS, MICROMETERS or 1/CM", "correct it, or export the spectrum again");
    }
    for (double& value : x) value = micrometres ? value * 1000 : 1e7 / value;
    return x;
}

Quantity quantity_of(const JcampBlock& block) {
    const std::string unit = lower_case(block.text("YUNITS"));
    if (const auto named = quantity_named(unit)) return *named;
    if (unit == "%r" || unit == "r") return Quantity::reflectance;
    if (unit == "%t" || unit == "t") return Quantity::transmittance;
    refuse_jcamp(
        block.source(), block.line_of("YUNITS"), fmt::format("##YUNITS= is {}", in_quotes(block.text("YUNITS"))),
        "only REFLECTANCE and TRANSMITTANCE are spectra that can be used", "export the spectrum again as one of these");
}

Spectrum spectrum_of(const JcampBlock& block, const JcampRecord& data, const ReadOptions& options) {
    const std::string form = normalised_label(data.value());
    if (form != "(X++(Y..Y))" && form != "(XY..XY)") {
        refuse_jcamp(block.source(), data.line(), fmt::format("has the form {}", in_quotes(data.value())),
                     "only (X++(Y..Y)) and (XY..XY) are read", "export the spectrum again in one of these");
    }
    Spectrum spectrum;
    spectrum.name = block.text("TITLE");
    if (spectrum.name.empty()) spectrum.name = fmt::format("line {}", data.line());
    spectrum.source = block.source();
    spectrum.line = data.line();
    spectrum.quantity = quantity_of(block);
    spectrum.instrument = block.text("SPECTROMETERDATASYSTEM");
    const Points points = form == "(XY..XY)" ? pairs(block, data) : equal_steps(block, data);
    if (std::ranges::any_of(points.y, [](double y) { return std::isinf(y); })) {
        refuse_jcamp(block.source(), data.line(), "holds a number that is too large", "it exceeds double precision",
                     "correct it or ##YFACTOR=");
    }
    const std::vector<double> wavelength_nm = wavelengths(block, points.x);
    const Grid grid = make_grid(wavelength_nm, [&](std::size_t i) {
        return GridPlace{.where = fmt::format("{}:{}", block.source(), data.line()),
                         .which = fmt::format("point {}", i + 1)};
    });
    const std::string header = block.text("YUNITS");
    take_readings(spectrum, grid, {.value = points.y},
                  {.option = options.unit, .comment = std::nullopt, .header = header, .window = options.window});
    return spectrum;
}

}  // namespace

bool holds_jcamp_dx(std::string_view text) {
    LineReader reader(text);
    while (const auto whole = reader.next()) {
        const std::string_view line = without_jcamp_comment(*whole);
        if (line.empty()) continue;
        return line.starts_with("##") && normalised_label(line.substr(2, line.find('=') - 2)) == "TITLE";
    }
    return false;
}

std::vector<Spectrum> read_jcamp_dx(std::string_view text, const std::string& source, const ReadOptions& options) {
    refuse_large_text(text, source);
    refuse_binary(text, source);
    std::vector<Spectrum> spectra;
    std::size_t points = 0;
    for (const JcampBlock& block : jcamp_blocks(text, source)) {
        for (const std::string_view label : {"XYDATA", "XYPOINTS"}) {
            const JcampRecord* const data = block.record(label);
            if (data == nullptr) continue;
            spectra.push_back(spectrum_of(block, *data, options));
            points += spectra.back().value.size();
            if (spectra.back().value.empty()) spectra.pop_back();
            if (points <= most_jcamp_points) continue;
            refuse_jcamp(source, data->line(), "has too many points",
                         fmt::format("at most {} are read from one file", most_jcamp_points), "split the file");
        }
    }
    if (spectra.empty()) {
        throw InputError({.where = source,
                          .problem = "holds no spectra",
                          .why = "no block of it has ##XYDATA= or ##XYPOINTS= with values",
                          .remedy = "export the spectrum as one of these; peak tables and NTUPLES are not read"});
    }
    return spectra;
}

}  // namespace skinfit
