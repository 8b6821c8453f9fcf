#include "measurements/json_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/input_error.hpp"
#include "measurements/uncertainty_name.hpp"
#include "measurements/value_statement.hpp"

namespace skinfit {
namespace {

constexpr double any_number = 1e15;  // frequencies in Hz are of this size

bool is_list(const Json& value) {
    return value.is_array() && !value.empty() && (value.front().is_number() || value.front().is_null());
}

bool names_values(std::string_view name) {
    return values_stated_by_letter(name).quantity.has_value() && !uncertainty_named(name);
}

/// The first list whose name is one of these; empty where there is none.
template <class Is>
std::string list_called(const JsonObject& object, const Is& is) {
    for (const auto& [name, value] : object.json.items()) {
        if (is_list(value) && is(name)) return name;
    }
    return {};
}

/// Throws InputError where the number called `name` is there and another than `found`.
void check_beside_list(const JsonObject& object, std::string_view name, const std::string& list, double found) {
    const std::optional<double> stated = number(object, name, {-any_number, any_number});
    if (!stated || std::abs(*stated - found) <= 1e-4 * std::max(std::abs(found), std::abs(*stated))) return;
    refuse_json(object, name, object.json[std::string(name)], fmt::format("by {} it is {:.6g}", list, found));
}

std::vector<double> equal_steps(const JsonObject& object, std::size_t count) {
    const std::optional<double> start = number(object, "start", {0, any_number});
    const std::optional<double> step = number(object, "step", {-any_number, any_number});
    if (!start || !step) {
        throw InputError({.where = object.where,
                          .problem = "has no wavelengths",
                          .why = "wavelength_nm, or start and step in nm, give them",
                          .remedy = fmt::format("add them; {}", json_example)});
    }
    std::vector<double> found;
    for (std::size_t i = 0; i < count; ++i) found.push_back(*start + *step * static_cast<double>(i));
    return found;
}

}  // namespace

JsonValues values_in(const JsonObject& object) {
    const bool both = object.find("values") != nullptr && object.find("value") != nullptr;
    std::string name = object.find("values") != nullptr ? "values" : "value";
    if (object.find(name) == nullptr) name = list_called(object, names_values);
    if (name.empty() || both) {
        throw InputError({.where = object.where,
                          .problem = both ? "has both value and values" : "has no values",
                          .why = "one list of numbers is needed, called value or values",
                          .remedy = fmt::format("correct it; {}", json_example)});
    }
    return {.name = name, .numbers = numbers(object, name, *object.find(name))};
}

JsonAbscissa abscissa_in(const JsonObject& object, std::size_t count) {
    std::string name =
        object.find("wavelength_nm") != nullptr ? "wavelength_nm" : list_called(object, is_abscissa_name);
    if (name.empty()) return {.numbers = equal_steps(object, count)};
    JsonAbscissa found{.numbers = numbers(object, name, count)};
    const std::optional<Abscissa> stated = abscissa_stated(name);
    if (name != "wavelength_nm" && stated && stated->named_by_unit) found.stated = stated;
    check_beside_list(object, "start", name, found.numbers.front());
    if (count > 1) check_beside_list(object, "step", name, found.numbers[1] - found.numbers[0]);
    return found;
}

JsonUncertainty uncertainty_in(const JsonObject& object, std::size_t count) {
    constexpr int of_errors = 3;  // which may be a count of them, or a code
    JsonUncertainty found;
    int rank = of_errors + 1;
    for (const auto& [name, value] : object.json.items()) {
        const std::optional<UncertaintyName> named = uncertainty_named(name);
        const bool is_number = value.is_number() && value.get<double>() > 0 && (name == "sigma" || name.size() > 1);
        const bool is_its_list = is_list(value) && (value.size() == count || name == "sigma");
        if (!named || !(is_its_list || (is_number && named->rank < of_errors))) continue;
        if (!named->is_standard) {
            found.remarks.push_back(fmt::format("{} is no standard uncertainty and is left out", in_quotes(name)));
            continue;
        }
        if (named->rank >= rank) continue;
        rank = named->rank;
        found.name = name;
        found.sigma = is_number ? std::vector<double>(count, value.get<double>()) : numbers(object, name, count);
    }
    for (double& sigma : found.sigma) {  // a large one may be meant: nothing is known there
        if (sigma < 0 && is_fill_number(sigma)) sigma = std::numeric_limits<double>::quiet_NaN();
    }
    return found;
}

bool is_taken_list(std::string_view name, const Json& value) {
    return (is_list(value) && (names_values(name) || is_abscissa_name(name))) ||
           (uncertainty_named(name) && (is_list(value) || value.is_number()));
}

}  // namespace skinfit
