#include "study/question_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/input_error.hpp"
#include "fit/json_reading.hpp"
#include "fit/name_lists.hpp"
#include "fit/settings.hpp"
#include "fit/tissue.hpp"
#include "model/parameters.hpp"
#include "study/indices.hpp"

namespace skinfit {
namespace {

std::string word(const Json& json, std::string_view key, const std::string& where) {
    const Json& value = json.at(key);
    if (value.is_string() && !value.get<std::string>().empty()) return value.get<std::string>();
    refuse(fmt::format("{}.{}", where, key), value, "a word is needed", "write it between double quotes");
}

const Json& list(const Json& json, const std::string& where) {
    if (!json.is_array()) refuse(where, json, "a list is needed", study_example);
    return json;
}

std::vector<std::string_view> index_names() {
    std::vector<std::string_view> names;
    for (const IndexInfo& info : index_table()) names.push_back(info.name);
    return names;
}

/// What "parameter" may name: parameters, and what is computed of the tissue from them.
std::vector<std::string_view> fitted_names() {
    std::vector<std::string_view> names = parameter_names();
    for (const TissueQuantity& quantity : tissue_quantities()) names.push_back(quantity.name);
    return names;
}

/// The parameter, the quantity of the tissue or the index that an entry is about.
std::string read_quantity(const Json& json, const std::string& where) {
    if (json.contains("parameter") == json.contains("index")) {
        refuse(where, json, R"(either "parameter" or "index" is needed)", "give one of the two");
    }
    const std::string key = json.contains("parameter") ? "parameter" : "index";
    const std::vector<std::string_view> known = key == "parameter" ? fitted_names() : index_names();
    std::string name = word(json, key, where);
    if (std::ranges::find(known, name) == known.end()) refuse_unknown(where + "." + key, name, known);
    return name;
}

ReferenceSite read_site(const Json& json, const std::string& where) {
    require_names(json, {"same", "where"}, {{"same", "where"}, "a reference needs both", study_example}, where);
    ReferenceSite site{.same = word(json, "same", where), .where = {}};
    require_object(json["where"], where + ".where", study_example);
    for (const auto& [name, value] : json["where"].items()) {
        site.where.emplace_back(name, word(json["where"], name, where + ".where"));
    }
    if (site.where.empty()) refuse(where + ".where", json["where"], "it chooses nothing", study_example);
    return site;
}

double read_threshold(const Json& value, const std::string& quantity, const std::string& where) {
    if (const std::optional<Parameter> parameter = find_parameter(quantity)) {
        return read_number(value, {.lowest = info(*parameter).lowest, .highest = info(*parameter).highest}, where);
    }
    constexpr double far = 1e6;  // beyond every index and amount
    if (find_tissue_quantity(quantity)) return read_number(value, {.lowest = 0.0, .highest = far}, where);
    return read_number(value, {.lowest = -far, .highest = far}, where);
}

double read_prevalence(const Json& value, const Indicator& indicator, const std::string& where) {
    if (!find_parameter(indicator.quantity) || !indicator.threshold) {
        refuse(where, value, "it takes the place of what a prior says of a threshold; here is none",
               R"(leave it out, or ask about a parameter of the skin above or below a number)");
    }
    constexpr double least = 1e-6;  // none and all leave nothing to ask
    return read_number(value, {.lowest = least, .highest = 1.0 - least}, where);
}

Indicator read_indicator(const Json& json, const std::string& where) {
    require_names(json, {"name", "parameter", "index", "above", "below", "source", "prevalence"},
                  {{"name", "source"}, "a reader must see what is asked, and why there", study_example}, where);
    if (json.contains("above") == json.contains("below")) {
        refuse(where, json, R"(either "above" or "below" is needed)", "give one of the two");
    }
    Indicator indicator{.name = word(json, "name", where),
                        .quantity = read_quantity(json, where),
                        .above = json.contains("above"),
                        .threshold = {},
                        .reference = {},
                        .source = word(json, "source", where)};
    const std::string key = indicator.above ? "above" : "below";
    if (json[key].is_object()) {
        indicator.reference = read_site(json[key], where + "." + key);
    } else {
        indicator.threshold = read_threshold(json[key], indicator.quantity, where + "." + key);
    }
    if (json.contains("prevalence")) {
        indicator.prevalence = read_prevalence(json["prevalence"], indicator, where + ".prevalence");
    }
    return indicator;
}

}  // namespace

void check_quantity(const std::string& quantity, const FitSettings& settings, const std::string& where) {
    if (const TissueQuantity* const tissue = find_tissue_quantity(quantity)) {
        if (is_adjusted(*tissue, settings)) return;
        throw InputError(
            {.where = where,
             .problem = fmt::format("{} is not adjusted by the fits", quantity),
             .why = "they hold all that it is computed from, and say nothing about it",
             .remedy = R"(add what it is computed from to "free" of the study's "fit": `skinfit describe )" + quantity +
                       "` says what"});
    }
    const std::optional<Parameter> parameter = find_parameter(quantity);
    if (!parameter) {
        std::vector<std::string_view> known = index_names();
        if (std::ranges::find(known, quantity) != known.end()) return;
        std::ranges::copy(fitted_names(), std::back_inserter(known));
        refuse_unknown(where, quantity, known);
    }
    if (settings.free[static_cast<std::size_t>(*parameter)]) return;
    throw InputError(
        {.where = where,
         .problem = fmt::format("{} is not adjusted by the fits", quantity),
         .why = "they hold it at one value, and say nothing about it",
         .remedy = fmt::format(R"(add "+{}" to "free" of the study's "fit", or ask about another)", quantity)});
}

std::vector<Indicator> read_indicators(const Json& json, const std::string& where) {
    std::vector<Indicator> indicators;
    for (const Json& each : list(json, where)) {
        const std::string here = fmt::format("{}[{}]", where, indicators.size());
        Indicator indicator = read_indicator(each, here);
        if (std::ranges::find(indicators, indicator.name, &Indicator::name) != indicators.end()) {
            refuse(here + ".name", each["name"], "another indicator has it", "give each a name of its own");
        }
        indicators.push_back(std::move(indicator));
    }
    return indicators;
}

std::vector<Assessment> read_assessments(const Json& json, const std::vector<Indicator>& indicators,
                                         const std::string& where) {
    std::vector<std::string_view> known;
    for (const Indicator& indicator : indicators) known.emplace_back(indicator.name);
    std::vector<Assessment> assessments;
    for (const Json& each : list(json, where)) {
        const std::string here = fmt::format("{}[{}]", where, assessments.size());
        require_object(each, here, study_example);
        Assessment assessment;
        if (each.contains("indicator")) {
            require_names(each, {"indicator", "label", "positive", "thresholds"},
                          {{"label", "positive"}, "an indicator is compared with a label", study_example}, here);
            assessment.name = word(each, "indicator", here);
            if (known.empty())
                refuse(here + ".indicator", each["indicator"], "the study has no indicators", study_example);
            if (std::ranges::find(known, assessment.name) == known.end()) {
                refuse_unknown(here + ".indicator", assessment.name, known);
            }
            assessment.metadata = word(each, "label", here);
            assessment.positive = word(each, "positive", here);
            if (each.contains("thresholds")) {
                assessment.thresholds.clear();
                for (const Json& threshold : list(each["thresholds"], here + ".thresholds")) {
                    assessment.thresholds.push_back(
                        read_number(threshold, {.lowest = 0.0, .highest = 1.0}, here + ".thresholds"));
                }
            }
        } else {
            require_names(each, {"parameter", "index", "reference"},
                          {{"reference"}, "estimates are compared with numbers", study_example}, here);
            assessment.name = read_quantity(each, here);
            assessment.is_indicator = false;
            assessment.metadata = word(each, "reference", here);
        }
        assessments.push_back(std::move(assessment));
    }
    return assessments;
}

}  // namespace skinfit
