#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "fit/configuration_check.hpp"
#include "fit/configuration_json.hpp"
#include "fit/json_reading.hpp"
#include "fit/named_instrument.hpp"
#include "fit/preset.hpp"
#include "fit/settings.hpp"
#include "measurements/quality_checks.hpp"
#include "study/cube_plan.hpp"
#include "study/question_reading.hpp"
#include "study/study.hpp"
#include "study/study_inputs.hpp"

namespace skinfit {
namespace {

std::vector<std::string> read_words(const Json& json, std::string_view key, const std::string& where) {
    std::vector<std::string> words;
    if (!json.contains(key)) return words;
    const Json& value = json.at(key);
    const std::string here = fmt::format("{}.{}", where, key);
    const Json list = value.is_string() ? Json::array({value}) : value;
    if (!list.is_array()) refuse(here, value, "a list of words is needed", R"(write ["...", "..."])");
    for (const Json& each : list) {
        if (!each.is_string() || each.get<std::string>().empty()) {
            refuse(here, each, "a word is needed", "write it between double quotes");
        }
        words.push_back(each.get<std::string>());
    }
    return words;
}

std::string read_word(const Json& json, std::string_view key, const std::string& where) {
    if (!json.contains(key)) return {};
    const Json& value = json.at(key);
    if (value.is_string() && !value.get<std::string>().empty()) return value.get<std::string>();
    refuse(fmt::format("{}.{}", where, key), value, "a word is needed", "write it between double quotes");
}

/// What "fit" says: settings, or the name of a file of settings.
Json read_settings(const Json& json, const std::filesystem::path& folder) {
    if (!json.contains("fit")) return Json::object();
    if (!json["fit"].is_string()) return json["fit"];
    const std::filesystem::path path = folder / json["fit"].get<std::string>();
    return parsed_json(read_input(path), path.string(), "see `skinfit config show`");
}

std::optional<std::string> read_instrument(const Json& json, const std::filesystem::path& folder,
                                           const std::string& where) {
    const std::string instrument = read_word(json, "instrument", where);
    if (instrument.empty()) return std::nullopt;
    if (json.contains("fit") && json["fit"].is_object() && json["fit"].contains("instrument")) {
        throw InputError({.where = where + ".instrument",
                          .problem = "is given by \"fit\" too",
                          .why = "only one of them could hold",
                          .remedy = "keep one of the two"});
    }
    // A file lies relative to the study; anything else is the name of an instrument.
    const std::filesystem::path file = folder / instrument;
    return std::filesystem::exists(file) && !std::filesystem::is_directory(file) ? file.string() : instrument;
}

/// Pixels of images are fitted by plain least squares, without the priors and the discrepancy of preset skin.
Configuration fit_configuration(const Study& study, const std::string& where) {
    const Configuration of_paper = default_study_configuration();
    if (!study.cubes.empty()) return configured(of_paper, study.fit, where);
    const Configuration measured = configured(measured_configuration(), study.fit, where);
    return measured.preset == Preset::paper ? configured(of_paper, study.fit, where) : measured;
}

/// Findings are named as `skinfit inspect` names them; a name that no check has would change nothing.
void check_accepted(const std::vector<std::string>& names, const std::string& where) {
    const std::vector<std::string_view> known(quality_check_names.begin(), quality_check_names.end());
    for (const std::string& name : names) {
        if (std::ranges::find(known, name) == known.end()) refuse_unknown(where + ".accept", name, known);
    }
}

/// Two inputs must not name one file: its spectra would count twice.
template <class Files>
void check_distinct(const Files& files, std::set<std::string>& sources, const std::string& where) {
    for (const auto& file : files) {
        if (sources.insert(file.source).second) continue;
        throw InputError({.where = where + ".inputs",
                          .problem = fmt::format("name {} twice", file.source),
                          .why = "its spectra would count twice",
                          .remedy = "leave it out of one of them"});
    }
}

/// Two cubes whose maps would be one file.
void check_map_names(const std::vector<StudyCube>& cubes, const std::string& where) {
    std::map<std::string, std::string> taken;
    for (const StudyCube& cube : cubes) {
        const auto [first, is_new] = taken.try_emplace(map_name(cube.source), cube.source);
        if (is_new) continue;
        throw InputError({.where = where + ".inputs",
                          .problem = fmt::format("the maps of {} and {} would be one file", first->second, cube.source),
                          .why = fmt::format("both are called {}", first->first),
                          .remedy = "rename one of the cubes"});
    }
}

}  // namespace

Study parse_study(std::string_view text, const std::filesystem::path& path, const std::filesystem::path& data) {
    const std::string where = path.string();
    const Json json = parsed_json(text, where, study_example);
    require_names(
        json,
        {"name", "inputs", "instrument", "fit", "accept", "group_by", "repeats_of", "indicators", "assess", "output"},
        {{"inputs", "output"}, "a study cannot do without it", study_example}, where);
    const std::filesystem::path folder = path.parent_path();
    Study study;
    study.file = path;
    study.name = json.contains("name") ? read_word(json, "name", where) : path.stem().string();
    const StudyInputs inputs = read_inputs(json["inputs"], data.empty() ? folder : data, where + ".inputs");
    study.files = inputs.files;
    study.cubes = inputs.cubes;
    std::set<std::string> sources;
    check_distinct(study.files, sources, where);
    check_distinct(study.cubes, sources, where);
    check_map_names(study.cubes, where);
    study.fit = read_settings(json, folder);
    study.instrument = read_instrument(json, folder, where);
    study.configuration = fit_configuration(study, where + ".fit");
    if (study.instrument) {
        study.configuration.instrument = find_instrument(*study.instrument, where + ".instrument");
    }
    check_freedom(study.configuration, where + ".fit.free");
    study.accept = read_words(json, "accept", where);
    check_accepted(study.accept, where);
    study.group_by = read_words(json, "group_by", where);
    study.repeats_of = read_word(json, "repeats_of", where);
    if (json.contains("indicators")) study.indicators = read_indicators(json["indicators"], where + ".indicators");
    for (const Indicator& each : study.indicators) {
        check_quantity(each.quantity, study.configuration, fmt::format("{}: indicator {}", where, each.name));
    }
    if (json.contains("assess")) {
        study.assessments = read_assessments(json["assess"], study.indicators, where + ".assess");
    }
    study.output = folder / read_word(json, "output", where);
    return study;
}

Study read_study(const std::filesystem::path& path, const std::filesystem::path& data) {
    return parse_study(read_input(path), path, data);
}

}  // namespace skinfit
