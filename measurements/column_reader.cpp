#include "measurements/column_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/cells.hpp"
#include "measurements/column_choice.hpp"
#include "measurements/column_store.hpp"
#include "measurements/described_table.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// One spectrum without its numbers: what its column says, after what the file says about all of them.
Spectrum described(const DescribedTable& table, const ColumnChoice& choice, std::size_t count) {
    const Description& description = table.description;
    const PlannedColumn& column = table.plan.columns[choice.value];
    Spectrum spectrum = spectrum_of(description);
    spectrum.source = table.columns.source;
    spectrum.line = table.columns.header_line;
    spectrum.remarks = table.plan.remarks;
    if (count > 1 || description.specimen.empty()) {
        spectrum.name =
            choice.sole ? std::filesystem::path(spectrum.source).stem().string() : table.plan.label(choice.value);
    }
    if (!spectrum.quantity) spectrum.quantity = table.statements.values.quantity;
    if (column.states.quantity) spectrum.quantity = column.states.quantity;
    if (!spectrum.geometry.specular) spectrum.geometry.specular = table.statements.specular;
    if (column.specular) spectrum.geometry.specular = column.specular;
    return spectrum;
}

/// What states the unit of a column's values, but for the values of the other columns.
UnitStatements unit_statements(const DescribedTable& table, std::size_t column, const ReadOptions& options) {
    std::optional<Unit> named = table.plan.columns[column].states.unit;
    const std::size_t wavelength = table.plan.columns[column].wavelength;
    if (!named && !table.columns.names.empty()) named = values_stated(table.columns.names[wavelength]).unit;
    if (!named) named = table.statements.values.unit;
    return {.option = options.unit, .comment = table.description.unit, .named = named, .window = options.window};
}

/// The wavelengths, nm, of a table's rows in a column that need not be asked for; NaN where one holds none.
std::vector<double> glance_at_wavelengths(const DescribedTable& table, std::size_t column) {
    NumberTable numbers = glance_at_numbers(table.columns, std::array{column});
    std::ranges::replace(numbers.cells, 0.0, std::numeric_limits<double>::quiet_NaN());
    return wavelengths_nm(table.plan.columns[column].abscissa, numbers.cells);
}

/// The name of the first column whose values in the window show that the table is in percent, where no word states it;
/// empty where none does.
std::string column_in_percent(const DescribedTable& table, const ReadOptions& options) {
    std::vector<std::size_t> unstated;
    for (std::size_t c = 0; c < table.plan.columns.size(); ++c) {
        if (table.plan.columns[c].role != ColumnRole::value) continue;
        const UnitStatements stated = unit_statements(table, c, options);
        if (stated.option || stated.comment) return {};
        if (!stated.named) unstated.push_back(c);
    }
    if (unstated.size() < 2) return {};
    const NumberTable numbers = glance_at_numbers(table.columns, unstated);
    ColumnStore store(numbers);
    std::map<std::size_t, std::vector<double>> wavelengths;
    for (std::size_t i = 0; i < unstated.size(); ++i) {
        const std::size_t axis = table.plan.columns[unstated[i]].wavelength;
        if (!wavelengths.contains(axis)) wavelengths[axis] = glance_at_wavelengths(table, axis);
        std::vector<double> values = store.column(i);
        (void)take_out_fill_numbers(values);
        if (shows_percent(used_values(options.window, wavelengths[axis], values))) {
            return table.plan.label(unstated[i]);
        }
    }
    return {};
}

/// The wavelengths of a column, and the rows of the table that have one. In tables of several columns of wavelengths
/// these may be of different lengths; elsewhere each row needs its own.
struct Axis {
    std::vector<bool> has_number{};  ///< for each row of the table
    std::vector<std::size_t> rows{};
    std::vector<double> numbers{};      ///< as in the file
    std::vector<double> all_numbers{};  ///< and those that are left out
    Grid grid{};
    std::string remark{};
};

