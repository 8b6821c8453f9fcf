#include "measurements/table_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/input_error.hpp"
#include "measurements/cells.hpp"
#include "measurements/column_words.hpp"
#include "measurements/uncertainty_name.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

class Planner {
public:
    Planner(const Columns& columns, const FileStatements& statements) : columns_(columns), statements_(statements) {
        plan_.columns.resize(columns.width);
        plan_.remarks = statements.remarks;
        for (std::size_t c = 0; c < columns.names.size(); ++c) plan_.columns[c].name = columns.names[c];
    }

    TablePlan plan() {
        take_titles();
        take_wavelengths();
        take_counters();
        take_quantities();
        take_uncertainties();
        for (const PlannedColumn& column : plan_.columns) plan_.values += column.role == ColumnRole::value ? 1 : 0;
        tell_unused();
        return std::move(plan_);
    }

private:
    [[nodiscard]] std::string_view header(std::size_t c) const {
        return columns_.names.empty() ? std::string_view{} : std::string_view(columns_.names[c]);
    }
    [[nodiscard]] std::string header_place() const {
        return columns_.header_line > 0 ? at_line(columns_, columns_.header_line) : columns_.source;
    }
    [[nodiscard]] bool is(std::size_t c, ColumnRole role) const { return plan_.columns[c].role == role; }
    void leave_out(std::size_t c, std::string reason) {
        plan_.columns[c].role = ColumnRole::unused;
        plan_.columns[c].reason = std::move(reason);
    }

    /// The line above the header names what its columns repeat: `forearm,,cheek,,` over `Wavelength,%R,Wavelength,%R`.
    void take_titles() {
        std::map<std::string_view, std::size_t> count;
        for (const std::string& name : columns_.names) ++count[name];
        if (columns_.preamble.empty() || columns_.preamble.back().line + 1 != columns_.header_line) return;
        CellCutter cutter(columns_.separator);
        const std::span<const std::string_view> cells = cutter.cut(columns_.preamble.back().text);
        if (columns_.separator == ' ' || cells.size() < 2 || filled_width(cells) > columns_.width) return;
        std::string title;
        std::map<std::string, std::size_t> used;
        for (std::size_t c = 0; c < columns_.names.size(); ++c) {
            if (c < cells.size() && !cells[c].empty()) title = unescaped(cells[c]);
            if (is_abscissa_name(columns_.names[c]) || title.empty() || count[columns_.names[c]] < 2) continue;
            const bool taken = ++used[title] > 1;
            plan_.columns[c].name = taken ? fmt::format("{} {}", title, columns_.names[c]) : title;
        }
    }

    /// Finds the columns of wavelengths and which of them each other column belongs to.
    void take_wavelengths() {
        std::vector<std::size_t> found;
        for (std::size_t c = 0; c < columns_.names.size(); ++c) {
            if (is_abscissa_name(header(c))) found.push_back(c);
        }
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
        for (std::size_t c = 0; c < columns_.names.size(); ++c) {
            if (!is(c, ColumnRole::value)) continue;
            const bool in_front = c < plan_.first_wavelength;
            if (in_front ? is_label_in_front(header(c)) : counts_readings(header(c))) {
                leave_out(c, "it counts or names the readings");
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

    struct Uncertainty {
        std::size_t column;
        UncertaintyName name;
    };

    void take_uncertainties() {
        std::vector<Uncertainty> all;
        std::map<int, std::size_t> nameless;  // of each rank, the columns that name no column
        for (std::size_t c = 0; c < columns_.names.size(); ++c) {
            const auto named = is(c, ColumnRole::value) ? uncertainty_named(header(c)) : std::nullopt;
            if (!named) continue;
            if (!named->is_standard) {
                leave_out(c, "it is no standard uncertainty in the unit of the values");
                continue;
            }
            plan_.columns[c].role = ColumnRole::sigma;
            if (named->base.empty()) ++nameless[named->rank];
            all.push_back({.column = c, .name = *named});
        }
        std::vector<std::size_t> values;
        std::map<std::string, std::vector<std::size_t>> by_base;
        for (std::size_t c = 0; c < columns_.width && !all.empty(); ++c) {
            if (!is(c, ColumnRole::value)) continue;
            values.push_back(c);
            by_base[plain_base(header(c))].push_back(c);
        }
        std::map<std::size_t, std::vector<const Uncertainty*>> of_value;
        for (const Uncertainty& each : all) {
            const auto named = by_base.find(each.name.base);
            const bool by_name = !each.name.base.empty() && named != by_base.end();
            for (const std::size_t value :
                 by_name ? named->second : owners_by_place(each, values, nameless[each.name.rank] == 1)) {
                if (plan_.columns[each.column].wavelength == plan_.columns[value].wavelength) {
                    of_value[value].push_back(&each);
                }
            }
        }
        for (const auto& [value, uncertainties] : of_value) plan_.columns[value].sigma = best_of(uncertainties);
        for (const Uncertainty& each : all) {
            const bool used = std::ranges::any_of(
                of_value, [&](const auto& owned) { return plan_.columns[owned.first].sigma == each.column; });
            if (!used && !values.empty()) leave_out(each.column, "it is the uncertainty of no column that is read");
        }
    }

    /// The columns that uncertainties belong to which name none of them: the one before; or, alone of their kind and at
    /// an end of the table, all.
    [[nodiscard]] static std::vector<std::size_t> owners_by_place(const Uncertainty& each,
                                                                  const std::vector<std::size_t>& values,
                                                                  bool is_alone) {
        const auto behind = std::ranges::upper_bound(values, each.column);
        const bool names_another = !each.name.base.empty();
        if (names_another && (values.size() != 1 || each.column != values.front() + 1)) return {};
        if (is_alone && (behind == values.begin() || behind == values.end())) return values;
        return behind == values.begin() ? std::vector<std::size_t>{} : std::vector{*std::prev(behind)};
    }

    [[nodiscard]] std::size_t best_of(const std::vector<const Uncertainty*>& uncertainties) const {
        const auto weight = [](const Uncertainty* each) {
            return each->name.rank + (each->name.base.empty() ? 100 : 0);
        };
        const auto best = std::ranges::min_element(uncertainties, {}, weight);
        for (auto other = std::next(best); other != uncertainties.end(); ++other) {
            if (weight(*other) != weight(*best)) continue;
            const std::string_view one = header((*best)->column);
            const std::string_view two = header((*other)->column);
            throw InputError({.where = header_place(),
                              .problem = one == two ? fmt::format("2 columns are called {}", in_quotes(one))
                                                    : fmt::format("{} and {} are both uncertainties of one column",
                                                                  in_quotes(one), in_quotes(two)),
                              .why = "the uncertainty of the values must be one of them",
                              .remedy = "give every column a name of its own"});
        }
        return (*best)->column;
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
