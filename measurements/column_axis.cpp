#include "measurements/column_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// Throws InputError where nothing else is left.
void leave_out_far(ColumnAxis& axis, const Abscissa& abscissa, const std::string& where) {
    const std::vector<double> nm = wavelengths_nm(abscissa, axis.numbers);
    ColumnAxis kept;
    for (std::size_t i = 0; i < nm.size(); ++i) {
        if (!wavelength_range_nm.contains(nm[i])) continue;
        kept.rows.push_back(axis.rows[i]);
        kept.numbers.push_back(axis.numbers[i]);
    }
    if (kept.rows.empty()) {
        throw InputError({.where = where,
                          .problem = fmt::format("{} to {} {} are {:g} to {:g} nm", axis.numbers.front(),
                                                 axis.numbers.back(), abscissa.name, nm.front(), nm.back()),
                          .why = fmt::format("wavelengths lie between {} and {} nm", wavelength_range_nm.lowest,
                                             wavelength_range_nm.highest),
                          .remedy = "correct the unit in the header, or measure visible light"});
    }
    if (kept.rows.size() < axis.rows.size() && abscissa.is_nm()) {
        axis.remark = fmt::format("{} readings outside {} to {} nm are left out", axis.rows.size() - kept.rows.size(),
                                  wavelength_range_nm.lowest, wavelength_range_nm.highest);
    }
    axis.rows = std::move(kept.rows);
    axis.numbers = std::move(kept.numbers);
}

/// Where no unit is stated, a few numbers outside the range are no sign of another one.
bool are_mostly_nm(const std::vector<double>& numbers) {
    constexpr std::size_t share = 10;  // chosen: of so many one may lie outside
    const auto outside = std::ranges::count_if(numbers, [](double nm) { return !wavelength_range_nm.contains(nm); });
    return share * static_cast<std::size_t>(outside) <= numbers.size();
}

}  // namespace

ColumnAxis axis_of(const DescribedTable& table, std::size_t wavelength, const std::vector<bool>& may_lack_one) {
    const Columns& columns = table.columns;
    const std::array<std::size_t, 1> wanted{wavelength};
    const NumberTable numbers = read_number_table(columns, wanted);
    ColumnAxis axis;
    bool lacks_one = false;
    for (std::size_t row = 0; row < numbers.cells.size(); ++row) {
        const bool is_none = may_lack_one[row] && is_fill_number(numbers.cells[row]);
        axis.has_number.push_back(!std::isnan(numbers.cells[row]) && !is_none);
        lacks_one = lacks_one || (!axis.has_number.back() && !may_lack_one[row]);
        if (!axis.has_number.back()) continue;
        axis.rows.push_back(row);
        axis.numbers.push_back(numbers.cells[row]);
    }
    if (lacks_one) (void)read_numbers(columns, wanted);
    if (axis.rows.empty()) (void)read_numbers(columns, wanted);
    axis.all_numbers = axis.numbers;
    const Abscissa& abscissa = table.plan.columns[wavelength].abscissa;
    if (!abscissa.is_nm() || are_mostly_nm(axis.numbers)) {
        leave_out_far(axis, abscissa, fmt::format("{}: {}", columns.source, label(columns, wavelength)));
    }
    if (!abscissa.is_nm()) {
        axis.remark = fmt::format("{} to {} {} are read as wavelengths in vacuum", axis.numbers.front(),
                                  axis.numbers.back(), abscissa.name);
    }
    axis.grid = make_grid(wavelengths_nm(abscissa, axis.numbers), [&](std::size_t i) {
        const std::size_t line = columns.rows[axis.rows[i]].line;
        return GridPlace{.where = at_line(columns, line), .which = fmt::format("line {}", line)};
    });
    return axis;
}

}  // namespace skinfit
