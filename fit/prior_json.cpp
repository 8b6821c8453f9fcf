#include "fit/prior_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fit/json_reading.hpp"
#include "fit/physiological_priors.hpp"

namespace skinfit {
namespace {

/// One kind of prior: its two numbers and their ranges.
struct Form {
    std::string_view kind;
    std::string_view first;
    Range first_range;
    std::string_view second;
    Range second_range;
};

// Least beta exponents: the density must have its maximum inside.
constexpr Range beta_range{1.0 + 1e-6, 1e6};
constexpr std::array<Form, 3> forms = {{
    {"normal", "mean", {-1e6, 1e6}, "sigma", {1e-9, 1e6}},
    {"log_normal", "median", {1e-9, 1e6}, "sigma_log", {1e-6, 10.0}},
    {"beta", "a", beta_range, "b", beta_range},
}};
constexpr std::array<std::string_view, 4> kinds = {"normal", "log_normal", "beta", "uniform"};
constexpr std::array<std::string_view, 2> sets = {"uniform", "physiological"};

double required(const Json& value, std::string_view key, const Range& range, const std::string& where) {
    if (!value.contains(key)) {
        refuse(where, value, fmt::format("{} is missing", key), fmt::format("give {} too", key));
    }
    return read_number(value[std::string(key)], range, fmt::format("{}.{}", where, key));
}

void take_set(Configuration& configuration, const Json& word, const std::string& where) {
    const bool physiological = sets[read_choice(word, sets, where)] == "physiological";
    configuration.priors.fill(std::nullopt);
    configuration.derived_priors.fill(std::nullopt);
    if (!physiological) return;
    for (const PhysiologicalPrior& each : physiological_priors()) {
        configuration.priors[static_cast<std::size_t>(each.parameter)] = each.prior;
    }
    for (const PhysiologicalDerivedPrior& each : physiological_derived_priors()) {
        configuration.derived_priors[static_cast<std::size_t>(each.quantity)] = each.prior;
    }
}

std::optional<Prior>* prior_of(Configuration& configuration, std::string_view name) {
    if (const std::optional<Parameter> parameter = find_parameter(name)) {
        return &configuration.priors[static_cast<std::size_t>(*parameter)];
    }
    const auto row = std::ranges::find(derived_table(), name, &DerivedInfo::name);
    if (row == derived_table().end()) return nullptr;
    return &configuration.derived_priors[static_cast<std::size_t>(row - derived_table().begin())];
}

/// Kind and both numbers.
struct Plain {
    const Form* form;
    double first;
    double second;
};

Plain plain(const Prior& prior) {
    if (const auto* normal = std::get_if<NormalPrior>(&prior)) return {forms.data(), normal->mean, normal->sigma};
    if (const auto* log_normal = std::get_if<LogNormalPrior>(&prior)) {
        return {&forms[1], log_normal->median, log_normal->sigma_log};
    }
    const auto& beta = std::get<BetaPrior>(prior);
    return {&forms[2], beta.a, beta.b};
}

}  // namespace

std::vector<std::string_view> prior_names() {
    std::vector<std::string_view> names;
    for (const ParameterInfo& row : parameter_table()) names.push_back(row.name);
    for (const DerivedInfo& row : derived_table()) names.push_back(row.name);
    return names;
}

std::optional<Prior> read_prior(const Json& value, const std::string& where) {
    require_object(value, where, R"(write it as in {"kind": "normal", "mean": 0.5, "sigma": 0.1})");
    if (!value.contains("kind")) {
        refuse(where, value, "kind is missing", fmt::format("give one of {}", fmt::join(kinds, ", ")));
    }
    const std::size_t kind = read_choice(value["kind"], kinds, where + ".kind");
    const bool uniform = kind == forms.size();
    for (const auto& [key, entry] : value.items()) {
        if (key == "kind") continue;
        if (uniform) {
            throw InputError({.where = where,
                              .problem = fmt::format("unknown name \"{}\"", key),
                              .why = "a uniform prior has nothing to set",
                              .remedy = "set lower and upper under parameters for its limits"});
        }
        const std::vector<std::string_view> known = {"kind", forms[kind].first, forms[kind].second};
        if (std::ranges::find(known, key) == known.end()) refuse_unknown(where, key, known);
    }
    if (uniform) return std::nullopt;
    const Form& form = forms[kind];
    const double first = required(value, form.first, form.first_range, where);
    const double second = required(value, form.second, form.second_range, where);
    if (form.kind == "normal") return NormalPrior{.mean = first, .sigma = second};
    if (form.kind == "log_normal") return LogNormalPrior{.median = first, .sigma_log = second};
    return BetaPrior{.a = first, .b = second};
}

Json to_json(const Prior& prior) {
    const auto [form, first, second] = plain(prior);
    Json json = {{"kind", form->kind}};
    json[std::string(form->first)] = first;
    json[std::string(form->second)] = second;
    return json;
}

void read_priors(Configuration& configuration, const Json& value, const std::string& where) {
    if (value.is_string()) {
        take_set(configuration, value, where);
        return;
    }
    require_object(value, where, "give uniform, physiological, or names with priors");
    if (value.contains("set")) take_set(configuration, value["set"], where + ".set");
    for (const auto& [name, entry] : value.items()) {
        if (name == "set") continue;
        std::optional<Prior>* const prior = prior_of(configuration, name);
        if (prior == nullptr) refuse_unknown(where, name, prior_names());
        *prior = read_prior(entry, fmt::format("{}.{}", where, name));
    }
}

Json write_priors(const Configuration& configuration) {
    Json json = {{"set", "uniform"}};
    for (const std::string_view name : prior_names()) {
        Configuration copy = configuration;
        const std::optional<Prior>& prior = *prior_of(copy, name);
        if (prior) json[std::string(name)] = to_json(*prior);
    }
    return json;
}

Json priors_schema() {
    const auto number = [](const Range& range) {
        return Json{{"type", "number"}, {"minimum", range.lowest}, {"maximum", range.highest}};
    };
    Json choices = Json::array();
    choices.push_back({{"type", "object"},
                       {"properties", {{"kind", {{"enum", Json::array({"uniform"})}}}}},
                       {"required", Json::array({"kind"})},
                       {"additionalProperties", false}});
    for (const Form& form : forms) {
        Json properties = {{"kind", {{"enum", Json::array({form.kind})}}}};
        properties[std::string(form.first)] = number(form.first_range);
        properties[std::string(form.second)] = number(form.second_range);
        choices.push_back({{"type", "object"},
                           {"properties", properties},
                           {"required", {"kind", form.first, form.second}},
                           {"additionalProperties", false}});
    }
    Json properties = {{"set", {{"enum", sets}}}};
    for (const std::string_view name : prior_names()) properties[std::string(name)] = {{"anyOf", choices}};
    const Json object = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    return {{"anyOf", Json::array({Json{{"enum", sets}}, object})}};
}

std::string in_words(const Prior& prior) {
    const auto [form, first, second] = plain(prior);
    return fmt::format("{}, {} {:g}, {} {:g}", form->kind, form->first, first, form->second, second);
}

}  // namespace skinfit
