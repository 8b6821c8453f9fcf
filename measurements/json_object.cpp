#include "measurements/json_object.hpp"

#include <cmath>

#include "core/input_error.hpp"

namespace skinfit {

void refuse_json(const JsonObject& object, std::string_view name, const Json& value, const std::string& why) {
    throw InputError({.where = fmt::format("{}: {}", object.where, name),
                      .problem = fmt::format("{} cannot be used", shown(value)),
                      .why = why,
                      .remedy = fmt::format("correct it; {}", json_example)});
}

std::optional<double> number(const JsonObject& object, std::string_view name, const Range& range) {
    const Json* const value = object.find(name);
    if (value == nullptr) return std::nullopt;
    const double found = value->is_number() ? value->get<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!range.contains(found)) {
        refuse_json(object, name, *value, fmt::format("a number from {} to {} is needed", range.lowest, range.highest));
    }
    return found;
}

std::string text(const JsonObject& object, std::string_view name) {
    const Json* const value = object.find(name);
    if (value == nullptr) return {};
    if (!value->is_string()) refuse_json(object, name, *value, "text is needed");
    return value->get<std::string>();
}

/// NaN stands for null and for numbers that stand for missing ones.
std::vector<double> numbers(const JsonObject& object, std::string_view name, const Json& array) {
    if (!array.is_array() || array.empty()) refuse_json(object, name, array, "a list of numbers is needed");
    std::vector<double> found;
    found.reserve(array.size());
    for (const Json& element : array) {
        if (!element.is_number() && !element.is_null())
            refuse_json(object, name, element, "a number or null is needed");
        found.push_back(element.is_null() ? std::numeric_limits<double>::quiet_NaN() : element.get<double>());
    }
    return found;
}

std::vector<double> numbers(const JsonObject& object, std::string_view name, std::size_t count) {
    const Json* const array = object.find(name);
    if (array == nullptr) return {};
    std::vector<double> found = numbers(object, name, *array);
    if (found.size() == count) return found;
    refuse_json(object, name, *array, fmt::format("it has {} numbers for {} wavelengths", found.size(), count));
}

std::optional<double> positive(const JsonObject& object, std::string_view name, double upto) {
    const Json* const value = object.find(name);
    if (value == nullptr) return std::nullopt;
    const double found = value->is_number() ? value->get<double>() : 0.0;
    if (!(found > 0.0 && found <= upto)) {
        const std::string most = std::isfinite(upto) ? fmt::format(" and at most {}", upto) : "";
        refuse_json(object, name, *value, fmt::format("a number above 0{} is needed", most));
    }
    return found;
}

}  // namespace skinfit
