#include "measurements/jcamp_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/jcamp_values.hpp"
#include "measurements/limits.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// How the numbers of a block are written.
struct Writing {
    bool decimal_comma;
    double x_factor;
    double y_factor;
};

double factor(const JcampBlock& block, std::string_view label) {
    const double number = block.number(label, 1.0);
    if (number != 0) return number;
    refuse_jcamp(block.source(), block.line_of(label), fmt::format("##{}= is 0", label),
                 "it leaves nothing of the data", "correct it, or export the spectrum again");
}

std::string line_with_points(const JcampTextLine& line, const Writing& writing) {
    return writing.decimal_comma ? with_decimal_points(line.text) : std::string(line.text);
}

std::string place_of(const JcampBlock& block, const JcampTextLine& line) {
    return fmt::format("{}:{}", block.source(), line.number);
}

/// Throws InputError where a line does not go on where the one before it ended: its abscissa is off by more than a step
/// (a line of differences may name the point it repeats) and the rounding of whole numbers.
void check_abscissa(const JcampBlock& block, const JcampTextLine& line, double found, double expected, double step,
                    double factor) {
    if (std::abs(found - expected) <= 1.01 * std::abs(step) + std::abs(factor)) return;
    refuse_jcamp(block.source(), line.number, fmt::format("starts at {}, not {}", found, expected),
                 fmt::format("the points before it are too few or too many for ##NPOINTS= {} from ##FIRSTX= {} to "
                             "##LASTX= {}",
                             block.text("NPOINTS"), block.text("FIRSTX"), block.text("LASTX")),
                 "check that the file is complete and unchanged");
}

/// The first line starts at ##FIRSTX=, but for the rounding of an abscissa without decimals.
void check_first_abscissa(JcampPoints& points, const JcampTextLine& line, double written, double first, double step,
                          double x_factor) {
    const double rounding = std::abs(x_factor) * (written == std::floor(written) ? 0.51 : 0.051);
    if (std::abs(written * x_factor - first) <= rounding + 0.01 * std::abs(step)) return;
    points.doubts.push_back({.message = fmt::format("line {} starts at {:g}, and ##FIRSTX= is {:g}", line.number,
                                                    written * x_factor, first),
                             .remedy = "check that the file is complete and unchanged"});
}

/// `(X++(Y..Y))`: equal steps from FIRSTX to LASTX.
JcampPoints equal_steps(const JcampBlock& block, const JcampRecord& data, const Writing& writing) {
    const double first = block.number("FIRSTX");
    const double last = block.number("LASTX");
    const double count = block.number("NPOINTS");
    if (!(count >= 1 && count <= static_cast<double>(most_jcamp_points))) {
        refuse_jcamp(block.source(), block.line_of("NPOINTS"), fmt::format("##NPOINTS= is {}", count),
                     fmt::format("1 to {} are read", most_jcamp_points), "correct it, or split the file");
    }
    const double step = count > 1 ? (last - first) / (count - 1) : 0;
    JcampPoints points;
    bool repeats_last = false;
    for (const JcampTextLine& line : std::span(data.lines).subspan(1)) {
        const JcampLine decoded = decode_jcamp_line(line_with_points(line, writing), place_of(block, line));
        std::span<const double> ordinates = decoded.ordinates;
        check_abscissa(block, line, decoded.abscissa * writing.x_factor,
                       first + step * static_cast<double>(points.y.size()), step, writing.x_factor);
        if (points.y.empty()) check_first_abscissa(points, line, decoded.abscissa, first, step, writing.x_factor);
        if (repeats_last && !ordinates.empty()) {
            if (ordinates.front() * writing.y_factor != points.y.back()) {
                refuse_jcamp(block.source(), line.number,
                             fmt::format("its first ordinate is {}, and the line before ended with {}",
                                         ordinates.front(), points.y.back() / writing.y_factor),
                             "after a line of differences it repeats that as a check",
                             "check that the file is complete and unchanged");
            }
            ordinates = ordinates.subspan(1);
        }
        repeats_last = decoded.ends_in_difference;
        for (const double ordinate : ordinates) points.y.push_back(ordinate * writing.y_factor);
        if (static_cast<double>(points.y.size()) > count) break;
    }
    for (std::size_t i = 0; i < points.y.size(); ++i) {
        points.x.push_back(count > 1 ? first + (last - first) * static_cast<double>(i) / (count - 1) : first);
    }
    return points;
}

