#include "model/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <stdexcept>

#include "core/embedded_file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"

namespace skinfit::model_data {
std::span<const EmbeddedFile> embedded_files();
}  // namespace skinfit::model_data

namespace skinfit {
namespace {

using Notes = std::map<std::string, std::string, std::less<>>;

void require(bool condition, std::string_view table, std::string_view rule) {
    if (!condition) throw std::logic_error(fmt::format("table {}: {}", table, rule));
}

OutsideRange outside_range(const Notes& notes, std::string_view key, std::string_view table) {
    const auto note = notes.find(key);
    require(note != notes.end() && (note->second == "error" || note->second == "zero"), table,
            "below_range and above_range must be error or zero");
    return note->second == "zero" ? OutsideRange::zero : OutsideRange::error;
}

std::map<std::string, Table, std::less<>> parse_embedded_tables() {
    std::map<std::string, Table, std::less<>> tables;
    for (const EmbeddedFile& file : model_data::embedded_files()) {
        const std::string_view name = file.name.substr(0, file.name.rfind('.'));
        tables.emplace(name, parse_table(name, file.text));
    }
    return tables;
}

}  // namespace

const std::vector<double>& Table::column(std::string_view column) const {
    const auto found = std::ranges::find(column_names, column);
    assert(found != column_names.end());
    return columns[static_cast<std::size_t>(found - column_names.begin())];
}

Table parse_table(std::string_view name, std::string_view text) {
    Table table;
    table.name = name;
    Notes notes;
    for (const std::string_view line : split_lines(text)) {
        if (line.starts_with('#')) {
            const std::size_t colon = line.find(':');
            require(colon != std::string_view::npos, name, "a note must read 'key: text'");
            notes.emplace(trimmed(line.substr(1, colon - 1)), trimmed(line.substr(colon + 1)));
        } else if (table.column_names.empty()) {
            for (const std::string_view field : split(line, ',')) table.column_names.emplace_back(field);
            table.columns.resize(table.column_names.size());
        } else {
            const std::vector<std::string_view> fields = split(line, ',');
            require(fields.size() == table.columns.size(), name, "every row needs one number per column");
            for (std::size_t c = 0; c < fields.size(); ++c) {
                const std::optional<double> number = parse_number(fields[c]);
                require(number.has_value(), name, "every field must be a number");
                table.columns[c].push_back(*number);
            }
        }
    }
    for (const std::string_view key : {"quantity", "unit", "source"}) {
        require(notes.contains(key), name, "quantity, unit and source must be stated");
    }
    table.quantity = notes.find("quantity")->second;
    table.unit = notes.find("unit")->second;
    table.source = notes.find("source")->second;
    table.below = outside_range(notes, "below_range", name);
    table.above = outside_range(notes, "above_range", name);
    require(table.columns.size() >= 2 && table.columns[0].size() >= 2, name, "at least two columns and rows");
    require(std::ranges::adjacent_find(table.columns[0], std::greater_equal<>{}) == table.columns[0].end(), name,
            "the abscissa must ascend strictly");
    return table;
}

const Table& embedded_table(std::string_view name) {
    static const std::map<std::string, Table, std::less<>> tables = parse_embedded_tables();
    const auto found = tables.find(name);
    assert(found != tables.end());
    return found->second;
}

Curve::Curve(const Table& table, std::string_view column) : table_(&table), values_(&table.column(column)) {}

double Curve::operator()(double wavelength_nm) const {
    const std::vector<double>& abscissa = table_->columns.front();
    const bool below = wavelength_nm < abscissa.front();
    const bool above = wavelength_nm > abscissa.back();
    if ((below && table_->below == OutsideRange::zero) || (above && table_->above == OutsideRange::zero)) return 0.0;
    if (below || above || wavelength_nm != wavelength_nm) {
        throw InputError(
            {.where = fmt::format("wavelength {} nm", wavelength_nm),
             .problem = fmt::format("outside the table {}", table_->name),
             .why = fmt::format("measured from {} to {} nm and never extrapolated", abscissa.front(), abscissa.back()),
             .remedy = "choose wavelengths inside that range"});
    }
    const auto upper = std::upper_bound(abscissa.begin() + 1, abscissa.end() - 1, wavelength_nm);
    const auto i = static_cast<std::size_t>(upper - abscissa.begin());
    const double share = (wavelength_nm - abscissa[i - 1]) / (abscissa[i] - abscissa[i - 1]);
    return (1.0 - share) * (*values_)[i - 1] + share * (*values_)[i];
}

}  // namespace skinfit
