#include "measurements/column_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cells.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

std::vector<std::size_t> value_columns(const TablePlan& plan) {
    std::vector<std::size_t> found;
    for (std::size_t c = 0; c < plan.columns.size(); ++c) {
        if (plan.columns[c].role == ColumnRole::value) found.push_back(c);
    }
    return found;
}

/// The columns to choose from, in words: their names, or their numbers where they have none.
std::string list(const TablePlan& plan, const std::vector<std::size_t>& choices) {
    constexpr std::size_t most = 20;
    std::vector<std::string> shown;
    for (const std::size_t column : choices) {
        if (shown.size() == most) break;
        const std::string& name = plan.columns[column].name;
        shown.push_back(name.empty() ? std::to_string(plan.number_of(column)) : name);
    }
    const std::size_t more = choices.size() - shown.size();
    return fmt::format("{}{}", fmt::join(shown, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

std::string header_place(const Columns& columns) {
    return columns.header_line > 0 ? at_line(columns, columns.header_line) : columns.source;
}

/// Whether the first column, whose name is empty, goes over twice the range of the header: then it is the wavelengths.
bool goes_further_down(const Columns& columns, double along) {
    if (!columns.names.front().empty() && !lower_case(columns.names.front()).starts_with("unnamed")) return false;
    CellCutter cutter(columns.separator);
    const std::optional<double> first = parse_number(cutter.cut(columns.rows.front().text).front());
    const std::optional<double> last = parse_number(cutter.cut(columns.rows.back().text).front());
    return first && last && std::abs(*last - *first) >= 2 * along;
}

/// A table with one spectrum per line names its columns by wavelengths, and its first column by none.
void refuse_spectra_in_rows(const Columns& columns) {
    constexpr std::size_t fewest = 3;
    if (columns.width <= fewest || columns.names.empty() || is_abscissa_name(columns.names.front())) return;
    double previous = 0;
    for (std::size_t c = 1; c < columns.width; ++c) {
        const std::optional<double> number = parse_number(columns.names[c]);
        if (!number || !(*number > previous)) return;
        previous = *number;
    }
    if (goes_further_down(columns, previous - parse_number(columns.names[1]).value_or(0))) return;
    throw InputError({.where = header_place(columns),
                      .problem = fmt::format("the header runs from {} to {}", in_quotes(columns.names[1]),
                                             in_quotes(columns.names[columns.width - 1])),
                      .why = "that looks like one spectrum per line, and columns are read here",
                      .remedy = "use --reader rows, or call the first column wavelength_nm if these are names"});
}

/// Throws InputError for a column that is there and holds no spectrum.
[[noreturn]] void refuse_role(const Columns& columns, const TablePlan& plan, std::size_t column,
                              const std::string& wanted, const std::vector<std::size_t>& choices) {
    const PlannedColumn& planned = plan.columns[column];
    std::string problem = fmt::format("column {} cannot be used", in_quotes(wanted));
    std::string why = planned.reason;
    if (planned.role == ColumnRole::sigma) {
        problem = fmt::format("column {} holds uncertainties", in_quotes(wanted));
        why = "its name says so";
    } else if (planned.role == ColumnRole::wavelength) {
        problem = fmt::format("column {} holds wavelengths", in_quotes(wanted));
        why = fmt::format("it is called {}", in_quotes(planned.name));
    }
    throw InputError({.where = header_place(columns),
                      .problem = problem,
                      .why = why,
                      .remedy = planned.is_other_quantity
                                    ? "export the reflectance or transmittance, or rename the column if "
                                      "it is one: R = 10^-A of an absorbance A"
                                    : fmt::format("choose one of the columns {}", list(plan, choices))});
}

std::size_t find_column(const Columns& columns, const TablePlan& plan, const std::vector<std::size_t>& choices,
                        const std::string& wanted) {
    std::vector<std::size_t> called;
    for (std::size_t c = 0; c < plan.columns.size(); ++c) {
        const bool is_other = plan.columns[c].role == ColumnRole::wavelength && choices.size() > 0;
        if (plan.columns[c].name == wanted && !wanted.empty() && !is_other) called.push_back(c);
    }
    if (called.size() > 1) {
        std::vector<std::size_t> numbers;
        for (const std::size_t c : called) numbers.push_back(plan.number_of(c));
        throw InputError({.where = header_place(columns),
                          .problem = fmt::format("{} columns are called {}", called.size(), in_quotes(wanted)),
                          .why = fmt::format("numbers {}", fmt::join(numbers, ", ")),
                          .remedy = "choose one by its number"});
    }
    const std::optional<std::uint64_t> number = parse_count(wanted);
    const bool is_number = number && *number > 0 && *number < plan.columns.size() - plan.first_wavelength;
    if (called.empty() && is_number) called.push_back(static_cast<std::size_t>(*number) + plan.first_wavelength);
    if (!called.empty()) {
        if (plan.columns[called.front()].role == ColumnRole::value) return called.front();
        refuse_role(columns, plan, called.front(), wanted, choices);
    }
    std::vector<std::string_view> names;
    for (const std::size_t choice : choices) {
        if (!number && !plan.columns[choice].name.empty()) names.emplace_back(plan.columns[choice].name);
    }
    const std::string nearest =
        names.empty() ? "" : fmt::format("; the nearest name is {}", in_quotes(nearest_name(wanted, names)));
    throw InputError({.where = header_place(columns),
                      .problem = fmt::format("has no column {}", in_quotes(wanted)),
                      .why = fmt::format("its columns are {}{}", list(plan, choices), nearest),
                      .remedy = "choose one of these by its name or by its number, counted without the wavelengths"});
}

/// Throws InputError where the table has none.
std::vector<std::size_t> checked_value_columns(const Columns& columns, const TablePlan& plan) {
    refuse_spectra_in_rows(columns);
    std::vector<std::size_t> choices = value_columns(plan);
    if (!choices.empty()) return choices;
    const auto other = std::ranges::find_if(plan.columns, &PlannedColumn::is_other_quantity);
    if (other != plan.columns.end()) {
        throw InputError({.where = header_place(columns),
                          .problem = "has no column of reflectance or transmittance",
                          .why = other->reason,
                          .remedy =
                              "export the reflectance or transmittance; of an absorbance A or log(1/R) it is 10^-A. "
                              "If it is one of these, correct the word"});
    }
    throw InputError({.where = header_place(columns),
                      .problem = "has no column of values",
                      .why = "by their names all columns hold wavelengths, uncertainties or numbers of readings",
                      .remedy = "add the values or rename their column"});
}

ColumnChoice choice_of(const TablePlan& plan, std::size_t value) {
    const PlannedColumn& column = plan.columns[value];
    return {.wavelength = column.wavelength, .value = value, .sigma = column.sigma, .sole = plan.values == 1};
}

}  // namespace

std::string TablePlan::label(std::size_t column) const {
    if (!columns[column].name.empty()) return columns[column].name;
    return columns[column].role == ColumnRole::wavelength ? "the wavelength"
                                                          : fmt::format("column {}", number_of(column));
}

ColumnChoice choose_column(const Columns& columns, const TablePlan& plan, const std::optional<std::string>& wanted) {
    const std::vector<std::size_t> choices = checked_value_columns(columns, plan);
    if (!wanted && choices.size() > 1) {
        throw InputError({.where = header_place(columns),
                          .problem = fmt::format("has {} columns of values", choices.size()),
                          .why = list(plan, choices),
                          .remedy = "choose one with --column, by its name or its number"});
    }
    return choice_of(plan, wanted ? find_column(columns, plan, choices, *wanted) : choices.front());
}

std::vector<ColumnChoice> all_columns(const Columns& columns, const TablePlan& plan) {
    std::vector<ColumnChoice> all;
    for (const std::size_t value : checked_value_columns(columns, plan)) all.push_back(choice_of(plan, value));
    return all;
}

}  // namespace skinfit
