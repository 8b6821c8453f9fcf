#include "measurements/column_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

std::string_view name_of(const Columns& columns, std::size_t column) {
    return columns.names.empty() ? std::string_view{} : std::string_view(columns.names[column]);
}

std::vector<std::size_t> columns_called(const Columns& columns, std::string_view name) {
    std::vector<std::size_t> found;
    for (std::size_t c = 1; c < columns.width && !name.empty(); ++c) {
        if (name_of(columns, c) == name) found.push_back(c);
    }
    return found;
}

bool is_uncertainty(const Columns& columns, std::size_t column) {
    constexpr std::string_view suffix = "_sigma";
    std::string_view name = name_of(columns, column);
    if (name == suffix.substr(1)) return true;
    if (!name.ends_with(suffix)) return false;
    name.remove_suffix(suffix.size());
    return !columns_called(columns, name).empty();
}

std::vector<std::size_t> value_columns(const Columns& columns) {
    std::vector<std::size_t> found;
    for (std::size_t c = 1; c < columns.width; ++c) {
        if (!is_uncertainty(columns, c)) found.push_back(c);
    }
    return found;
}

/// The columns to choose from, in words: their names, or their numbers where they have none.
std::string list(const Columns& columns, const std::vector<std::size_t>& choices) {
    constexpr std::size_t most = 20;
    std::vector<std::string> shown;
    for (const std::size_t column : choices) {
        if (shown.size() == most) break;
        const std::string_view name = name_of(columns, column);
        shown.push_back(name.empty() ? std::to_string(column) : std::string(name));
    }
    const std::size_t more = choices.size() - shown.size();
    return fmt::format("{}{}", fmt::join(shown, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

std::string header_place(const Columns& columns) {
    return columns.header_line > 0 ? at_line(columns, columns.header_line) : columns.source;
}

/// A table with one spectrum per line names its columns by wavelengths, and its first column by neither of these words.
void refuse_spectra_in_rows(const Columns& columns) {
    constexpr std::size_t fewest = 3;
    const std::string first = lower_case(name_of(columns, 0));
    if (columns.width <= fewest || columns.names.empty() || first.find("wave") != std::string::npos ||
        first.find("nm") != std::string::npos) {
        return;
    }
    double previous = 0;
    for (std::size_t c = 1; c < columns.width; ++c) {
        const std::optional<double> number = parse_number(columns.names[c]);
        if (!number || !(*number > previous)) return;
        previous = *number;
    }
    throw InputError({.where = header_place(columns),
                      .problem = fmt::format("the header runs from {} to {}", in_quotes(columns.names[1]),
                                             in_quotes(columns.names[columns.width - 1])),
                      .why = "that is one spectrum per line, and one spectrum per column is needed",
                      .remedy = "transpose the table, or call the first column wavelength_nm if these are names"});
}

std::size_t find_column(const Columns& columns, const std::vector<std::size_t>& choices, const std::string& wanted) {
    const std::vector<std::size_t> called = columns_called(columns, wanted);
    if (called.size() > 1) {
        throw InputError({.where = header_place(columns),
                          .problem = fmt::format("{} columns are called {}", called.size(), in_quotes(wanted)),
                          .why = fmt::format("numbers {}", fmt::join(called, ", ")),
                          .remedy = "choose one by its number"});
    }
    const std::optional<std::uint64_t> number = parse_count(wanted);
    const std::size_t column = called.empty() ? static_cast<std::size_t>(number.value_or(0)) : called.front();
    if (std::ranges::find(choices, column) != choices.end()) return column;
    if (column > 0 && column < columns.width) {
        throw InputError({.where = header_place(columns),
                          .problem = fmt::format("column {} holds uncertainties", in_quotes(wanted)),
                          .why = "its name ends in sigma",
                          .remedy = fmt::format("choose one of the columns {}", list(columns, choices))});
    }
    std::vector<std::string_view> names;
    for (const std::size_t choice : choices) {
        if (!number && !name_of(columns, choice).empty()) names.push_back(name_of(columns, choice));
    }
    const std::string nearest =
        names.empty() ? "" : fmt::format("; the nearest name is {}", in_quotes(nearest_name(wanted, names)));
    throw InputError({.where = header_place(columns),
                      .problem = fmt::format("has no column {}", in_quotes(wanted)),
                      .why = fmt::format("its columns are {}{}", list(columns, choices), nearest),
                      .remedy = "choose one of these by its name or by its number, counted without the wavelengths"});
}

std::vector<std::size_t> checked_value_columns(const Columns& columns) {
    refuse_spectra_in_rows(columns);
    std::vector<std::size_t> choices = value_columns(columns);
    if (!choices.empty()) return choices;
    throw InputError({.where = header_place(columns),
                      .problem = "has no column of values",
                      .why = "all columns but the wavelengths are called sigma",
                      .remedy = "add the values or rename their column"});
}

ColumnChoice with_sigma(const Columns& columns, std::size_t value, bool sole) {
    std::vector<std::size_t> sigma = columns_called(columns, fmt::format("{}_sigma", name_of(columns, value)));
    if (sigma.empty()) sigma = columns_called(columns, "sigma");
    if (sigma.size() > 1) {
        throw InputError({.where = header_place(columns),
                          .problem = fmt::format("{} columns are called {}", sigma.size(),
                                                 in_quotes(name_of(columns, sigma.front()))),
                          .why = "the uncertainty of the values must be one of them",
                          .remedy = "give every column a name of its own"});
    }
    return {.value = value, .sigma = sigma.empty() ? std::nullopt : std::optional(sigma.front()), .sole = sole};
}

}  // namespace

ColumnChoice choose_column(const Columns& columns, const std::optional<std::string>& wanted) {
    const std::vector<std::size_t> choices = checked_value_columns(columns);
    if (!wanted && choices.size() > 1) {
        throw InputError({.where = header_place(columns),
                          .problem = fmt::format("has {} columns of values", choices.size()),
                          .why = list(columns, choices),
                          .remedy = "choose one with --column, by its name or its number"});
    }
    const std::size_t value = wanted ? find_column(columns, choices, *wanted) : choices.front();
    return with_sigma(columns, value, choices.size() == 1);
}

std::vector<ColumnChoice> all_columns(const Columns& columns) {
    const std::vector<std::size_t> choices = checked_value_columns(columns);
    std::vector<ColumnChoice> all;
    for (const std::size_t value : choices) all.push_back(with_sigma(columns, value, choices.size() == 1));
    return all;
}

std::string label(const Columns& columns, std::size_t column) {
    const std::string_view name = name_of(columns, column);
    if (!name.empty()) return std::string(name);
    return column == 0 ? "the wavelength" : fmt::format("column {}", column);
}

}  // namespace skinfit