/// Where the unit is stated, numbers outside the range of wavelengths are no slip: of the thermal infrared, say. Throws
/// InputError where nothing else is left.
void leave_out_far(Axis& axis, const Abscissa& abscissa, const std::string& where) {
    const std::vector<double> nm = wavelengths_nm(abscissa, axis.numbers);
    Axis kept;
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
    axis.rows = std::move(kept.rows);
    axis.numbers = std::move(kept.numbers);
}

Axis axis_of(const DescribedTable& table, std::size_t wavelength, bool may_end_early) {
    const Columns& columns = table.columns;
    const std::array<std::size_t, 1> wanted{wavelength};
    const NumberTable numbers = read_number_table(columns, wanted);
    Axis axis;
    for (std::size_t row = 0; row < numbers.cells.size(); ++row) {
        axis.has_number.push_back(!std::isnan(numbers.cells[row]));
        if (!axis.has_number.back()) continue;
        axis.rows.push_back(row);
        axis.numbers.push_back(numbers.cells[row]);
    }
    if (axis.rows.size() < numbers.cells.size() && !may_end_early) (void)read_numbers(columns, wanted);
    if (axis.rows.empty()) (void)read_numbers(columns, wanted);
    axis.all_numbers = axis.numbers;
    const Abscissa& abscissa = table.plan.columns[wavelength].abscissa;
    if (!abscissa.is_nm()) {
        leave_out_far(axis, abscissa, fmt::format("{}: {}", columns.source, label(columns, wavelength)));
        axis.remark = fmt::format("{} to {} {} are read as wavelengths in vacuum", axis.numbers.front(),
                                  axis.numbers.back(), abscissa.name);
    }
    axis.grid = make_grid(wavelengths_nm(abscissa, axis.numbers), [&](std::size_t i) {
        const std::size_t line = columns.rows[axis.rows[i]].line;
        return GridPlace{.where = at_line(columns, line), .which = fmt::format("line {}", line)};
    });
    return axis;
}

/// Throws InputError for a value without a wavelength.
void require_wavelengths(const DescribedTable& table, const Axis& axis, std::size_t column,
                         const std::vector<double>& values) {
    for (std::size_t row = 0; row < values.size(); ++row) {
        if (!axis.has_number[row] && !std::isnan(values[row])) {
            throw InputError(
                {.where = at_line(table.columns, table.columns.rows[row].line),
                 .problem = fmt::format("{} has a value and no wavelength", table.plan.label(column)),
                 .why = fmt::format("{} is empty there", table.plan.label(table.plan.columns[column].wavelength)),
                 .remedy = "give it, or delete the value"});
        }
    }
}

/// Reads the chosen columns of one table.
class ColumnReader {
public:
    ColumnReader(const DescribedTable& table, const ReadOptions& options, std::vector<ColumnChoice> choices)
        : table_(table), options_(options), choices_(std::move(choices)) {
        for (const ColumnChoice& choice : choices_) {
            wanted_.push_back(choice.value);
            if (choice.sigma) wanted_.push_back(*choice.sigma);
        }
    }

    std::vector<Spectrum> read() {
        const NumberTable numbers = read_number_table(table_.columns, wanted_);
        ColumnStore store(numbers);
        percent_in_ = column_in_percent(table_, options_);
        std::vector<Spectrum> spectra;
        std::size_t at = 0;
        for (const ColumnChoice& choice : choices_) {
            const std::size_t value_at = at++;
            const std::optional<std::size_t> sigma_at = choice.sigma ? std::optional(at++) : std::nullopt;
            if (numbers.holds_words[value_at]) continue;
            if (sigma_at && numbers.holds_words[*sigma_at])
                (void)read_numbers(table_.columns, std::array{*choice.sigma});
            std::vector<double> value = store.column(value_at);
            const std::optional<double> fill = take_out_fill_numbers(value);
            spectra.push_back(read(choice, value, sigma_at ? store.column(*sigma_at) : std::vector<double>{}));
            if (fill) {
                spectra.back().remarks.push_back(fmt::format("readings of {} stand for missing values", *fill));
            }
        }
        if (spectra.empty()) (void)read_numbers(table_.columns, std::array{choices_.front().value});
        return spectra;
    }

private:
    const Axis& axis_of(std::size_t wavelength) {
        const auto [found, is_new] = axes_.try_emplace(wavelength);
        if (is_new) {
            const bool paired =
                std::ranges::count(table_.plan.columns, ColumnRole::wavelength, &PlannedColumn::role) > 1;
            found->second = skinfit::axis_of(table_, wavelength, paired);
        }
        return found->second;
    }

