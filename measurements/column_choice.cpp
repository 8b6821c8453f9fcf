#include "measurements/column_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

std::string_view name_of(const Columns& columns, std::size_t column) {
    return columns.names.empty() ? std::string_view{} : std::string_view(columns.names[column]);
}

using ColumnsByName = std::unordered_map<std::string_view, std::vector<std::size_t>>;

/// The columns of each name, without the wavelengths and those without a name.
ColumnsByName columns_by_name(const Columns& columns) {
    ColumnsByName by_name;
    for (std::size_t c = 1; c < columns.names.size(); ++c) {
        if (!columns.names[c].empty()) by_name[columns.names[c]].push_back(c);
    }
    return by_name;
}

std::vector<std::size_t> called(const ColumnsByName& by_name, std::string_view name) {
    const auto found = by_name.find(name);
    return found == by_name.end() ? std::vector<std::size_t>{} : found->second;
}

bool is_uncertainty(const ColumnsByName& by_name, std::string_view name) {
    constexpr std::string_view suffix = "_sigma";
    if (name == suffix.substr(1)) return true;
    if (!name.ends_with(suffix)) return false;
    name.remove_suffix(suffix.size());
    return by_name.contains(name);
}

std::vector<std::size_t> value_columns(const Columns& columns, const ColumnsByName& by_name) {
    std::vector<std::size_t> found;
    for (std::size_t c = 1; c < columns.width; ++c) {
        if (!is_uncertainty(by_name, name_of(columns, c))) found.push_back(c);
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
                      .why = "that looks like one spectrum per line, and columns are read here",
                      .remedy = "use --reader rows, or call the first column wavelength_nm if these are names"});
}

std::size_t find_column(const Columns& columns, const std::vector<std::size_t>& choices, const std::string& wanted) {
    const std::vector<std::size_t> called_so = called(columns_by_name(columns), wanted);
    if (called_so.size() > 1) {
        throw InputError({.where = header_place(columns),
                          .problem = fmt::format("{} columns are called {}", called_so.size(), in_quotes(wanted)),
                          .why = fmt::format("numbers {}", fmt::join(called_so, ", ")),
                          .remedy = "choose one by its number"});
    }
    const std::optional<std::uint64_t> number = parse_count(wanted);
    const std::size_t column = called_so.empty() ? static_cast<std::size_t>(number.value_or(0)) : called_so.front();
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

std::vector<std::size_t> checked_value_columns(const Columns& columns, const ColumnsByName& by_name) {
    refuse_spectra_in_rows(columns);
    std::vector<std::size_t> choices = value_columns(columns, by_name);
    if (!choices.empty()) return choices;
    throw InputError({.where = header_place(columns),
                      .problem = "has no column of values",
                      .why = "all columns but the wavelengths are called sigma",
                      .remedy = "add the values or rename their column"});
}

ColumnChoice with_sigma(const Columns& columns, const ColumnsByName& by_name, std::size_t value, bool sole) {
    std::vector<std::size_t> sigma = called(by_name, fmt::format("{}_sigma", name_of(columns, value)));
    if (sigma.empty()) sigma = called(by_name, "sigma");
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
    const ColumnsByName by_name = columns_by_name(columns);
    const std::vector<std::size_t> choices = checked_value_columns(columns, by_name);
    if (!wanted && choices.size() > 1) {
        throw InputError({.where = header_place(columns),
                          .problem = fmt::format("has {} columns of values", choices.size()),
                          .why = list(columns, choices),
                          .remedy = "choose one with --column, by its name or its number"});
    }
    const std::size_t value = wanted ? find_column(columns, choices, *wanted) : choices.front();
    return with_sigma(columns, by_name, value, choices.size() == 1);
}

std::vector<ColumnChoice> all_columns(const Columns& columns) {
    const ColumnsByName by_name = columns_by_name(columns);
    const std::vector<std::size_t> choices = checked_value_columns(columns, by_name);
    std::vector<ColumnChoice> all;
    for (const std::size_t value : choices) all.push_back(with_sigma(columns, by_name, value, choices.size() == 1));
    return all;
}

std::string label(const Columns& columns, std::size_t column) {
    const std::string_view name = name_of(columns, column);
    if (!name.empty()) return std::string(name);
    return column == 0 ? "the wavelength" : fmt::format("column {}", column);
}

}  // namespace skinfit
