#include "study/cohort.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fit/configuration_json.hpp"
#include "fit/json_reading.hpp"
#include "fit/problem.hpp"
#include "fit/simulation.hpp"
#include "fit/wavelength_sets.hpp"
#include "study/cohort_names.hpp"
#include "study/planned_study.hpp"
#include "study/population.hpp"

namespace skinfit {
namespace {

const std::string cohort_example = "configs/cohort_power.json, which comes with skinfit, is an example";

/// Settings that the cohort itself states, or that a simulation has no use for.
void refuse_misplaced(const std::string& key, const std::string& where) {
    constexpr std::array<std::string_view, 4> of_cohort = {"seed", "wavelengths", "noise", "discrepancy"};
    constexpr std::array<std::string_view, 3> of_population = {"free", "own", "priors"};
    const auto is_among = [&key](const auto& names) { return std::ranges::find(names, key) != names.end(); };
    const auto refuse_here = [&](const std::string& why, const std::string& remedy) {
        throw InputError({.where = where + "." + key, .problem = "cannot stand here", .why = why, .remedy = remedy});
    };
    if (is_among(of_cohort)) refuse_here("the cohort states it for all", "write it beside \"model\"");
    if (is_among(of_population)) refuse_here("populations say what is drawn", "write it under \"population\"");
    const bool is_setting = std::ranges::find(setting_table(), key, &Setting::name) != setting_table().end();
    if (is_setting && !is_among(model_settings())) {
        refuse_here("a simulation has no use for it", R"(write it under "study", as in {"fit": {...}})");
    }
}

constexpr double cohort_noise = 0.003;  // where the cohort states none, fraction

/// What a model's settings say that the layered transport has not.
void refuse_beside_transport(const Json& model, const std::string& where) {
    for (const auto& [key, value] : model.items()) {
        if (key == "parameters" || std::ranges::find(reading_settings(), key) != reading_settings().end()) {
            continue;
        }
        throw InputError({.where = where + "." + key,
                          .problem = "cannot stand beside \"transport\"",
                          .why = "the layered transport makes the spectra, not an engine of the model",
                          .remedy = "leave it out"});
    }
    if (!model.contains("parameters")) return;
    for (const auto& [name, value] : model["parameters"].items()) {
        check_transport_parameter(name, where + ".parameters");
    }
}

void refuse_bandpass(const Configuration& configuration, const std::string& where) {
    const std::optional<Bandpass> band = bandpass_of(resolved(configuration));
    if (!band) return;
    refuse(where + ".bandpass_width_nm", band->width_nm, "the layered transport reads single wavelengths",
           "set it to 0, or take an instrument without one");
}

Configuration read_model(const Json& json, const std::string& where) {
    Configuration configuration = default_configuration();
    configuration.engine = Engine::solver;
    const bool by_transport = json.contains("transport");
    if (by_transport) configuration = with_layered_skin(std::move(configuration));
    configuration.free.fill(false);
    for (const char* key : {"seed", "wavelengths", "noise", "discrepancy"}) {
        if (json.contains(key)) configuration = configured(std::move(configuration), {{key, json[key]}}, where);
    }
    configuration.noise = configuration.noise.value_or(cohort_noise);
    if (json.contains("model")) {
        const std::string here = where + ": model";
        require_object(json["model"], here, cohort_example);
        for (const auto& [key, value] : json["model"].items()) refuse_misplaced(key, here);
        if (by_transport) refuse_beside_transport(json["model"], here);
        std::vector<std::string_view> known(model_settings().begin(), model_settings().end());
        known.emplace_back("parameters");
        require_names(json["model"], known, {{}, "", cohort_example}, here);
        configuration = configured(std::move(configuration), json["model"], here);
        if (by_transport) refuse_bandpass(configuration, here);
    }
    if (configuration.engine == Engine::walk) {
        refuse(where + ": model.engine", "walk", "its noise would come on top of that of the instrument",
               "give solver, emulator or paths");
    }
    const std::vector<double> wavelengths_nm = parse_wavelengths(configuration.wavelengths, where + ": wavelengths");
    constexpr std::size_t fewest_wavelengths = 3;
    if (wavelengths_nm.size() < fewest_wavelengths) {
        refuse(where + ": wavelengths", configuration.wavelengths, "a table of spectra needs at least three",
               "give more of them");
    }
    configuration.wavelength_min_nm = wavelengths_nm.front();
    configuration.wavelength_max_nm = wavelengths_nm.back();
    return configuration;
}

Json entry(const Json& json, const char* key, const Json& otherwise) {
    return json.contains(key) ? json[key] : otherwise;
}

void check_draws(const Cohort& cohort, const CohortGroup& group, const std::string& where) {
    const bool scatters = cohort.transport && (cohort.transport->scattering_at_500_nm_per_cm.varies() ||
                                               cohort.transport->scattering_power.varies());
    if (free_parameters(group.configuration).empty() && !scatters) {
        throw InputError({.where = where,
                          .problem = "nothing is drawn",
                          .why = "all of its subjects would be one",
                          .remedy = "give at least one parameter of the population a distribution"});
    }
    (void)make_problem(group.configuration, blank_spectrum(group.configuration));
}

/// The cells of the manifest that a group states; names that no group before had are added to `cohort`.
void take_metadata(Cohort& cohort, CohortGroup& group, const Json& metadata, const std::string& where) {
    require_object(metadata, where, R"(write it as in {"skin_type": "II"})");
    for (const auto& [name, value] : metadata.items()) {
        check_column_name(name, where);
        const auto found = std::ranges::find(cohort.metadata_names, name);
        const auto place = static_cast<std::size_t>(found - cohort.metadata_names.begin());
        if (found == cohort.metadata_names.end()) cohort.metadata_names.push_back(name);
        if (group.metadata.size() <= place) group.metadata.resize(place + 1);
        group.metadata[place] = value.is_number() ? value.dump() : read_cell(value, fmt::format("{}.{}", where, name));
    }
}

void check_population(const Cohort& cohort, const Json& population, const std::string& where) {
    (void)with_population(cohort.configuration, population, where);
    if (!cohort.transport) return;
    for (const auto& [name, value] : population.items()) check_transport_parameter(name, where);
}

CohortGroup read_group(Cohort& cohort, const Json& json, const Json& population, const std::string& where) {
    constexpr std::uint64_t most_subjects = 1'000'000;
    require_names(json, {"name", "subjects", "population", "metadata"},
                  {{"name", "subjects"}, "a group cannot do without it", cohort_example}, where);
    CohortGroup group{.name = read_cell(json["name"], where + ".name"),
                      .subjects = read_count(json["subjects"], 1, most_subjects, where + ".subjects"),
                      .configuration = {},
                      .metadata = {}};
    if (std::ranges::find(cohort.groups, group.name, &CohortGroup::name) != cohort.groups.end()) {
        refuse(where + ".name", group.name, "another group has it", "give groups different names");
    }
    const Json own = entry(json, "population", Json::object());
    // On its own first, so that a mistake is reported where it was made.
    check_population(cohort, own, where + ".population");
    group.configuration = with_population(cohort.configuration, changed_population(population, own), where);
    check_draws(cohort, group, where);
    take_metadata(cohort, group, entry(json, "metadata", Json::object()), where + ".metadata");
    return group;
}

CohortLabel read_label(const Cohort& cohort, const std::string& name, const Json& json, const std::string& where) {
    check_column_name(name, where);
    require_names(json, {"parameter", "above", "below"},
                  {{"parameter"},
                   "a label is about one",
                   "write it as in {\"parameter\": \"bilirubin_g_per_l\", "
                   "\"above\": 0.2}"},
                  where);
    if (json.contains("above") == json.contains("below")) {
        refuse(where, json, "one of above and below is needed", "give one limit");
    }
    const std::vector<Parameter> varying = varying_parameters(cohort);
    std::vector<std::string_view> names;
    for (const Parameter parameter : varying) names.push_back(info(parameter).name);
    const Parameter parameter = varying[read_choice(json["parameter"], names, where + ".parameter")];
    const bool above = json.contains("above");
    const ParameterInfo& row = info(parameter);
    return {.name = name,
            .parameter = parameter,
            .above = above,
            .limit = read_number(json[above ? "above" : "below"], {row.lowest, row.highest},
                                 where + (above ? ".above" : ".below"))};
}

void check_columns(const Cohort& cohort, const std::string& where) {
    for (const CohortLabel& label : cohort.labels) {
        if (std::ranges::find(cohort.metadata_names, label.name) == cohort.metadata_names.end()) continue;
        refuse(where + ": labels", label.name, "a group has metadata of that name", "give them different names");
    }
}

/// Every default filled in.
Json resolved_json(const Cohort& cohort, const Json& json) {
    const Json all = to_json(cohort.configuration);
    Json resolved = {{"name", cohort.name}};
    if (json.contains("description")) resolved["description"] = json["description"];
    for (const char* key : {"seed", "wavelengths", "noise", "discrepancy"}) resolved[key] = all[key];
    resolved["repeats"] = cohort.repeats;
    const auto keys = cohort.transport ? reading_settings() : model_settings();
    for (const std::string_view key : keys) resolved["model"][std::string(key)] = all[std::string(key)];
    resolved["model"]["parameters"] = all["parameters"];
    if (cohort.transport) {
        Json shared;
        for (const Parameter parameter : transport_parameters()) {
            const std::string name(info(parameter).name);
            shared[name] = all["parameters"][name];
        }
        resolved["model"]["parameters"] = shared;
        resolved["transport"] = to_json(*cohort.transport);
    }
    for (const char* key : {"population", "groups", "labels", "study", "sources"}) {
        if (json.contains(key)) resolved[key] = json[key];
    }
    return resolved;
}

}  // namespace

bool CohortLabel::holds(const ParameterValues& values) const {
    const double value = value_of(values, parameter);
    return above ? value > limit : value < limit;
}

Cohort read_cohort(const Json& json, const std::string& where) {
    constexpr std::uint64_t most_repeats = 1000;
    require_names(json,
                  {"name", "description", "seed", "wavelengths", "noise", "discrepancy", "repeats", "model",
                   "transport", "population", "groups", "labels", "study", "sources"},
                  {{"name", "groups"}, "a cohort cannot do without it", cohort_example}, where);
    for (const char* key : {"population", "labels", "study", "sources"}) {
        if (json.contains(key)) require_object(json[key], where + ": " + key, cohort_example);
    }
    if (!json["groups"].is_array() || json["groups"].empty()) {
        refuse(where + ": groups", json["groups"], "a list of at least one group is needed", cohort_example);
    }
    Cohort cohort{.name = read_cell(json["name"], where + ": name"),
                  .repeats = read_count(entry(json, "repeats", 1), 1, most_repeats, where + ": repeats"),
                  .configuration = read_model(json, where),
                  .transport = {},
                  .groups = {},
                  .metadata_names = {},
                  .labels = {},
                  .study = entry(json, "study", Json::object()),
                  .resolved = {}};
    if (json.contains("transport")) cohort.transport = read_transport_plan(json["transport"], where + ": transport");
    const Json sources = entry(json, "sources", Json::object());
    for (const auto& [key, source] : sources.items()) {
        if (!source.is_string())
            refuse(fmt::format("{}: sources.{}", where, key), source, "text is needed", "say where it comes from");
    }
    const Json population = entry(json, "population", Json::object());
    check_population(cohort, population, where + ": population");
    for (const Json& group : json["groups"]) {
        const std::string here = fmt::format("{}: groups[{}]", where, cohort.groups.size());
        cohort.groups.push_back(read_group(cohort, group, population, here));
    }
    for (CohortGroup& group : cohort.groups) group.metadata.resize(cohort.metadata_names.size());
    const Json labels = entry(json, "labels", Json::object());
    for (const auto& [name, label] : labels.items()) {
        cohort.labels.push_back(read_label(cohort, name, label, fmt::format("{}: labels.{}", where, name)));
    }
    check_columns(cohort, where);
    check_study(cohort, where + ": study");
    cohort.resolved = resolved_json(cohort, json);
    return cohort;
}

std::vector<Parameter> varying_parameters(const Cohort& cohort) {
    std::vector<Parameter> parameters;
    for (const ParameterInfo& row : parameter_table()) {
        const auto place = static_cast<std::size_t>(row.parameter);
        const double first = value_of(cohort.groups.front().configuration.values, row.parameter);
        const bool varies = std::ranges::any_of(cohort.groups, [&](const CohortGroup& group) {
            return group.configuration.free[place] || value_of(group.configuration.values, row.parameter) != first;
        });
        if (varies) parameters.push_back(row.parameter);
    }
    return parameters;
}

}  // namespace skinfit
