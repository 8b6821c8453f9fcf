#include "measurements/table_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/input_error.hpp"
#include "measurements/column_words.hpp"
#include "measurements/header.hpp"
#include "measurements/paired_columns.hpp"
#include "measurements/table_uncertainties.hpp"
#include "measurements/uncertainty_name.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

class Planner {
public:
    Planner(const Columns& columns, const FileStatements& statements) : columns_(columns), statements_(statements) {
        plan_.columns.resize(columns.width);
        plan_.remarks = statements.remarks;
        for (std::size_t c = 0; c < columns.names.size(); ++c) {
            plan_.columns[c].name = columns.names[c];
            plan_.columns[c].header = columns.names[c];
        }
    }

    TablePlan plan() {
        take_titles();
        take_wavelengths();
        take_counters();
        take_quantities();
        take_uncertainties(plan_, header_place());
        for (const PlannedColumn& column : plan_.columns) plan_.values += column.role == ColumnRole::value ? 1 : 0;
        tell_unused();
        return std::move(plan_);
    }

private:
    [[nodiscard]] std::string_view header(std::size_t c) const { return plan_.columns[c].header; }
    [[nodiscard]] std::string header_place() const {
        return columns_.header_line > 0 ? at_line(columns_, columns_.header_line) : columns_.source;
    }
    [[nodiscard]] bool is(std::size_t c, ColumnRole role) const { return plan_.columns[c].role == role; }
    void leave_out(std::size_t c, std::string reason) { plan_.columns[c].leave_out(std::move(reason)); }

    /// What a line about the names gives each column; one cell may stand above several.
    [[nodiscard]] std::vector<std::string> cells_above(const TitleLine& title) const {
        std::vector<std::string> cells = title.cells;
        cells.resize(columns_.width);
        for (std::size_t c = 1; c < cells.size(); ++c) {
            if (cells[c].empty() && !is_abscissa_name(header(c)) && (c > 1 || is_abscissa_name(header(0)))) {
                cells[c] = cells[c - 1];
            }
        }
        return cells;
    }

    /// What the lines about the names give each column to be called by; those that state something of values, too,
    /// where these are wanted.
    [[nodiscard]] std::vector<std::string> joined_titles(bool with_statements) const {
        std::vector<std::string> titles(columns_.width);
        for (const TitleLine& line : columns_.titles) {
            if (line.is_statement && !with_statements) continue;
            const std::vector<std::string> cells = cells_above(line);
            for (std::size_t c = 0; c < titles.size(); ++c) {
                if (is_unit(cells[c]) || cells[c].empty() || titles[c] == cells[c]) continue;
                titles[c] += (titles[c].empty() ? "" : " ") + cells[c];
            }
        }
        return titles;
    }

    /// Lines above the header name what its columns repeat, or leave empty: `forearm,,cheek,,` over
    /// `Wavelength,%R,Wavelength,%R`.
    void take_titles() {
        std::map<std::string_view, std::size_t> count;
        for (const std::string& name : columns_.names) ++count[name];
        std::vector<std::string> titles = joined_titles(false);
        const auto repeats = [&](std::size_t c) {
            return !titles[c].empty() && count[columns_.names[c]] > 1 && std::ranges::count(titles, titles[c]) > 1 &&
                   !uncertainty_named(columns_.names[c]);
        };
        bool needs_more = std::ranges::all_of(titles, &std::string::empty);
        for (std::size_t c = 0; c < columns_.names.size(); ++c) needs_more = needs_more || repeats(c);
        if (needs_more) titles = joined_titles(true);
        std::map<std::string, std::size_t> used;
        for (std::size_t c = 0; c < columns_.names.size(); ++c) {
            const std::string& name = columns_.names[c];
            if (is_abscissa_name(name) || titles[c].empty() || (count[name] < 2 && !name.empty())) continue;
            const bool taken = ++used[titles[c]] > 1;
            plan_.columns[c].name = taken ? fmt::format("{} {}", titles[c], name) : titles[c];
            if (name.empty()) plan_.columns[c].header = titles[c];
        }
    }

