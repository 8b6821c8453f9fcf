#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.hpp"
#include "core/json.hpp"
#include "measurements/words.hpp"

/// Takes the parts of a spectrum out of an object of JSON. All throw InputError that names the object and the name.
namespace skinfit {

inline constexpr std::string_view json_example = "`skinfit convert --format json` writes an example";

/// One object of the file, and how messages name it.
struct JsonObject {
    const Json& json;
    std::string where;

    [[nodiscard]] const Json* find(std::string_view name) const {
        const auto found = json.find(name);
        return found == json.end() || found->is_null() ? nullptr : &*found;
    }
};

/// Throws InputError: the value of `name` cannot be used, and why.
[[noreturn]] void refuse_json(const JsonObject& object, std::string_view name, const Json& value,
                              const std::string& why);

/// The number called `name`, within `range`; nothing where there is none.
[[nodiscard]] std::optional<double> number(const JsonObject& object, std::string_view name, const Range& range);

/// The text called `name`; empty where there is none.
[[nodiscard]] std::string text(const JsonObject& object, std::string_view name);

/// The numbers of a list; NaN stands for null.
[[nodiscard]] std::vector<double> numbers(const JsonObject& object, std::string_view name, const Json& array);

/// The list called `name`, of `count` numbers; empty where there is none.
[[nodiscard]] std::vector<double> numbers(const JsonObject& object, std::string_view name, std::size_t count);

/// The number called `name`, above 0 and at most `upto`; nothing where there is none.
[[nodiscard]] std::optional<double> positive(const JsonObject& object, std::string_view name,
                                             double upto = std::numeric_limits<double>::infinity());

/// What the word called `name` means: its place in `words`; nothing where there is none.
template <typename Meaning, std::size_t size>
std::optional<Meaning> word(const JsonObject& object, std::string_view name,
                            const std::array<std::string_view, size>& words) {
    const Json* const value = object.find(name);
    if (value == nullptr) return std::nullopt;
    const auto found = std::ranges::find(words, lower_case(text(object, name)));
    if (found == words.end()) {
        refuse_json(object, name, *value, fmt::format("it must be {}", fmt::join(words, " or ")));
    }
    return static_cast<Meaning>(found - words.begin());
}

}  // namespace skinfit
