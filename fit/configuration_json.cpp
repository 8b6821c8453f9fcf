#include "fit/configuration_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fit/json_reading.hpp"
#include "fit/name_lists.hpp"

namespace skinfit {
namespace {

[[noreturn]] void refuse_misplaced(const std::string& where, std::string_view what, const std::string& remedy) {
    throw InputError({.where = where,
                      .problem = fmt::format("is {}", what),
                      .why = "settings and parameters have places of their own",
                      .remedy = remedy});
}

bool is_setting(std::string_view key) {
    return std::ranges::find(setting_table(), key, &Setting::name) != setting_table().end();
}

double read_value(const Json& value, const ParameterInfo& info, const std::string& where) {
    const bool good = value.is_number() && value.get<double>() >= info.lowest && value.get<double>() <= info.highest;
    if (good) return value.get<double>();
    throw InputError({.where = where,
                      .problem = fmt::format("{} cannot be used", shown(value)),
                      .why = value.is_number() ? "out of range" : "a number is needed",
                      .remedy = fmt::format("give a number from {} to {}{}{}", info.lowest, info.highest,
                                            info.unit.empty() ? "" : " ", info.unit)});
}

void read_parameter(Configuration& configuration, const ParameterInfo& info, const Json& json,
                    const std::string& where) {
    double& value = value_of(configuration.values, info.parameter);
    if (!json.is_object()) {
        value = read_value(json, info, where);
        return;
    }
    Bounds& bounds = configuration.bounds[static_cast<std::size_t>(info.parameter)];
    for (const auto& [key, entry] : json.items()) {
        const std::string here = fmt::format("{}.{}", where, key);
        if (key == "value") {
            value = read_value(entry, info, here);
        } else if (key == "lower") {
            bounds.lower = read_value(entry, info, here);
        } else if (key == "upper") {
            bounds.upper = read_value(entry, info, here);
        } else {
            refuse_unknown(where, key, {"value", "lower", "upper"});
        }
    }
    if (!(bounds.lower < bounds.upper)) {
        throw InputError(
            {.where = where,
             .problem = fmt::format("lower bound {} is not below upper bound {}", bounds.lower, bounds.upper),
             .why = "a fit needs room between them",
             .remedy = "exchange them, or fix the parameter"});
    }
}

void read_parameters(Configuration& configuration, const Json& json, const std::string& where) {
    require_object(json, where, "see `skinfit config show` for the form");
    for (const auto& [key, value] : json.items()) {
        const std::string here = fmt::format("{}.{}", where, key);
        const std::optional<Parameter> parameter = find_parameter(key);
        if (!parameter && is_setting(key)) {
            refuse_misplaced(here, "a setting", "move it out of \"parameters\"");
        }
        if (!parameter) refuse_unknown(where, key, parameter_names());
        read_parameter(configuration, info(*parameter), value, here);
    }
}

/// The value of "key=value": JSON where it reads as a number, null, a list or an object, else a number or a word.
Json assigned_value(std::string_view text, const std::string& where) {
    Json json = Json::parse(text, nullptr, false);
    if (json.is_number() || json.is_null() || json.is_structured()) return json;
    const std::optional<double> number = parse_number(text);
    if (number && std::isfinite(*number)) return *number;
    double ignored = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ignored);
    if (error == std::errc::result_out_of_range && end == text.data() + text.size()) {
        throw InputError({.where = where,
                          .problem = fmt::format("{} cannot be used", text),
                          .why = "it is beyond the range of double precision",
                          .remedy = "correct it; `skinfit config schema` has the limits"});
    }
    return std::string(text);
}

}  // namespace

Configuration with_freedom(Configuration configuration, std::string_view names, bool free, const std::string& where) {
    mark_parameters(configuration.free, names, free, where);
    return configuration;
}

Configuration with_own(Configuration configuration, std::string_view names, const std::string& where) {
    mark_parameters(configuration.own, names, true, where);
    mark_parameters(configuration.free, names, true, where);
    return configuration;
}

