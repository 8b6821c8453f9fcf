#include "measurements/column_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <span>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/cells.hpp"
#include "measurements/column_axis.hpp"
#include "measurements/column_choice.hpp"
#include "measurements/column_store.hpp"
#include "measurements/described_table.hpp"
#include "measurements/empty_rows.hpp"
#include "measurements/long_table.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/spectrum_choice.hpp"
#include "measurements/table_unit.hpp"
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
    if (column.states.quantity) name_quantity(spectrum, *column.states.quantity);
    if (!spectrum.geometry.specular) spectrum.geometry.specular = table.statements.specular;
    if (column.specular) spectrum.geometry.specular = column.specular;
    return spectrum;
}

/// Throws InputError where the table has not what its file declares. Of values that are multiplied, the numbers before
/// or after it may be declared.
void check_table(const DescribedTable& table, const std::vector<double>& wavelengths, std::vector<double> values) {
    const std::string& source = table.columns.source;
    if (table.statements.factor != 1) {
        try {
            check_declared(source, table.statements.declared, wavelengths, values);
            return;
        } catch (const InputError&) {
            for (double& each : values) each *= table.statements.factor;
        }
    }
    check_declared(source, table.statements.declared, wavelengths, values);
}

/// Throws InputError for a value without a wavelength.
void require_wavelengths(const DescribedTable& table, const ColumnAxis& axis, std::size_t column,
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
    ColumnReader(const DescribedTable& table, const ReadOptions& options, std::vector<ColumnChoice> choices,
                 std::string percent_in)
        : table_(table), options_(options), choices_(std::move(choices)), percent_in_(std::move(percent_in)) {
        for (const ColumnChoice& choice : choices_) {
            wanted_.push_back(choice.value);
            if (choice.sigma) wanted_.push_back(*choice.sigma);
        }
    }

    std::vector<Spectrum> read() {
        const NumberTable numbers = read_in_window();
        ColumnStore store(numbers);
        empty_ = empty_rows(table_, numbers);
        std::vector<Spectrum> spectra;
        std::size_t at = 0;
        for (const ColumnChoice& choice : choices_) {
            const std::size_t value_at = at++;
            const std::size_t sigma_at = choice.sigma ? at++ : value_at;
            if (numbers.holds_words[value_at]) continue;
            if (choice.sigma && numbers.holds_words[sigma_at])
                (void)read_numbers(table_.columns, std::array{*choice.sigma});
            std::vector<double> value = store.column(value_at);
            const std::optional<double> fill = take_out_fill_numbers(value, table_.statements.fill);
            const std::size_t zeros = empty_.take_out_zeros(choice.wavelength, value);
            spectra.push_back(read(choice, value, choice.sigma ? store.column(sigma_at) : std::vector<double>{}));
            if (fill) {
                spectra.back().remarks.push_back(fmt::format("readings of {} stand for missing values", *fill));
            }
            if (zeros > 0) {
                spectra.back().remarks.push_back(
                    fmt::format("{} readings that are 0 in every spectrum stand for missing values", zeros));
            }
        }
        if (spectra.empty()) (void)read_numbers(table_.columns, std::array{choices_.front().value});
        return spectra;
    }

private:
    const ColumnAxis& axis_of(std::size_t wavelength) {
        const auto [found, is_new] = axes_.try_emplace(wavelength);
        if (is_new) {
            const bool paired =
                std::ranges::count(table_.plan.columns, ColumnRole::wavelength, &PlannedColumn::role) > 1;
            const std::vector<bool> all(table_.columns.rows.size(), true);
            found->second = skinfit::axis_of(table_, wavelength, paired ? all : empty_.has_no_reading);
        }
        return found->second;
    }

    Spectrum read(const ColumnChoice& choice, const std::vector<double>& all_values,
                  const std::vector<double>& all_sigmas) {
        const ColumnAxis& axis = axis_of(choice.wavelength);
        require_wavelengths(table_, axis, choice.value, all_values);
        std::vector<double> value;
        std::vector<double> sigma;
        for (const std::size_t row : axis.rows) {
            value.push_back(all_values[row]);
            if (choice.sigma) sigma.push_back(all_sigmas[row]);
        }
        const bool is_paired = axes_.size() > 1;
        if (!is_paired && choice.sole) check_table(table_, axis.all_numbers, value);
        if (!is_paired && !choice.sole) {
            check_declared(table_.columns.source, declared_of_several(table_.statements.declared), axis.all_numbers, {},
                           choices_.size());
        }
        for (double& each : value) each *= table_.statements.factor;
        for (double& each : sigma) each *= table_.statements.factor;
        Spectrum spectrum = described(table_, choice, choices_.size());
        if (!axis.remark.empty()) spectrum.remarks.push_back(axis.remark);
        std::ranges::move(doubts_about_scans(table_.statements.scans, axis.grid.wavelength_nm),
                          std::back_inserter(spectrum.remarks));
        UnitStatements unit = unit_statements(table_, choice.value, options_);
        unit.percent_in = percent_in_;
        if (choice.sigma) {
            const std::vector<double> used = used_values(options_.window, axis.grid, value);
            take_sigma(spectrum, *choice.sigma, sigma, used.empty() ? Unit::fraction : find_unit(unit, used).unit);
        }
        take_readings(spectrum, axis.grid, {.value = value, .sigma = sigma}, unit);
        return spectrum;
    }

    /// Uncertainties that are 0 throughout, as of a computation without noise, are none; those that state percent
    /// beside fractions may be relative.
    void take_sigma(Spectrum& spectrum, std::size_t column, std::vector<double>& sigma, Unit unit) const {
        const std::optional<Unit> own = table_.plan.columns[column].states.unit;
        const bool may_be_relative = own == Unit::percent && unit == Unit::fraction;
        const bool is_none = std::ranges::all_of(sigma, [](double each) { return each == 0; });
        if (is_none || may_be_relative) {
            const std::string name = in_quotes(label(table_.columns, column));
            spectrum.remarks.push_back(
                is_none ? fmt::format("{} is 0 throughout, which states no uncertainty", name)
                        : fmt::format("left out: {} (in percent beside fractions it may be relative)", name));
            sigma.clear();
            return;
        }
        if (own == Unit::fraction && unit == Unit::percent) {
            for (double& each : sigma) each *= 100;  // taken as percent with the values
        }
        const std::string& stated = table_.description.sigma_source;
        const std::string& name = table_.plan.columns[column].name;
        const bool plain = name == "sigma" || name.ends_with("_sigma");
        const std::string given = plain ? "given by the file" : fmt::format("given by the file as {}", name);
        spectrum.sigma_source = stated.empty() ? given : stated;
    }

    /// The numbers of the wanted columns. A word among them is refused in the window only.
    [[nodiscard]] NumberTable read_in_window() const {
        const WavelengthWindow& window = options_.window;
        if (window.range.lowest_nm <= 0 && std::isinf(window.range.highest_nm) && window.excluded.empty()) {
            return read_number_table(table_.columns, wanted_);
        }
        Columns inside = table_.columns;
        std::vector<bool> is_inside(inside.rows.size(), false);
        for (const ColumnChoice& choice : choices_) {
            const std::vector<double> nm = glance_at_wavelengths(table_, choice.wavelength);
            for (std::size_t row = 0; row < nm.size(); ++row) {
                is_inside[row] = is_inside[row] || std::isnan(nm[row]) || window.contains(nm[row]);
            }
        }
        std::size_t row = 0;
        std::erase_if(inside.rows, [&](const Row&) { return !is_inside[row++]; });
        if (!inside.rows.empty()) (void)read_number_table(inside, wanted_);
        return glance_at_numbers(table_.columns, wanted_);
    }

    const DescribedTable& table_;
    const ReadOptions& options_;
    std::vector<ColumnChoice> choices_;
    std::string percent_in_;
    std::vector<std::size_t> wanted_{};
    EmptyRows empty_{};
    std::map<std::size_t, ColumnAxis> axes_{};
};

