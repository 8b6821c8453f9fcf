#include "core/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "core/input_error.hpp"
#include "core/utf8.hpp"

namespace skinfit {
namespace {

/// Watches a file of JSON while it is read.
class Watcher {
public:
    Watcher(const std::string& where, Texts texts) : where_(where), texts_(texts) {}

    bool operator()(int depth, Json::parse_event_t event, Json& json) {
        constexpr int deepest = 64;
        if (depth > deepest) refuse(fmt::format("nests more than {} deep", deepest), "no file of ours is so deep");
        if (event == Json::parse_event_t::object_start) names_.emplace_back();
        if (event == Json::parse_event_t::object_end) names_.pop_back();
        if (event == Json::parse_event_t::key) take(json);
        if (event == Json::parse_event_t::value && json.is_string() && texts_ == Texts::printable) {
            json = printable(json.get_ref<const std::string&>());
        }
        return true;
    }

private:
    void take(const Json& name) {
        constexpr std::size_t most = 1000;
        std::set<std::string>& names = names_.back();
        if (printable(name.get_ref<const std::string&>()) != name.get_ref<const std::string&>()) {
            refuse(fmt::format("has a name with control characters, {}", shown(name)), "no name of ours has any");
        }
        if (!names.insert(name.get<std::string>()).second) {
            throw InputError({.where = where_,
                              .problem = fmt::format("gives {} twice", shown(name)),
                              .why = "only one of them could hold",
                              .remedy = "keep one of the two"});
        }
        if (names.size() > most) refuse(fmt::format("has more than {} names in one object", most), "it is no list");
    }

    [[noreturn]] void refuse(const std::string& problem, const std::string& why) const {
        throw InputError(
            {.where = where_, .problem = problem, .why = why, .remedy = "check that this is the right file"});
    }

    const std::string& where_;
    Texts texts_;
    std::vector<std::set<std::string>> names_;  ///< of each object that is open
};

}  // namespace

std::string shown(const Json& json) {
    constexpr std::size_t longest = 60;
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

Json parsed_json(std::string_view text, const std::string& where, const std::string& example, Texts texts) {
    try {
        Watcher watcher(where, texts);
        return Json::parse(text, std::ref(watcher), true, true);
    } catch (const Json::parse_error& error) {
        const auto line = 1 + std::ranges::count(text.substr(0, std::max<std::size_t>(error.byte, 1) - 1), '\n');
        // "[...] parse error at ...: syntax error while parsing ... - what was found; what was expected"
        const std::string words = error.what();
        const std::size_t found = words.rfind(" - ");
        const std::string cause = found == std::string::npos ? words : words.substr(found + 3);
        throw InputError({.where = fmt::format("{}:{}", where, line),
                          .problem = "is no JSON",
                          .why = cause.substr(0, cause.find(';')),
                          .remedy = "correct this line; " + example});
    } catch (const Json::exception&) {
        throw InputError({.where = where,
                          .problem = "holds a number that is too large",
                          .why = "it exceeds double precision",
                          .remedy = "correct it; " + example});
    }
}

}  // namespace skinfit
