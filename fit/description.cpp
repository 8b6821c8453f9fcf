#include "fit/description.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "core/vocabulary.hpp"
#include "fit/physiological_priors.hpp"
#include "fit/settings.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

std::string with_unit(std::string_view text, std::string_view unit) {
    return unit.empty() ? std::string(text) : fmt::format("{} {}", text, unit);
}

std::string row(std::string_view label, std::string_view text) {
    return fmt::format("  {:<14}{}\n", label, text);
}

std::string range_row(std::string_view label, double from, double to, std::string_view unit,
                      std::string_view remark = "") {
    const std::string range = with_unit(fmt::format("{:g} to {:g}", from, to), unit);
    return row(label, remark.empty() ? range : fmt::format("{}  {}", range, remark));
}

std::string parameter_description(const ParameterInfo& info) {
    std::string text = fmt::format("{}: parameter\n  {}\n", info.name, info.meaning);
    const double preset = value_of(default_configuration().values, info.parameter);
    text += row("default", with_unit(fmt::format("{:g}", preset), info.unit));
    text += range_row("fit bounds", info.lower, info.upper, info.unit, info.source);
    text += range_row("limits", info.lowest, info.highest, info.unit);
    const std::optional<PhysiologicalPrior> known = known_of(info.parameter);
    if (known && known->healthy) {
        text += range_row("healthy skin", known->healthy->lower, known->healthy->upper, info.unit, known->source);
    }
    return text;
}

std::string setting_description(const Setting& setting) {
    std::string text = fmt::format("{}: setting\n  {}\n", setting.name, setting.meaning);
    text += row("default", setting.write(default_configuration()).dump());
    text += row("takes", setting.schema.dump());
    return text;
}

std::string word_description(const Word& word) {
    std::string text = fmt::format("{}: word of files and outputs\n  {}\n", word.name, word.meaning);
    if (!word.unit.empty()) text += row("unit", word.unit);
    return text;
}

std::vector<std::string_view> all_names() {
    std::vector<std::string_view> names;
    for (const ParameterInfo& info : parameter_table()) names.push_back(info.name);
    for (const Setting& setting : setting_table()) names.push_back(setting.name);
    for (const Word& word : vocabulary()) names.push_back(word.name);
    return names;
}

/// A question for the first that holds `name` as a part, else for the most similar one; none where all are too
/// different.
std::string did_you_mean(std::string_view name) {
    const std::vector<std::string_view> names = all_names();
    const auto holding =
        std::ranges::find_if(names, [&](std::string_view each) { return each.find(name) != std::string_view::npos; });
    const auto meant = holding != names.end() ? std::optional(*holding) : similar_name(name, names);
    return meant ? fmt::format("did you mean \"{}\"? ", *meant) : "";
}

}  // namespace

std::string description(std::string_view asked) {
    const std::string name = lower_case(asked);  // reports write some words in capitals
    if (const std::optional<Parameter> parameter = find_parameter(name)) return parameter_description(info(*parameter));
    const auto setting = std::ranges::find(setting_table(), name, &Setting::name);
    if (setting != setting_table().end()) return setting_description(*setting);
    const auto word = std::ranges::find(vocabulary(), name, &Word::name);
    if (word != vocabulary().end()) return word_description(*word);
    throw InputError({.where = "describe",
                      .problem = fmt::format("unknown name \"{}\"", asked),
                      .why = "neither a parameter, nor a setting, nor a word of the outputs",
                      .remedy = did_you_mean(name) + "`skinfit describe` lists parameters and settings"});
}

std::string descriptions() {
    std::string text = "parameters:\n";
    for (const ParameterInfo& info : parameter_table()) {
        text += fmt::format("  {:<34}{}\n", info.name,
                            with_unit(info.meaning, info.unit.empty() ? "" : fmt::format("({})", info.unit)));
    }
    text += "settings:\n";
    for (const Setting& setting : setting_table()) text += fmt::format("  {:<34}{}\n", setting.name, setting.meaning);
    return text;
}

}  // namespace skinfit
