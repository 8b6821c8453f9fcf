#include "measurements/table_uncertainties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "core/input_error.hpp"
#include "measurements/uncertainty_name.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

struct ColumnUncertainty {
    std::size_t column;
    UncertaintyName name;
};

class Uncertainties {
public:
    Uncertainties(TablePlan& plan, const std::string& where) : plan_(plan), where_(where) {}

    void take() {
        std::vector<ColumnUncertainty> all;
        for (std::size_t c = 0; c < plan_.columns.size(); ++c) {
            if (plan_.columns[c].role != ColumnRole::value) continue;
            const std::optional<UncertaintyName> named = named_by(c);
            if (!named) continue;
            if (!named->is_standard) {
                plan_.columns[c].leave_out("it is no standard uncertainty in the unit of the values");
                continue;
            }
            plan_.columns[c].role = ColumnRole::sigma;
            all.push_back({.column = c, .name = *named});
        }
        std::vector<std::size_t> values;
        std::map<std::string, std::vector<std::size_t>> by_base;
        for (std::size_t c = 0; c < plan_.columns.size() && !all.empty(); ++c) {
            if (plan_.columns[c].role != ColumnRole::value) continue;
            values.push_back(c);
            by_base[plain_base(plan_.columns[c].header)].push_back(c);
        }
        std::map<std::size_t, std::vector<const ColumnUncertainty*>> of_value;
        for (const ColumnUncertainty& each : all) {
            const auto named = by_base.find(each.name.base);
            const bool by_name = !each.name.base.empty() && named != by_base.end();
            for (const std::size_t value : by_name ? named->second : owners_by_place(each, values, all)) {
                if (plan_.columns[each.column].wavelength == plan_.columns[value].wavelength) {
                    of_value[value].push_back(&each);
                }
            }
        }
        for (const auto& [value, uncertainties] : of_value) plan_.columns[value].sigma = best_of(uncertainties);
        for (const ColumnUncertainty& each : all) {
            const bool used = std::ranges::any_of(
                of_value, [&](const auto& owned) { return plan_.columns[owned.first].sigma == each.column; });
            if (!used && !values.empty())
                plan_.columns[each.column].leave_out("it is the uncertainty of no column that is read");
        }
    }

    /// What its header says; also `sigmaR` or `uR` beside a column R.
    [[nodiscard]] std::optional<UncertaintyName> named_by(std::size_t c) const {
        if (const auto named = uncertainty_named(plan_.columns[c].header)) return named;
        for (const PlannedColumn& column : plan_.columns) {
            if (column.role != ColumnRole::value) continue;
            const std::string base = plain_base(column.header);
            if (const auto named = uncertainty_glued_to(base, plan_.columns[c].header)) return named;
        }
        return std::nullopt;
    }

    /// The columns that uncertainties belong to which name none of them: the one before; or, alone of their kind and at
    /// an end of the table, all; or, as many as the columns of values and behind all of them, one after the other.
    [[nodiscard]] static std::vector<std::size_t> owners_by_place(const ColumnUncertainty& each,
                                                                  const std::vector<std::size_t>& values,
                                                                  const std::vector<ColumnUncertainty>& all) {
        const bool names_another = !each.name.base.empty();
        if (names_another && (values.size() != 1 || each.column != values.front() + 1)) return {};
        std::vector<std::size_t> alike;  // in name
        for (const ColumnUncertainty& other : all) {
            if (other.name.base.empty() && other.name.rank == each.name.rank) alike.push_back(other.column);
        }
        const auto behind = std::ranges::upper_bound(values, each.column);
        if (alike.size() == 1 && (behind == values.begin() || behind == values.end())) return values;
        if (!alike.empty() && alike.size() == values.size() && alike.front() > values.back()) {
            return {values[static_cast<std::size_t>(std::ranges::find(alike, each.column) - alike.begin())]};
        }
        return behind == values.begin() ? std::vector<std::size_t>{} : std::vector{*std::prev(behind)};
    }

    [[nodiscard]] std::size_t best_of(const std::vector<const ColumnUncertainty*>& uncertainties) const {
        const auto weight = [](const ColumnUncertainty* each) {
            return each->name.rank + (each->name.base.empty() ? 100 : 0);
        };
        const auto best = std::ranges::min_element(uncertainties, {}, weight);
        for (auto other = std::next(best); other != uncertainties.end(); ++other) {
            if (weight(*other) != weight(*best)) continue;
            const std::string_view one = plan_.columns[(*best)->column].header;
            const std::string_view two = plan_.columns[(*other)->column].header;
            throw InputError({.where = where_,
                              .problem = one == two ? fmt::format("2 columns are called {}", in_quotes(one))
                                                    : fmt::format("{} and {} are both uncertainties of one column",
                                                                  in_quotes(one), in_quotes(two)),
                              .why = "the uncertainty of the values must be one of them",
                              .remedy = "give every column a name of its own"});
        }
        return (*best)->column;
    }

    TablePlan& plan_;
    const std::string& where_;
};

}  // namespace

void take_uncertainties(TablePlan& plan, const std::string& where) {
    Uncertainties(plan, where).take();
}

}  // namespace skinfit
