#include "measurements/table_unit.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "measurements/cell_numbers.hpp"
#include "measurements/column_store.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

bool is_constant(const std::vector<double>& values) {
    return values.size() > 1 && std::ranges::adjacent_find(values, std::not_equal_to{}) == values.end();
}

}  // namespace

UnitStatements unit_statements(const DescribedTable& table, std::size_t column, const ReadOptions& options) {
    std::optional<Unit> named = table.plan.columns[column].states.unit;
    const std::size_t wavelength = table.plan.columns[column].wavelength;
    if (!named && !table.columns.names.empty()) named = values_stated(table.columns.names[wavelength]).unit;
    if (!named) named = table.statements.values.unit;
    return {.option = options.unit, .comment = table.description.unit, .named = named, .window = options.window};
}

std::vector<double> glance_at_wavelengths(const DescribedTable& table, std::size_t column) {
    NumberTable numbers = glance_at_numbers(table.columns, std::array{column});
    std::ranges::replace(numbers.cells, 0.0, std::numeric_limits<double>::quiet_NaN());
    return wavelengths_nm(table.plan.columns[column].abscissa, numbers.cells);
}

std::string column_in_percent(const DescribedTable& table, const ReadOptions& options) {
    std::vector<std::size_t> unstated;
    for (std::size_t c = 0; c < table.plan.columns.size(); ++c) {
        if (table.plan.columns[c].role != ColumnRole::value) continue;
        const UnitStatements stated = unit_statements(table, c, options);
        if (stated.option || stated.comment) return {};
        if (!stated.named) unstated.push_back(c);
    }
    if (unstated.size() < 2) return {};
    const auto names_none = [&](std::size_t c) { return !table.plan.columns[c].states.quantity; };
    if (!std::ranges::all_of(unstated, names_none)) std::erase_if(unstated, names_none);
    const NumberTable numbers = glance_at_numbers(table.columns, unstated);
    ColumnStore store(numbers);
    std::map<std::size_t, std::vector<double>> wavelengths;
    for (std::size_t i = 0; i < unstated.size(); ++i) {
        const std::size_t axis = table.plan.columns[unstated[i]].wavelength;
        if (!wavelengths.contains(axis)) wavelengths[axis] = glance_at_wavelengths(table, axis);
        std::vector<double> values = store.column(i);
        (void)take_out_fill_numbers(values, table.statements.fill);
        for (double& each : values) each *= table.statements.factor;
        if (!is_constant(values) && shows_percent(used_values(options.window, wavelengths[axis], values))) {
            return table.plan.label(unstated[i]);
        }
    }
    return {};
}

}  // namespace skinfit
