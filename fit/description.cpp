#include "fit/description.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input_error.hpp"
#include "core/nearest_names.hpp"
#include "core/vocabulary.hpp"
#include "fit/physiological_priors.hpp"
#include "fit/preset.hpp"
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
    const double of_paper = value_of(default_configuration().values, info.parameter);
    const double of_skin = value_of(measured_configuration().values, info.parameter);
    const std::string other =
        of_skin == of_paper ? "" : fmt::format("; preset skin: {}", with_unit(fmt::format("{:g}", of_skin), info.unit));
    text += row("default", with_unit(fmt::format("{:g}", of_paper), info.unit) + other);
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
    const std::string of_paper = setting.write(default_configuration()).dump();
    const std::string of_skin = setting.write(measured_configuration()).dump();
    text += row("default", of_skin == of_paper ? of_paper : fmt::format("{}; preset skin: {}", of_paper, of_skin));
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
    for (const Word& label : labels()) names.push_back(label.name);
    return names;
}

std::string label_description(const Word& label) {
    std::string text = fmt::format("{}: label of reports\n  {}\n", label.name, label.meaning);
    if (!label.unit.empty()) text += row("unit", label.unit);
    return text;
}

const Word* word_called(std::span<const Word> words, std::string_view name) {
    const auto found = std::ranges::find(words, name, &Word::name);
    return found == words.end() ? nullptr : &*found;
}

/// What the name stands for as the program spells it; empty where it is none.
std::string known_description(const std::string& name) {
    if (const std::optional<Parameter> parameter = find_parameter(name)) return parameter_description(info(*parameter));
    const auto setting = std::ranges::find(setting_table(), name, &Setting::name);
    if (setting != setting_table().end()) return setting_description(*setting);
    const Word* const word = word_called(vocabulary(), name);
    return word == nullptr ? "" : word_description(*word);
}

}  // namespace

std::optional<std::string> description_of(std::string_view asked) {
    const std::string name = lower_case(asked);  // reports write some words in capitals
    if (const Word* const label = word_called(labels(), name)) return label_description(*label);
    std::string text = known_description(spelt(asked));
    const std::span<const std::string_view> meant = everyday_names(asked);
    if (meant.empty()) return text.empty() ? std::nullopt : std::optional(text);
    text += fmt::format("{}: everyday word for {}\n", asked, either(meant, "", ""));
    for (const std::string_view each : meant) text += known_description(std::string(each));
    return text;
}

std::string description(std::string_view asked) {
    if (std::optional<std::string> text = description_of(asked)) return *std::move(text);
    const std::vector<std::string_view> names = all_names();
    const std::vector<std::string_view> meant = meant_names(lower_case(asked), names);
    const std::string did_you_mean = meant.empty() ? "" : fmt::format("did you mean {}? ", either(meant));
    throw InputError({.where = "describe",
                      .problem = fmt::format("unknown name \"{}\"", asked),
                      .why = "neither a parameter, nor a setting, nor a word or label of the outputs",
                      .remedy = did_you_mean + "`skinfit describe` lists parameters and settings"});
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
