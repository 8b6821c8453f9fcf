#include "fit/json_reading.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input_error.hpp"
#include "core/text.hpp"

namespace skinfit {
namespace {

/// The known key that `key` probably means: one of which it is a part, else the one the fewest edits away.
std::string_view closest(std::string_view key, const std::vector<std::string_view>& known) {
    const auto longer =
        std::ranges::find_if(known, [key](std::string_view name) { return name.find(key) != std::string_view::npos; });
    return longer != known.end() ? *longer : nearest_name(key, known);
}

}  // namespace

Json parsed_json(std::string_view text, const std::string& where, const std::string& example) {
    try {
        return Json::parse(text, nullptr, true, true);
    } catch (const Json::parse_error& error) {
        const auto line = 1 + std::ranges::count(text.substr(0, std::max<std::size_t>(error.byte, 1) - 1), '\n');
        // "[...] parse error at ...: syntax error while parsing ... - what was found; what was expected"
        const std::string words = error.what();
        const std::size_t found = words.rfind(" - ");
        const std::string why = found == std::string::npos ? words : words.substr(found + 3);
        throw InputError({.where = fmt::format("{}:{}", where, line),
                          .problem = "is no JSON",
                          .why = why.substr(0, why.find(';')),
                          .remedy = "correct this line; " + example});
    } catch (const Json::exception&) {
        throw InputError({.where = where,
                          .problem = "holds a number that is too large",
                          .why = "it exceeds double precision",
                          .remedy = "correct it; " + example});
    }
}

void refuse_unknown(const std::string& where, std::string_view key, const std::vector<std::string_view>& known) {
    if (key.empty()) {
        throw InputError({.where = where,
                          .problem = "a name is empty",
                          .why = "it says nothing",
                          .remedy = fmt::format("give names such as \"{}\"", known.front())});
    }
    throw InputError({.where = where,
                      .problem = fmt::format("unknown name {}", shown(std::string(key))),
                      .why = "it would have no effect",
                      .remedy = fmt::format("did you mean \"{}\"?", closest(key, known))});
}

void require_object(const Json& json, const std::string& where, const std::string& example) {
    if (json.is_object()) return;
    throw InputError({.where = where,
                      .problem = fmt::format("{} is no object", shown(json)),
                      .why = "keys and values are needed here",
                      .remedy = example});
}

}  // namespace skinfit
