#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cells.hpp"
#include "measurements/jcamp_values.hpp"
#include "measurements/limits.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// A line of a record, without its comment.
struct Line {
    std::size_t number;
    std::string_view text;
};

/// `##LABEL= value`, the value running on to the next label.
struct Record {
    std::vector<Line> lines;  ///< at least one: what stands behind the label
    [[nodiscard]] std::string_view value() const { return lines.front().text; }
    [[nodiscard]] std::size_t line() const { return lines.front().number; }
};

/// What stands between ##TITLE and ##END, without the blocks inside it.
using Block = std::map<std::string, Record, std::less<>>;

[[noreturn]] void refuse(const std::string& source, std::size_t line, const std::string& problem,
                         const std::string& why, const std::string& remedy) {
    throw InputError({.where = fmt::format("{}:{}", source, line), .problem = problem, .why = why, .remedy = remedy});
}

std::string_view without_comment(std::string_view line) {
    return trimmed(line.substr(0, line.find("$$")));
}

/// Labels are alike in upper and lower case and with or without blanks, dashes, slashes and underscores.
std::string normalised(std::string_view label) {
    std::string text;
    for (const char c : label) {
        if (std::string_view(" -/_\t").find(c) != std::string_view::npos) continue;
        text += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
    return text;
}

/// The blocks in the order in which they begin; a LINK block and those inside it are all among them.
std::vector<Block> blocks_in(std::string_view text, const std::string& source) {
    std::vector<Block> blocks;
    std::vector<std::size_t> open;
    Record* last = nullptr;
    std::size_t number = 0;
    LineReader reader(text);
    while (const auto whole = reader.next()) {
        ++number;
        refuse_long_line(*whole, number, source);
        const std::string_view line = without_comment(*whole);
        const std::size_t equals = line.find('=');
        if (!line.starts_with("##") || equals == std::string_view::npos) {
            if (last != nullptr && !line.empty()) last->lines.push_back({.number = number, .text = line});
            continue;
        }
        const std::string label = normalised(line.substr(2, equals - 2));
        if (label == "TITLE") {
            open.push_back(blocks.size());
            blocks.emplace_back();
        }
        if (open.empty())
            refuse(source, number, "stands outside a block",
                   "a block begins with ##TITLE=", "check that the file is complete");
        last = &blocks[open.back()][label];
        last->lines = {{.number = number, .text = trimmed(line.substr(equals + 1))}};
        if (label == "END") open.pop_back();
        if (label == "END") last = nullptr;
    }
    return blocks;
}

class BlockReader {
public:
    BlockReader(const Block& block, const std::string& source) : block_(block), source_(source) {}

    [[nodiscard]] const Record* record(std::string_view label) const {
        const auto found = block_.find(label);
        return found == block_.end() ? nullptr : &found->second;
    }

    [[nodiscard]] std::string text(std::string_view label) const {
        const Record* const found = record(label);
        return found == nullptr ? std::string{} : std::string(found->value());
    }

    [[nodiscard]] double number(std::string_view label, std::optional<double> otherwise = {}) const {
        const Record* const found = record(label);
        if (found == nullptr) {
            if (otherwise) return *otherwise;
            refuse(source_, record("TITLE")->line(), fmt::format("##{}= is missing", label), "the block needs it",
                   "add it, or export the spectrum again");
        }
        const std::optional<double> number = parse_number(found->value());
        if (!number || !std::isfinite(*number)) {
            refuse(source_, found->line(), fmt::format("##{}= is {}", label, in_quotes(found->value())),
                   "a number is needed", "correct it, or export the spectrum again");
        }
        return *number;
    }

    [[nodiscard]] std::string at(const Line& line) const { return fmt::format("{}:{}", source_, line.number); }
    [[nodiscard]] const std::string& source() const { return source_; }

private:
    const Block& block_;
    const std::string& source_;
};

/// Abscissas in the file's unit and ordinates, both scaled.
struct Points {
    std::vector<double> x;
    std::vector<double> y;
};

/// Throws InputError where a line does not go on where the one before it ended: its abscissa is off by more than a step
/// (a line of differences may name the point it repeats) and the rounding of whole numbers.
void check_abscissa(const BlockReader& block, const Line& line, double found, double expected, double step,
                    double factor) {
    if (std::abs(found - expected) <= 1.01 * std::abs(step) + std::abs(factor)) return;
    refuse(block.source(), line.number, fmt::format("starts at {}, not {}", found, expected),
           "the points before it are too few or too many", "check that the file is complete and unchanged");
}

/// `(X++(Y..Y))`: equal steps from FIRSTX to LASTX.
Points equal_steps(const BlockReader& block, const Record& data) {
    const double first = block.number("FIRSTX");
    const double last = block.number("LASTX");
    const double count = block.number("NPOINTS");
    if (!(count >= 1 && count <= static_cast<double>(most_jcamp_points))) {
        refuse(block.source(), block.record("NPOINTS")->line(), fmt::format("##NPOINTS= is {}", count),
               fmt::format("1 to {} are read", most_jcamp_points), "correct it, or split the file");
    }
    const double x_factor = block.number("XFACTOR", 1.0);
    const double y_factor = block.number("YFACTOR", 1.0);
    const double step = count > 1 ? (last - first) / (count - 1) : 0;
    Points points;
    bool repeats_last = false;
    for (const Line& line : std::span(data.lines).subspan(1)) {
        const JcampLine decoded = decode_jcamp_line(line.text, block.at(line));
        std::span<const double> ordinates = decoded.ordinates;
        check_abscissa(block, line, decoded.abscissa * x_factor, first + step * static_cast<double>(points.y.size()),
                       step, x_factor);
        if (repeats_last && !ordinates.empty()) {
            if (ordinates.front() * y_factor != points.y.back()) {
                refuse(block.source(), line.number,
                       fmt::format("its first ordinate is {}, and the line before ended with {}", ordinates.front(),
                                   points.y.back() / y_factor),
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
        refuse(block.source(), data.line(),
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
Points pairs(const BlockReader& block, const Record& data) {
    const double x_factor = block.number("XFACTOR", 1.0);
    const double y_factor = block.number("YFACTOR", 1.0);
    Points points;
    for (const Line& line : std::span(data.lines).subspan(1)) {
        const std::vector<double> numbers = decode_affn(line.text, block.at(line));
        if (numbers.size() % 2 != 0) {
            refuse(block.source(), line.number, fmt::format("has {} numbers", numbers.size()),
                   "points are pairs of an abscissa and an ordinate", "check that the file is complete and unchanged");
        }
        for (std::size_t i = 0; i < numbers.size(); i += 2) {
            points.x.push_back(numbers[i] * x_factor);
            points.y.push_back(numbers[i + 1] * y_factor);
        }
    }
    const double count = block.number("NPOINTS", static_cast<double>(points.x.size()));
    if (count == static_cast<double>(points.x.size())) return points;
    refuse(block.source(), data.line(), fmt::format("holds {} points", points.x.size()),
           fmt::format("##NPOINTS= promises {}", count), "check that the file is complete and unchanged");
}

/// The wavelengths that abscissas in XUNITS stand for.
std::vector<double> wavelengths(const BlockReader& block, std::vector<double> x) {
    const std::string unit = normalised(block.text("XUNITS"));
    if (unit == "NANOMETERS" || unit == "NANOMETRES" || unit == "NM") return x;
    const bool micrometres = unit == "MICROMETERS" || unit == "MICROMETRES" || unit == "UM" || unit == "MICRONS";
    const bool wavenumbers = unit == "1CM" || unit == "CM1" || unit == "CM^1";
    if (!micrometres && !wavenumbers) {
        const Record* const stated = block.record("XUNITS");
        refuse(block.source(), (stated != nullptr ? stated : block.record("TITLE"))->line(),
               fmt::format("##XUNITS= is {}", in_quotes(block.text("XUNITS"))),
               "it must be NANOMETERS, MICROMETERS or 1/CM", "correct it, or export the spectrum again");
    }
    for (double& value : x) value = micrometres ? value * 1000 : 1e7 / value;
    return x;
}

Quantity quantity_of(const BlockReader& block) {
    const std::string unit = lower_case(block.text("YUNITS"));
    if (const auto named = quantity_named(unit)) return *named;
    if (unit == "%r" || unit == "r") return Quantity::reflectance;
    if (unit == "%t" || unit == "t") return Quantity::transmittance;
    const Record* const stated = block.record("YUNITS");
    refuse(block.source(), (stated != nullptr ? stated : block.record("TITLE"))->line(),
           fmt::format("##YUNITS= is {}", in_quotes(block.text("YUNITS"))),
           "only REFLECTANCE and TRANSMITTANCE are spectra that can be used",
           "export the spectrum again as one of these");
}

Spectrum spectrum_of(const BlockReader& block, const Record& data, const ReadOptions& options) {
    const std::string form = normalised(data.value());
    if (form != "(X++(Y..Y))" && form != "(XY..XY)") {
        refuse(block.source(), data.line(), fmt::format("has the form {}", in_quotes(data.value())),
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
    const std::vector<double> wavelength_nm = wavelengths(block, points.x);
    const Grid grid = make_grid(wavelength_nm, [&](std::size_t i) {
        return GridPlace{.where = fmt::format("{}:{}", block.source(), data.line()),
                         .which = fmt::format("point {}", i + 1)};
    });
    const std::string header = block.text("YUNITS");
    take_readings(spectrum, grid, {.value = points.y},
                  {.option = options.unit, .comment = std::nullopt, .header = header});
    return spectrum;
}

}  // namespace

bool holds_jcamp_dx(std::string_view text) {
    LineReader reader(text);
    while (const auto whole = reader.next()) {
        const std::string_view line = without_comment(*whole);
        if (line.empty()) continue;
        return line.starts_with("##") && normalised(line.substr(2, line.find('=') - 2)) == "TITLE";
    }
    return false;
}

std::vector<Spectrum> read_jcamp_dx(std::string_view text, const std::string& source, const ReadOptions& options) {
    refuse_large_text(text, source);
    refuse_binary(text, source);
    std::vector<Spectrum> spectra;
    std::size_t points = 0;
    for (const Block& block : blocks_in(text, source)) {
        const BlockReader reader(block, source);
        for (const std::string_view label : {"XYDATA", "XYPOINTS"}) {
            const Record* const data = reader.record(label);
            if (data == nullptr) continue;
            spectra.push_back(spectrum_of(reader, *data, options));
            points += spectra.back().value.size();
            if (spectra.back().value.empty()) spectra.pop_back();
            if (points <= most_jcamp_points) continue;
            refuse(source, data->line(), "has too many points",
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
