#include "measurements/unit_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

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
    const std::string header = lower_case(statements.header);
    static const std::string most_exceed =
        fmt::format("percent: half of the values or more exceed {}", largest_fraction);
    static const std::string few_exceed = fmt::format("fraction: most values are at most {}", largest_fraction);
    if (header.find('%') != std::string::npos || header.find("percent") != std::string::npos) {
        return stated(Unit::percent, "the header");
    }
    const auto exceeding = std::ranges::count_if(values, [](double value) { return value > largest_fraction; });
    if (2 * static_cast<std::size_t>(exceeding) >= values.size()) return {.unit = Unit::percent, .rule = most_exceed};
    return {.unit = Unit::fraction, .rule = few_exceed};
}

}  // namespace skinfit
