#include "measurements/text_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/column_choice.hpp"
#include "measurements/columns.hpp"
#include "measurements/description.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// One line of a spectrum.
struct Point {
    std::size_t line;
    double wavelength_nm;
    double value;
    double sigma;  ///< 0 where the file has none
};

std::vector<Point> read_points(const Columns& columns, const ColumnChoice& choice) {
    std::vector<std::size_t> wanted{0, choice.value};
    if (choice.sigma) wanted.push_back(*choice.sigma);
    const std::vector<std::vector<double>> numbers = read_numbers(columns, wanted);
    std::vector<Point> points;
    for (std::size_t i = 0; i < columns.rows.size(); ++i) {
        points.push_back({.line = columns.rows[i].line,
                          .wavelength_nm = numbers[0][i],
                          .value = numbers[1][i],
                          .sigma = choice.sigma ? numbers[2][i] : 0});
    }
    return points;
}

void sort_by_wavelength(std::vector<Point>& points, const Columns& columns) {
    std::ranges::stable_sort(points, {}, &Point::wavelength_nm);
    const auto first = std::ranges::adjacent_find(points, {}, &Point::wavelength_nm);
    if (first == points.end()) return;
    const auto second = first + 1;
    throw InputError({.where = at_line(columns, second->line),
                      .problem = fmt::format("repeats the wavelength {} nm", second->wavelength_nm),
                      .why = fmt::format("line {} has it already", first->line),
                      .remedy = "keep one of the two lines or average them"});
}

void check_wavelengths(const std::vector<Point>& points, const Columns& columns) {
    constexpr double shortest_nm = 100;
    constexpr double longest_nm = 10000;
    for (const Point& point : points) {
        if (point.wavelength_nm >= shortest_nm && point.wavelength_nm <= longest_nm) continue;
        throw InputError({.where = at_line(columns, point.line),
                          .problem = fmt::format("the wavelength is {} nm", point.wavelength_nm),
                          .why = fmt::format("it must lie between {} and {} nm", shortest_nm, longest_nm),
                          .remedy = "give wavelengths in nanometres, in the first column"});
    }
}

void check_values(const std::vector<Point>& points, const Columns& columns, const ColumnChoice& choice,
                  const UnitFinding& found) {
    for (const Point& point : points) {
        const std::string where = at_line(columns, point.line);
        if (point.value < 0) {
            throw InputError(
                {.where = where,
                 .problem = fmt::format("the value {} at {} nm is negative", point.value, point.wavelength_nm),
                 .why = "no fraction of light is; it may be a dark-current offset",
                 .remedy = "correct the offset or delete the line"});
        }
        if (point.value > largest_fraction) {
            throw InputError(
                {.where = where,
                 .problem = fmt::format("the value {} at {} nm exceeds {}", point.value, point.wavelength_nm,
                                        largest_fraction),
                 .why = fmt::format("as a fraction; the unit was taken as {}", found.rule),
                 .remedy = "correct the value, or state the unit with a line '# unit: percent' or '# unit: fraction'"});
        }
        if (choice.sigma && !(point.sigma > 0)) {
            throw InputError({.where = where,
                              .problem = fmt::format("{} is {} at {} nm", label(columns, *choice.sigma), point.sigma,
                                                     point.wavelength_nm),
                              .why = "a standard uncertainty is above 0",
                              .remedy = "correct it or delete its column"});
        }
    }
}

std::optional<Quantity> quantity_of(std::string_view column_name) {
    const std::string name = lower_case(column_name);
    const bool reflectance = name.find("reflectance") != std::string::npos;
    const bool transmittance = name.find("transmittance") != std::string::npos;
    if (reflectance == transmittance) return std::nullopt;
    return reflectance ? Quantity::reflectance : Quantity::transmittance;
}

std::string name_of(const Columns& columns, const ColumnChoice& choice, const Description& description) {
    if (!description.specimen.empty()) return description.specimen;
    return choice.sole ? std::filesystem::path(columns.source).stem().string() : label(columns, choice.value);
}

}  // namespace

Spectrum parse_spectrum(std::string_view text, const std::string& source, const ReadOptions& options) {
    const Columns columns = split_columns(text, source);
    const Description description = read_description(columns);
    const ColumnChoice choice = choose_column(columns, options.column);

    std::vector<Point> points = read_points(columns, choice);
    check_wavelengths(points, columns);
    sort_by_wavelength(points, columns);

    const std::string value_name = columns.names.empty() ? "" : columns.names[choice.value];
    const std::string header = columns.names.empty() ? "" : columns.names.front() + " " + value_name;
    std::vector<double> raw;
    for (const Point& point : points) raw.push_back(point.value);
    const UnitFinding found = find_unit({.option = options.unit, .comment = description.unit, .header = header}, raw);
    const double scale = found.unit == Unit::percent ? 100 : 1;
    for (Point& point : points) {
        point.value /= scale;
        point.sigma /= scale;
    }
    check_values(points, columns, choice, found);

    Spectrum spectrum;
    spectrum.name = name_of(columns, choice, description);
    spectrum.source = source;
    const std::optional<Quantity> named = quantity_of(value_name);
    spectrum.quantity = named ? named : description.quantity;
    spectrum.geometry = description.geometry;
    spectrum.unit_rule = found.rule;
    spectrum.notes = description.notes;
    for (const Point& point : points) {
        spectrum.wavelength_nm.push_back(point.wavelength_nm);
        spectrum.value.push_back(point.value);
        if (choice.sigma) spectrum.sigma.push_back(point.sigma);
    }
    return spectrum;
}

Spectrum read_spectrum(const std::filesystem::path& path, const ReadOptions& options) {
    return parse_spectrum(read_file(path), path.string(), options);
}

}  // namespace skinfit
