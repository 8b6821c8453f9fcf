#include "fit/json_reading.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input_error.hpp"
#include "core/nearest_names.hpp"

namespace skinfit {
namespace {

/// What to do about an unknown `key`: those that it probably means, or all of a few, else an example.
std::string remedy_for(std::string_view key, const std::vector<std::string_view>& known, const std::string& example) {
    constexpr std::size_t few = 4;
    const std::vector<std::string_view> meant = meant_names(key, known);
    if (!meant.empty()) return fmt::format("did you mean {}?", either(meant));
    if (known.size() <= few) return fmt::format("give one of {}", fmt::join(known, ", "));
    return example;
}

}  // namespace

void refuse_unknown(const std::string& where, std::string_view key, const std::vector<std::string_view>& known,
                    const std::string& example) {
    if (key.empty()) {
        throw InputError({.where = where,
                          .problem = "a name is empty",
                          .why = "it says nothing",
                          .remedy = fmt::format("give names such as \"{}\"", known.front())});
    }
    throw InputError({.where = where,
                      .problem = fmt::format("unknown name {}", shown(std::string(key))),
                      .why = "it would have no effect",
                      .remedy = remedy_for(key, known, example)});
}

void require_object(const Json& json, const std::string& where, const std::string& example) {
    if (json.is_object()) return;
    throw InputError({.where = where,
                      .problem = fmt::format("{} is no object", shown(json)),
                      .why = "keys and values are needed here",
                      .remedy = example});
}

void require_names(const Json& json, const std::vector<std::string_view>& known, const RequiredNames& required,
                   const std::string& where) {
    require_object(json, where, required.example);
    for (const auto& [key, value] : json.items()) {
        if (std::ranges::find(known, key) == known.end()) refuse_unknown(where, key, known, required.example);
    }
    for (const std::string_view name : required.names) {
        if (json.contains(name)) continue;
        throw InputError({.where = where,
                          .problem = fmt::format("no \"{}\"", name),
                          .why = required.why,
                          .remedy = required.example});
    }
}

}  // namespace skinfit
