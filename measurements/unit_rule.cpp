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
    if (header.find('%') != std::string::npos || header.find("percent") != std::string::npos) {
        return stated(Unit::percent, "the header");
    }
    const double largest = *std::ranges::max_element(values);
    if (largest > largest_fraction) {
        return {.unit = Unit::percent,
                .rule = fmt::format("percent: largest value {:.6g} exceeds {}", largest, largest_fraction)};
    }
    return {.unit = Unit::fraction,
            .rule = fmt::format("fraction: largest value {:.6g} is at most {}", largest, largest_fraction)};
}

}  // namespace skinfit