    /// What the lines about the names state of the values of column `c`.
    void take_title_statements(std::size_t c) {
        PlannedColumn& column = plan_.columns[c];
        for (const TitleLine& line : columns_.titles) {
            const std::string cell = cells_above(line)[c];
            const bool keyed = line.is_statement && is_ordinate_key(line.cells.front());
            const ValueStatement stated = keyed ? values_stated_by_letter(cell) : values_stated(cell);
            if (!column.states.quantity && column.states.unusable.empty()) {
                column.states.quantity = stated.quantity;
                column.states.unusable = stated.unusable;
            }
            if (!column.states.unit) column.states.unit = stated.unit;
            if (!column.specular) column.specular = specular_stated(cell);
        }
    }

    /// Finds the columns of wavelengths and which of them each other column belongs to.
    void take_wavelengths() {
        std::vector<std::size_t> found;
        for (std::size_t c = 0; c < columns_.names.size(); ++c) {
            if (is_abscissa_name(header(c))) found.push_back(c);
        }
        if (found.empty()) found = every_other_column(columns_);
        if (found.empty()) found.push_back(0);
        for (const std::size_t c : found) {
            plan_.columns[c].role = ColumnRole::wavelength;
            plan_.columns[c].abscissa = abscissa_of(c);
        }
        keep_one_of_neighbours(found);
        plan_.first_wavelength = found.front();
        for (const std::size_t c : found) {
            refuse_unusable(plan_.columns[c].abscissa, plan_.columns[c].abscissa.named_by_unit || !statements_.abscissa
                                                           ? header_place()
                                                           : statements_.abscissa_where);
        }
        for (std::size_t c = 0; c < columns_.width; ++c) {
            const auto behind = std::ranges::find_if(found, [c](std::size_t w) { return w > c; });
            plan_.columns[c].wavelength = behind == found.begin() ? found.front() : *std::prev(behind);
        }
    }

    [[nodiscard]] Abscissa abscissa_of(std::size_t c) const {
        const std::optional<Abscissa> named = abscissa_stated(header(c));
        const std::optional<Abscissa>& stated = statements_.abscissa;
        const bool contradict =
            named && stated && named->named_by_unit && stated->named_by_unit && named->name != stated->name;
        if (contradict) {
            throw InputError({.where = header_place(),
                              .problem = fmt::format("its wavelengths are in {}", named->name),
                              .why = fmt::format("{} states {}", statements_.abscissa_where, stated->name),
                              .remedy = "correct one of the two, or delete it"});
        }
        if (named && (named->named_by_unit || !named->unusable.empty() || !stated)) return *named;
        return stated.value_or(Abscissa{.name = "nm"});
    }