    Spectrum read(const ColumnChoice& choice, const std::vector<double>& all_values,
                  const std::vector<double>& all_sigmas) {
        const Axis& axis = axis_of(choice.wavelength);
        require_wavelengths(table_, axis, choice.value, all_values);
        std::vector<double> value;
        std::vector<double> sigma;
        for (const std::size_t row : axis.rows) {
            value.push_back(all_values[row]);
            if (choice.sigma) sigma.push_back(all_sigmas[row]);
        }
        if (choice.sole) check_declared(table_.columns.source, table_.statements.declared, axis.all_numbers, value);
        for (double& each : value) each *= table_.statements.factor;
        for (double& each : sigma) each *= table_.statements.factor;
        Spectrum spectrum = described(table_, choice, choices_.size());
        if (!axis.remark.empty()) spectrum.remarks.push_back(axis.remark);
        if (choice.sigma) take_sigma(spectrum, *choice.sigma, sigma);
        UnitStatements unit = unit_statements(table_, choice.value, options_);
        unit.percent_in = percent_in_;
        take_readings(spectrum, axis.grid, {.value = value, .sigma = sigma}, unit);
        return spectrum;
    }

    /// Uncertainties that are 0 throughout, as of a computation without noise, are none.
    void take_sigma(Spectrum& spectrum, std::size_t column, std::vector<double>& sigma) const {
        if (std::ranges::all_of(sigma, [](double each) { return each == 0; })) {
            spectrum.remarks.push_back(fmt::format("{} is 0 throughout, which states no uncertainty",
                                                   in_quotes(label(table_.columns, column))));
            sigma.clear();
            return;
        }
        const std::string& stated = table_.description.sigma_source;
        const std::string& name = table_.plan.columns[column].name;
        const bool plain = name == "sigma" || name.ends_with("_sigma");
        const std::string given = plain ? "given by the file" : fmt::format("given by the file as {}", name);
        spectrum.sigma_source = stated.empty() ? given : stated;
    }

    const DescribedTable& table_;
    const ReadOptions& options_;
    std::vector<ColumnChoice> choices_;
    std::vector<std::size_t> wanted_{};
    std::map<std::size_t, Axis> axes_{};
    std::string percent_in_{};
};

}  // namespace

std::vector<Spectrum> read_columns(std::string_view text, const std::string& source, const ReadOptions& options) {
    const DescribedTable table = described_table(text, source);
    std::vector<ColumnChoice> choices = options.column
                                            ? std::vector{choose_column(table.columns, table.plan, options.column)}
                                            : all_columns(table.columns, table.plan);
    return ColumnReader(table, options, std::move(choices)).read();
}

void refuse_several_columns(std::string_view text, const std::string& source) {
    const DescribedTable table = described_table(text, source);
    (void)choose_column(table.columns, table.plan, std::nullopt);
}

ValuePlace place_in_columns(std::string_view text, const std::string& source, const ReadOptions& options,
                            double wavelength_nm) {
    const DescribedTable table = described_table(text, source);
    const ColumnChoice choice = choose_column(table.columns, table.plan, options.column);
    const Axis axis = axis_of(table, choice.wavelength, true);
    const std::vector<double> nm = wavelengths_nm(table.plan.columns[choice.wavelength].abscissa, axis.numbers);
    const auto at = static_cast<std::size_t>(std::ranges::find(nm, wavelength_nm) - nm.begin());
    return {.where = at_line(table.columns, table.columns.rows[axis.rows[at]].line),
            .sigma = choice.sigma ? label(table.columns, *choice.sigma) : "sigma"};
}

}  // namespace skinfit