/// `(XY..XY)`: pairs.
JcampPoints pairs(const JcampBlock& block, const JcampRecord& data, const Writing& writing) {
    JcampPoints points;
    for (const JcampTextLine& line : std::span(data.lines).subspan(1)) {
        const std::vector<double> numbers = decode_affn(line_with_points(line, writing), place_of(block, line));
        if (numbers.size() % 2 != 0) {
            refuse_jcamp(block.source(), line.number, fmt::format("has {} numbers", numbers.size()),
                         "points are pairs of an abscissa and an ordinate",
                         "check that the file is complete and unchanged");
        }
        for (std::size_t i = 0; i < numbers.size(); i += 2) {
            points.x.push_back(numbers[i] * writing.x_factor);
            points.y.push_back(numbers[i + 1] * writing.y_factor);
        }
        if (points.x.size() <= most_jcamp_points) continue;
        refuse_jcamp(block.source(), line.number, "has too many points",
                     fmt::format("at most {} are read from one file", most_jcamp_points), "split the file");
    }
    return points;
}

/// The points as written, which must be as many as the block promises.
JcampPoints counted_points(const JcampBlock& block, const JcampRecord& data, bool in_pairs, const Writing& writing) {
    JcampPoints points = in_pairs ? pairs(block, data, writing) : equal_steps(block, data, writing);
    const auto found = static_cast<double>(points.y.size());
    const double count = block.number("NPOINTS", found);
    if (found == count) return points;
    refuse_jcamp(block.source(), data.line(),
                 fmt::format("holds {}{} points", points.y.size(), !in_pairs && found > count ? " or more" : ""),
                 fmt::format("##NPOINTS= promises {}", count), "check that the file is complete and unchanged");
}

bool has_commas_in_numbers(const JcampRecord& data) {
    return std::ranges::any_of(std::span(data.lines).subspan(1),
                               [](const JcampTextLine& line) { return with_decimal_points(line.text) != line.text; });
}

/// Makes NaN of what programs write where there is no reading, before multiplication by `factor` or after. Whole
/// numbers such as -999 are readings where the factor makes noise of them.
void take_out_missing(JcampPoints& points, double factor) {
    constexpr double lowest = -0.5;    // chosen: no noise of a fraction, nor of percent that would be one such number
    constexpr double highest = 150.0;  // percent
    for (double& value : points.y) {
        if (!std::isfinite(value)) continue;
        const double written = value / factor;
        const double whole = std::round(written);
        const bool is_whole = std::abs(written - whole) <= 1e-9 * std::abs(whole);
        const bool is_fill = is_fill_number(value) || is_fill_number(is_whole ? whole : written);
        if (!is_fill || (value >= lowest && value <= highest)) continue;
        if (!points.fill) points.fill = is_whole ? whole : written;
        value = std::numeric_limits<double>::quiet_NaN();
    }
}

/// The number of a record that only checks the data: without one it checks nothing.
std::optional<double> stated_number(const JcampRecord* record) {
    if (record == nullptr) return std::nullopt;
    const std::optional<double> number = parse_number(record->value());
    return number ? number : parse_number(with_decimal_points(record->value()));
}

/// What a record states of the points, and what they are.
struct Statement {
    std::string_view label;
    double found;
    double factor;  ///< ordinates may be stated before multiplication by it
};

/// By how much a number may be off for its rounding: half of one in its last digit.
double rounding_of(std::string_view text) {
    const std::size_t exponent = text.find_first_of("eE");
    const std::string_view mantissa = text.substr(0, exponent);
    const std::size_t mark = mantissa.find_first_of(".,");
    const std::size_t decimals = mark == std::string_view::npos ? 0 : mantissa.size() - mark - 1;
    const double power = exponent == std::string_view::npos ? 0 : parse_number(text.substr(exponent + 1)).value_or(0);
    return 0.51 * std::pow(10.0, power - static_cast<double>(decimals));
}

