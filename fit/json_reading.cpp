#include "fit/json_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/input_error.hpp"
#include "core/text.hpp"

namespace skinfit {
namespace {

/// What to do about an unknown `key`: the known one of which it is a part or a misspelling, or all of a few.
std::string remedy_for(std::string_view key, const std::vector<std::string_view>& known) {
    constexpr std::size_t few = 4;
    constexpr std::size_t telling = 3;  // characters
    const auto longer =
        std::ranges::find_if(known, [key](std::string_view name) { return name.find(key) != std::string_view::npos; });
    if (longer != known.end() && key.size() >= telling) return fmt::format("did you mean \"{}\"?", *longer);
    if (const auto similar = similar_name(key, known)) return fmt::format("did you mean \"{}\"?", *similar);
    if (known.size() <= few) return fmt::format("give one of {}", fmt::join(known, ", "));
    return "see `skinfit config show` for the names";
}

}  // namespace

Json parsed_json(std::string_view text, const std::string& where, const std::string& example) {
    std::vector<std::set<std::string>> keys;  // of each object that is open
    const auto refuse_again = [&](int, Json::parse_event_t event, const Json& json) {
        if (event == Json::parse_event_t::object_start) keys.emplace_back();
        if (event == Json::parse_event_t::object_end) keys.pop_back();
        if (event == Json::parse_event_t::key && !keys.back().insert(json.get<std::string>()).second) {
            throw InputError({.where = where,
                              .problem = fmt::format("gives {} twice", shown(json)),
                              .why = "only one of them could hold",
                              .remedy = "keep one of the two"});
        }
        return true;
    };
    try {
        return Json::parse(text, refuse_again, true, true);
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
                      .remedy = remedy_for(key, known)});
}

void require_object(const Json& json, const std::string& where, const std::string& example) {
    if (json.is_object()) return;
    throw InputError({.where = where,
                      .problem = fmt::format("{} is no object", shown(json)),
                      .why = "keys and values are needed here",
                      .remedy = example});
}

}  // namespace skinfit
