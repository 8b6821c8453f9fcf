#include "measurements/long_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "measurements/cell_numbers.hpp"
#include "measurements/cells.hpp"
#include "measurements/column_words.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

constexpr std::size_t fewest_readings = 3;  // chosen: of a spectrum

/// A column whose cells may tell spectra from each other.
struct Key {
    std::size_t column;
    bool is_named;                   ///< after specimens
    std::vector<std::string> cells;  ///< of each row
};

std::vector<std::string> cells_below(const Columns& columns, std::size_t column) {
    std::vector<std::string> cells;
    CellCutter cutter(columns.separator);
    for (const Row& row : columns.rows) cells.push_back(unescaped(cutter.cut(row.text)[column]));
    return cells;
}

/// True where some cells differ, and each comes often enough.
bool tells_apart(const std::vector<std::string>& cells) {
    std::map<std::string_view, std::size_t> count;
    for (const std::string& cell : cells) ++count[cell];
    return count.size() > 1 && !count.contains("") &&
           std::ranges::all_of(count, [](const auto& each) { return each.second >= fewest_readings; });
}

std::vector<Key> keys_of(const DescribedTable& table) {
    const Columns& columns = table.columns;
    const auto wavelengths = std::ranges::count(table.plan.columns, ColumnRole::wavelength, &PlannedColumn::role);
    if (columns.names.empty() || wavelengths != 1 || columns.rows.size() < 2 * fewest_readings) return {};
    CellCutter cutter(columns.separator);
    const std::span<const std::string_view> cut = cutter.cut(columns.rows.front().text);
    const std::vector<std::string_view> first(cut.begin(), cut.end());
    std::vector<Key> keys;
    for (std::size_t c = 0; c < columns.width; ++c) {
        const ColumnRole role = table.plan.columns[c].role;
        if (role != ColumnRole::value && role != ColumnRole::unused) continue;
        const bool is_named = names_specimens(columns.names[c]);
        const bool is_word = !is_missing(first[c]) && !starts_like_a_number(first[c]);
        if (!is_named && !is_word) continue;
        Key key{.column = c, .is_named = is_named, .cells = cells_below(columns, c)};
        if (tells_apart(key.cells)) keys.push_back(std::move(key));
    }
    return keys;
}

/// The rows of each specimen, in the order of their first.
struct Group {
    std::string name;
    std::vector<std::size_t> rows;
    std::set<double> wavelengths;
};

std::vector<Group> groups_by(const std::vector<Key>& keys, const std::vector<double>& wavelengths) {
    std::vector<Group> groups;
    std::map<std::string, std::size_t> at;
    for (std::size_t row = 0; row < wavelengths.size(); ++row) {
        std::string name;
        for (const Key& key : keys) name += (name.empty() ? "" : " ") + key.cells[row];
        const auto [found, is_new] = at.try_emplace(name, groups.size());
        if (is_new) groups.push_back({.name = name, .rows = {}, .wavelengths = {}});
        groups[found->second].rows.push_back(row);
        groups[found->second].wavelengths.insert(wavelengths[row]);
    }
    return groups;
}

/// Whether the second of two spectra has most of its wavelengths, or of their range, in common with the first.
bool goes_over_the_same(const Group& one, const Group& two, bool range_suffices) {
    std::size_t shared = 0;
    for (const double each : two.wavelengths) {
        const bool inside = each >= *one.wavelengths.begin() && each <= *one.wavelengths.rbegin();
        if (one.wavelengths.contains(each) || (range_suffices && inside)) ++shared;
    }
    return 2 * shared > two.wavelengths.size();
}

bool are_spectra(const std::vector<Group>& groups, bool range_suffices) {
    bool same = false;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups[g].wavelengths.size() < std::max(groups[g].rows.size(), fewest_readings)) return false;
        if (g > 0) same = same || goes_over_the_same(groups[0], groups[g], range_suffices);
    }
    return same;
}

}  // namespace

std::vector<TablePart> parts_of(DescribedTable table) {
    const std::vector<Key> keys = keys_of(table);
    const auto whole = [&] {
        std::vector<TablePart> parts;
        parts.push_back({.name = {}, .table = std::move(table)});
        return parts;
    };
    if (keys.empty()) return whole();
    const std::vector<double> wavelengths =
        glance_at_numbers(table.columns, std::array{table.plan.first_wavelength}).cells;
    const std::vector<Group> groups = groups_by(keys, wavelengths);
    const bool is_named = std::ranges::any_of(keys, &Key::is_named);
    if (!are_spectra(groups, is_named)) return whole();
    std::vector<std::string> names;
    for (const Key& key : keys) {
        names.push_back(in_quotes(table.columns.names[key.column]));
        PlannedColumn& column = table.plan.columns[key.column];
        if (column.role == ColumnRole::value) --table.plan.values;
        column.leave_out("it names the spectra");
    }
    table.plan.remarks.push_back(
        fmt::format("the rows are {} spectra, told apart by {}", groups.size(), fmt::join(names, ", ")));
    std::vector<TablePart> parts;
    for (const Group& group : groups) {
        TablePart part{.name = group.name, .table = table};
        part.table.columns.rows.clear();
        for (const std::size_t row : group.rows) part.table.columns.rows.push_back(table.columns.rows[row]);
        std::erase_if(part.table.statements.declared, [&](const Declared& each) {
            return each.meaning == "count" && each.number == static_cast<double>(wavelengths.size());
        });
        parts.push_back(std::move(part));
    }
    return parts;
}

}  // namespace skinfit
