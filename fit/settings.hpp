#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.hpp"
#include "core/json.hpp"
#include "fit/configuration.hpp"

namespace skinfit {

/// One setting of the configuration: the one place that knows its name, form and meaning.
struct Setting {
    std::string_view name;     ///< JSON key, and key of `--set`
    std::string_view meaning;  ///< one line for help texts and the schema
    Json schema;               ///< JSON Schema of its value
    /// Takes the value from JSON; throws InputError naming `where`.
    std::function<void(Configuration&, const Json&, const std::string& where)> read;
    std::function<Json(const Configuration&)> write;
};

/// Of the setting `noise`, and of that of an instrument, fraction.
inline constexpr Range noise_range{1e-6, 1};

/// All settings but the parameters, in the order in which they are shown.
[[nodiscard]] std::span<const Setting> setting_table();

/// Throws InputError: `where`: `value` cannot be used.
[[noreturn]] void refuse(const std::string& where, const Json& value, const std::string& why,
                         const std::string& remedy);

/// The number in `value`. Throws InputError where it is none or out of range.
[[nodiscard]] double read_number(const Json& value, const Range& range, const std::string& where);

/// The whole number in `value`. Throws InputError where it is none or out of range.
[[nodiscard]] std::uint64_t read_count(const Json& value, std::uint64_t lowest, std::uint64_t highest,
                                       const std::string& where);

/// Which of `names` `value` is. Throws InputError where it is none of them, naming the nearest.
[[nodiscard]] std::size_t read_choice(const Json& value, std::span<const std::string_view> names,
                                      const std::string& where);

}  // namespace skinfit
