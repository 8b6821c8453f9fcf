#include "measurements/unit_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

UnitFinding stated(Unit unit, std::string_view by) {
    return {.unit = unit, .rule = fmt::format("{}: stated by {}", unit == Unit::percent ? "percent" : "fraction", by)};
}

}  // namespace

UnitFinding find_unit(const UnitStatements& statements, std::span<const double> values) {
    assert(!values.empty());
    if (statements.option) return stated(*statements.option, "the option");
    if (statements.comment) return stated(*statements.comment, "a comment in the file");
    static const std::string most_exceed =
        fmt::format("percent: half of the values or more exceed {}", largest_fraction);
    static const std::string few_exceed = fmt::format("fraction: most values are at most {}", largest_fraction);
    const std::optional<Unit> named = statements.named ? statements.named : values_stated(statements.header).unit;
    if (named) return stated(*named, "the header");
    const auto exceeding = std::ranges::count_if(values, [](double value) { return value > largest_fraction; });
    if (2 * static_cast<std::size_t>(exceeding) >= values.size()) return {.unit = Unit::percent, .rule = most_exceed};
    if (!statements.percent_in.empty()) {
        return {.unit = Unit::percent,
                .rule = fmt::format("percent: one unit for a table, and {} is in percent",
                                    in_quotes(statements.percent_in))};
    }
    return {.unit = Unit::fraction, .rule = few_exceed};
}

bool shows_percent(std::span<const double> values) {
    std::size_t all = 0;
    std::size_t exceeding = 0;
    std::size_t beyond = 0;
    for (const double value : values) {
        if (std::isnan(value)) continue;
        ++all;
        if (value > largest_fraction) ++exceeding;
        if (value > 100 * largest_fraction) ++beyond;
    }
    return all > 0 && 2 * exceeding >= all && 2 * beyond <= all;
}

}  // namespace skinfit