std::optional<FileDoubt> contradiction(const JcampBlock& block, const Statement& statement) {
    const JcampRecord* const record = block.record(statement.label);
    const std::optional<double> stated = stated_number(record);
    if (!stated || !std::isfinite(statement.found) || is_fill_number(*stated)) return std::nullopt;
    constexpr double single_precision = 1e-5;  // chosen: a hundred times its rounding
    const auto agrees = [&](double number, double grain) {
        const double allowed = rounding_of(record->value()) + grain + single_precision * std::abs(number);
        return std::abs(number - *stated) <= allowed;
    };
    const double grain = std::abs(statement.factor);
    if (agrees(statement.found, grain == 1 ? 0 : grain) || agrees(statement.found / statement.factor, 0)) {
        return std::nullopt;
    }
    return FileDoubt{.message = fmt::format("line {}: ##{}= is {}, and the data have {:.6g}", record->line(),
                                            statement.label, in_quotes(record->value()), statement.found),
                     .remedy = "check that the file is complete and unchanged, and its factors right"};
}

/// The least and the largest of those that are numbers.
std::array<double, 2> extremes(const std::vector<double>& numbers) {
    std::array<double, 2> found = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const double number : numbers) {
        if (std::isnan(number)) continue;
        found = {std::min(found[0], number), std::max(found[1], number)};
    }
    return found;
}

void check_statements(const JcampBlock& block, JcampPoints& points, double y_factor) {
    if (points.x.empty()) return;
    const auto [least_x, largest_x] = extremes(points.x);
    const auto [least_y, largest_y] = extremes(points.y);
    for (const Statement& statement : {Statement{"FIRSTX", points.x.front(), 1}, Statement{"LASTX", points.x.back(), 1},
                                       Statement{"MINX", least_x, 1}, Statement{"MAXX", largest_x, 1},
                                       Statement{"FIRSTY", points.y.front(), y_factor},
                                       Statement{"MINY", least_y, y_factor}, Statement{"MAXY", largest_y, y_factor}}) {
        if (const auto doubt = contradiction(block, statement)) points.doubts.push_back(*doubt);
    }
}

/// ##DELTAX=, without regard to its sign, which some programs leave out.
void check_step(const JcampBlock& block, JcampPoints& points) {
    const JcampRecord* const record = block.record("DELTAX");
    const double stated = std::abs(stated_number(record).value_or(0));
    if (stated == 0 || points.x.size() < 2) return;
    const auto steps = static_cast<double>(points.x.size() - 1);
    const double found = std::abs(points.x.back() - points.x.front()) / steps;
    constexpr double share = 0.01;  // chosen: half a step over fifty points
    if (std::abs(stated - found) <= rounding_of(record->value()) + share * found) return;
    points.doubts.push_back({.message = fmt::format("line {}: ##DELTAX= is {}, and from ##FIRSTX= to ##LASTX= the step "
                                                    "is {:.6g}",
                                                    record->line(), in_quotes(record->value()), found),
                             .remedy = "check that the file is complete and unchanged"});
}

}  // namespace

JcampPoints jcamp_points(const JcampBlock& block, const JcampRecord& data, bool in_pairs) {
    const bool stated = block.has_decimal_commas();
    Writing writing{
        .decimal_comma = stated, .x_factor = factor(block, "XFACTOR"), .y_factor = factor(block, "YFACTOR")};
    JcampPoints points;
    try {
        points = counted_points(block, data, in_pairs, writing);
    } catch (const InputError&) {
        // The other meaning of commas counts where it makes the number of points that is promised.
        if (block.record("NPOINTS") == nullptr || !has_commas_in_numbers(data)) throw;
        writing.decimal_comma = !stated;
        try {
            points = counted_points(block, data, in_pairs, writing);
        } catch (const InputError&) {
            points.x.clear();
        }
        if (points.x.empty()) throw;
    }
    take_out_missing(points, writing.y_factor);
    check_statements(block, points, writing.y_factor);
    if (!in_pairs) check_step(block, points);
    return points;
}

}  // namespace skinfit