/// The spectra of one part of a table.
std::vector<Spectrum> read_part(const TablePart& part, const ReadOptions& options, const std::string& percent_in) {
    const DescribedTable& table = part.table;
    const bool is_part = !part.name.empty();
    std::vector<ColumnChoice> choices = options.column && !is_part
                                            ? std::vector{choose_column(table.columns, table.plan, options.column)}
                                            : all_columns(table.columns, table.plan);
    const bool sole = choices.size() == 1;
    std::vector<Spectrum> spectra = ColumnReader(table, options, std::move(choices), percent_in).read();
    if (!is_part) return spectra;
    const ValueStatement stated = values_stated(part.name);
    for (Spectrum& spectrum : spectra) {
        spectrum.name = sole ? part.name : part.name + " " + spectrum.name;
        if (stated.quantity) spectrum.quantity = stated.quantity;
        if (const auto specular = specular_stated(part.name)) spectrum.geometry.specular = specular;
        spectrum.line = table.columns.rows.front().line;
    }
    return spectra;
}

}  // namespace

std::vector<Spectrum> read_columns(std::string_view text, const std::string& source, const ReadOptions& options) {
    DescribedTable table = described_table(text, source);
    const std::string percent_in = column_in_percent(table, options);
    const std::vector<TablePart> parts = parts_of(std::move(table));
    std::vector<Spectrum> spectra;
    for (const TablePart& part : parts)
        std::ranges::move(read_part(part, options, percent_in), std::back_inserter(spectra));
    if (parts.size() > 1 && options.column) return {choose_spectrum(std::move(spectra), source, *options.column)};
    return spectra;
}

void refuse_several_columns(std::string_view text, const std::string& source) {
    const std::vector<TablePart> parts = parts_of(described_table(text, source));
    if (parts.size() == 1) (void)choose_column(parts[0].table.columns, parts[0].table.plan, std::nullopt);
}

ValuePlace place_in_columns(std::string_view text, const std::string& source, const ReadOptions& options,
                            double wavelength_nm) {
    const std::vector<TablePart> parts = parts_of(described_table(text, source));
    if (parts.size() > 1) return {.where = source};
    const DescribedTable& table = parts.front().table;
    const ColumnChoice choice = choose_column(table.columns, table.plan, options.column);
    const ColumnAxis axis = axis_of(table, choice.wavelength, std::vector<bool>(table.columns.rows.size(), true));
    const std::vector<double> nm = wavelengths_nm(table.plan.columns[choice.wavelength].abscissa, axis.numbers);
    const auto at = static_cast<std::size_t>(std::ranges::find(nm, wavelength_nm) - nm.begin());
    return {.where = at_line(table.columns, table.columns.rows[axis.rows[at]].line),
            .sigma = choice.sigma ? label(table.columns, *choice.sigma) : "sigma"};
}

}  // namespace skinfit