Configuration configured(Configuration configuration, const Json& json, const std::string& where) {
    require_object(json, where, "see `skinfit config show` for the form");
    if (json.contains("configuration")) {
        return configured(std::move(configuration), json["configuration"], where + ": configuration");
    }
    std::vector<std::string_view> known = {"free", "own", "parameters"};
    for (const Setting& setting : setting_table()) known.push_back(setting.name);
    if (json.contains("preset")) {  // all else stands on it
        std::ranges::find(setting_table(), "preset", &Setting::name)
            ->read(configuration, json["preset"], where + ": preset");
    }
    for (const auto& [key, value] : json.items()) {
        const std::string here = fmt::format("{}: {}", where, key);
        if (key == "preset") continue;
        const auto setting = std::ranges::find(setting_table(), key, &Setting::name);
        if (setting != setting_table().end()) {
            setting->read(configuration, value, here);
        } else if (key == "free") {
            read_parameters_list(configuration.free, value, here);
        } else if (key == "own") {
            read_parameters_list(configuration.own, value, here);
        } else if (key == "parameters") {
            read_parameters(configuration, value, here);
        } else if (find_parameter(key)) {
            refuse_misplaced(here, "a parameter", fmt::format(R"(write "parameters": {{"{}": ...}})", key));
        } else {
            refuse_unknown(where, key, known);
        }
    }
    return configuration;
}

Configuration configured_by_text(const Configuration& configuration, std::string_view text, const std::string& where) {
    return configured(configuration, parsed_json(text, where, "`skinfit config show` prints an example"), where);
}

Configuration configured_by_word(Configuration configuration, std::string_view key, std::string_view text,
                                 const std::string& where) {
    const Json value = assigned_value(text, where);
    if (const std::optional<Parameter> parameter = find_parameter(key)) {
        read_parameter(configuration, info(*parameter), value, where);
        return configuration;
    }
    if (key == "free" || key == "own") {
        Json names = value;  // as JSON, or as NAME,NAME
        if (value.is_string()) {
            names = Json::array();
            for (const std::string_view name : split(text, ',')) names.push_back(name);
        }
        read_parameters_list(key == "free" ? configuration.free : configuration.own, names, where);
        return configuration;
    }
    const auto setting = std::ranges::find(setting_table(), key, &Setting::name);
    if (setting == setting_table().end()) {
        std::vector<std::string_view> known = parameter_names();
        for (const Setting& each : setting_table()) known.push_back(each.name);
        known.insert(known.end(), {"free", "own"});
        refuse_unknown(where, key, known);
    }
    setting->read(configuration, value, where);
    return configuration;
}

Configuration configured_by_assignment(const Configuration& configuration, std::string_view assignment) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string_view::npos) {
        throw InputError({.where = fmt::format("--set {}", assignment),
                          .problem = "no \"=\"",
                          .why = "a key and a value are needed",
                          .remedy = "write it as in --set melanosome_fraction=0.1"});
    }
    const std::string_view key = trimmed(assignment.substr(0, equals));
    return configured_by_word(configuration, key, trimmed(assignment.substr(equals + 1)), fmt::format("--set {}", key));
}

Json to_json(const Configuration& configuration) {
    Json json;
    for (const Setting& setting : setting_table()) json[std::string(setting.name)] = setting.write(configuration);
    json["free"] = parameters_list_json(configuration.free);
    json["own"] = parameters_list_json(configuration.own);
    for (const ParameterInfo& info : parameter_table()) {
        const Bounds& bounds = configuration.bounds[static_cast<std::size_t>(info.parameter)];
        json["parameters"][std::string(info.name)] = {{"value", value_of(configuration.values, info.parameter)},
                                                      {"lower", bounds.lower},
                                                      {"upper", bounds.upper}};
    }
    return json;
}

Json to_json(const ResolvedConfiguration& configuration) {
    return to_json(as_stated(configuration));
}

Json configuration_schema() {
    Json properties;
    for (const Setting& setting : setting_table()) {
        Json property = setting.schema;
        property["description"] = setting.meaning;
        properties[std::string(setting.name)] = property;
    }
    properties["free"] = parameters_list_schema("the parameters a fit adjusts");
    properties["own"] = parameters_list_schema(
        "of the free parameters those that have a value of their own in each of several spectra");
    Json parameters;
    for (const ParameterInfo& info : parameter_table()) {
        const Json number = {{"type", "number"}, {"minimum", info.lowest}, {"maximum", info.highest}};
        const Json object = {{"type", "object"},
                             {"properties", {{"value", number}, {"lower", number}, {"upper", number}}},
                             {"additionalProperties", false}};
        parameters[std::string(info.name)] = {
            {"description",
             fmt::format("{}{}{}. Source: {}", info.meaning, info.unit.empty() ? "" : ", ", info.unit, info.source)},
            {"anyOf", {number, object}}};
    }
    properties["parameters"] = {{"type", "object"}, {"properties", parameters}, {"additionalProperties", false}};
    return {{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", "skinfit configuration"},
            {"type", "object"},
            {"properties", properties},
            {"additionalProperties", false}};
}

}  // namespace skinfit