    /// Of columns of wavelengths side by side, as nm and 1/cm of one spectrum, the one in nm stays, else the first.
    void keep_one_of_neighbours(std::vector<std::size_t>& found) {
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < found.size();) {
            std::size_t end = i + 1;
            while (end < found.size() && found[end] == found[end - 1] + 1) ++end;
            std::size_t best = i;
            for (std::size_t k = i; k < end; ++k) {
                if (plan_.columns[found[k]].abscissa.is_nm() && !plan_.columns[found[best]].abscissa.is_nm()) best = k;
            }
            for (std::size_t k = i; k < end; ++k) {
                if (k != best) leave_out(found[k], "it is the axis of the spectra in another unit");
            }
            const bool has_values = found[end - 1] + 1 < columns_.width || kept.empty();
            if (has_values) {
                kept.push_back(found[best]);
            } else {
                leave_out(found[best], "no values stand behind it");
            }
            i = end;
        }
        found = kept;
    }

    void take_counters() {
        bool names_values = false;
        for (std::size_t c = 0; c < columns_.names.size(); ++c) {
            const bool names = is(c, ColumnRole::value) && is_name_of_values(header(c)) && !is_bound(header(c));
            names_values = names_values || (names && !uncertainty_named(header(c)));
        }
        for (std::size_t c = 0; c < columns_.names.size(); ++c) {
            if (!is(c, ColumnRole::value)) continue;
            const bool in_front = c < plan_.first_wavelength;
            const bool holds_words = in_front && columns_.first > c;
            if (holds_words || (in_front ? is_label_in_front(header(c)) : counts_readings(header(c)))) {
                leave_out(c, "it counts or names the readings");
            } else if (is_condition(header(c)) || (names_values && counts_repeats(header(c)))) {
                leave_out(c, "it says how the readings were taken");
            } else if (names_values && is_bound(header(c))) {
                leave_out(c, "it is a bound of other values");
            }
        }
    }

    void take_quantities() {
        bool letters = true;
        for (std::size_t c = 0; c < columns_.names.size(); ++c) {
            if (is(c, ColumnRole::value) && is_single_letter(header(c)) && !uncertainty_named(header(c))) {
                letters = letters && is_quantity_letter(header(c));
            }
        }
        for (std::size_t c = 0; c < columns_.width; ++c) {
            PlannedColumn& column = plan_.columns[c];
            if (column.role != ColumnRole::value) continue;
            const bool by_letter = letters && is_single_letter(header(c));
            column.states = by_letter ? values_stated_by_letter(header(c)) : values_stated(header(c));
            column.specular = specular_stated(header(c));
            if (!column.specular) column.specular = specular_stated(column.name);
            take_title_statements(c);
            std::string words = column.states.unusable;
            std::string where = header_place();
            if (words.empty() && !column.states.quantity && !uncertainty_named(header(c))) {
                words = statements_.values.unusable;
                if (!words.empty()) where = statements_.values_where;
            }
            if (words.empty()) continue;
            leave_out(c, fmt::format("{} is neither reflectance nor transmittance as fraction or percent ({})",
                                     in_quotes(words), where));
            column.is_other_quantity = true;
        }
        take_raw_neighbours();
    }

    /// Beside a column that is called a reflectance or transmittance stand the signals that it was made of.
    void take_raw_neighbours() {
        const bool named = std::ranges::any_of(plan_.columns, [](const PlannedColumn& column) {
            return column.role == ColumnRole::value && column.states.quantity.has_value();
        });
        for (std::size_t c = 0; c < columns_.names.size(); ++c) {
            const bool raw = (named && is_raw_beside_quantity(header(c))) || is_raw_of_jaz(columns_.names, c);
            if (!is(c, ColumnRole::value) || !raw) continue;
            leave_out(c, "beside a reflectance or transmittance it is a raw signal");
            plan_.columns[c].is_other_quantity = true;
        }
    }

    void tell_unused() {
        constexpr std::size_t most = 5;
        std::map<std::string, std::vector<std::string>> by_reason;
        for (std::size_t c = 0; c < columns_.width; ++c) {
            const PlannedColumn& column = plan_.columns[c];
            if (column.role != ColumnRole::unused) continue;
            by_reason[column.is_other_quantity ? "neither reflectance nor transmittance" : column.reason].push_back(
                header(c).empty() ? fmt::format("column {}", c + 1) : in_quotes(header(c)));
        }
        for (auto& [reason, names] : by_reason) {
            const std::size_t more = names.size() > most ? names.size() - most : 0;
            names.resize(names.size() - more);
            plan_.remarks.push_back(fmt::format("left out: {}{} ({})", fmt::join(names, ", "),
                                                more > 0 ? fmt::format(" and {} more", more) : "", reason));
        }
    }

    const Columns& columns_;
    const FileStatements& statements_;
    TablePlan plan_{};
};

}  // namespace

TablePlan plan_table(const Columns& columns, const FileStatements& statements) {
    return Planner(columns, statements).plan();
}

}  // namespace skinfit
