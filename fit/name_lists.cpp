#include "fit/name_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fit/json_reading.hpp"

namespace skinfit {
namespace {

bool has_sign(std::string_view name) {
    return name.starts_with('+') || name.starts_with('-');
}

/// The names of a list, each once.
std::vector<std::string> names_in(const Json& json, const std::string& where) {
    const bool is_list =
        json.is_array() && std::ranges::all_of(json, [](const Json& name) { return name.is_string(); });
    if (!is_list) {
        throw InputError({.where = where,
                          .problem = fmt::format("{} is no list of names", shown(json)),
                          .why = "names of parameters are needed here",
                          .remedy = "give names as in [\"melanosome_fraction\"]"});
    }
    return json.get<std::vector<std::string>>();
}

void check_signs(const std::vector<std::string>& names, const std::string& where) {
    const auto with_sign = static_cast<std::size_t>(std::ranges::count_if(names, has_sign));
    if (with_sign == 0 || with_sign == names.size()) return;
    throw InputError({.where = where,
                      .problem = "some names have a sign and others have none",
                      .why = "names alone are the whole list, +name and -name change the one that holds otherwise",
                      .remedy = "give all of them a sign, or none"});
}

Parameter named_parameter(std::string_view name, const std::string& where) {
    const std::optional<Parameter> parameter = find_parameter(name);
    if (!parameter) refuse_unknown(where, name, parameter_names());
    return *parameter;
}

}  // namespace

std::vector<std::string_view> parameter_names() {
    std::vector<std::string_view> names;
    for (const ParameterInfo& info : parameter_table()) names.push_back(info.name);
    return names;
}

void mark_parameters(ParameterMarks& marks, std::string_view names, bool value, const std::string& where) {
    for (std::string_view name : split(names, ',')) {
        if (value && name.starts_with('+')) name.remove_prefix(1);
        marks[static_cast<std::size_t>(named_parameter(name, where))] = value;
    }
}

void read_parameters_list(ParameterMarks& marks, const Json& json, const std::string& where) {
    const std::vector<std::string> names = names_in(json, where);
    check_signs(names, where);
    const bool changes = !names.empty() && has_sign(names.front());
    if (!changes) marks.fill(false);
    std::set<Parameter> named;
    for (const std::string& name : names) {
        const Parameter parameter = named_parameter(std::string_view(name).substr(changes ? 1 : 0), where);
        if (!named.insert(parameter).second) {
            throw InputError({.where = where,
                              .problem = fmt::format("names {} twice", info(parameter).name),
                              .why = "once is enough, and +name and -name contradict each other",
                              .remedy = "leave one of them out"});
        }
        marks[static_cast<std::size_t>(parameter)] = !name.starts_with('-');
    }
}

Json parameters_list_json(const ParameterMarks& marks) {
    Json names = Json::array();
    for (const ParameterInfo& info : parameter_table()) {
        if (marks[static_cast<std::size_t>(info.parameter)]) names.push_back(info.name);
    }
    return names;
}

Json parameters_list_schema(const std::string& meaning) {
    Json changes = Json::array();
    for (const std::string_view name : parameter_names()) {
        for (const char sign : {'+', '-'}) changes.push_back(sign + std::string(name));
    }
    const auto list_of = [](const Json& names) {
        return Json{{"type", "array"}, {"items", {{"enum", names}}}, {"uniqueItems", true}};
    };
    return {{"description", meaning + "; names alone are the whole list, +name and -name change the default"},
            {"anyOf", {list_of(parameter_names()), list_of(changes)}}};
}

}  // namespace skinfit
