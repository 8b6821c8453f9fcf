#include "study/planned_study.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input_error.hpp"
#include "fit/configuration_check.hpp"
#include "fit/configuration_json.hpp"
#include "fit/json_reading.hpp"
#include "fit/measurement.hpp"
#include "fit/preset.hpp"
#include "fit/prior_json.hpp"
#include "model/emulator.hpp"
#include "study/manifest.hpp"

namespace skinfit {
namespace {

bool same(const std::optional<Prior>& a, const std::optional<Prior>& b) {
    Configuration one;
    Configuration other;
    one.priors.front() = a;
    other.priors.front() = b;
    return write_priors(one) == write_priors(other);
}

/// The range that holds the draws of all groups.
Bounds common_bounds(const Cohort& cohort, std::size_t place) {
    const auto of_group = [place](const CohortGroup& group) {
        const double value = value_of(group.configuration.values, static_cast<Parameter>(place));
        return group.configuration.free[place] ? group.configuration.bounds[place] : Bounds{value, value};
    };
    Bounds bounds = of_group(cohort.groups.front());
    for (const CohortGroup& group : cohort.groups) {
        const Bounds own = of_group(group);
        bounds = {std::min(bounds.lower, own.lower), std::max(bounds.upper, own.upper)};
    }
    return bounds;
}

/// Whether `place` is drawn in the same way in every group.
bool is_drawn_alike(const Cohort& cohort, std::size_t place) {
    const Configuration& first = cohort.groups.front().configuration;
    return std::ranges::all_of(cohort.groups, [&](const CohortGroup& group) {
        const Configuration& own = group.configuration;
        return own.free[place] && own.bounds[place].lower == first.bounds[place].lower &&
               own.bounds[place].upper == first.bounds[place].upper && same(own.priors[place], first.priors[place]);
    });
}

/// Whether a fit can be held against the truth of it: of what the layered transport has, that which means the same in
/// the model.
bool can_be_assessed(const Cohort& cohort, Parameter parameter) {
    return !cohort.transport || parameter == Parameter::oxygen_saturation ||
           parameter == Parameter::dermal_bilirubin_g_per_l;
}

Json indicators(const Cohort& cohort) {
    Json list = Json::array();
    for (const CohortLabel& label : cohort.labels) {
        if (!can_be_assessed(cohort, label.parameter)) continue;
        list.push_back({{"name", label.name},
                        {"parameter", info(label.parameter).name},
                        {label.above ? "above" : "below", label.limit},
                        {"source", fmt::format("the cohort's label {}", label.name)}});
    }
    return list;
}

Json assessments(const Cohort& cohort) {
    Json list = Json::array();
    for (const CohortLabel& label : cohort.labels) {
        if (!can_be_assessed(cohort, label.parameter)) continue;
        list.push_back({{"indicator", label.name}, {"label", label.name}, {"positive", "yes"}});
    }
    for (const Parameter parameter : varying_parameters(cohort)) {
        if (!can_be_assessed(cohort, parameter)) continue;
        const std::string_view name = info(parameter).name;
        list.push_back({{"parameter", name}, {"reference", fmt::format("true_{}", name)}});
    }
    return list;
}

/// The preset for measured skin, told how the spectra were measured and nothing of the skin.
Configuration fit_of_another_physics(const Cohort& cohort) {
    Configuration fit = measured_configuration();
    const Configuration& made = cohort.configuration;
    fit.instrument = made.instrument;
    fit.incidence_deg = made.incidence_deg;
    fit.specular = made.specular;
    fit.viewing_cone_deg = made.viewing_cone_deg;
    fit.noise = made.noise;
    fit.seed = made.seed;
    fit.wavelengths = made.wavelengths;
    fit.wavelength_min_nm = made.wavelength_min_nm;
    fit.wavelength_max_nm = made.wavelength_max_nm;
    if (resolved(fit).viewing_cone_deg) fit.engine = Engine::solver;
    return fit;
}

}  // namespace

void check_study(const Cohort& cohort, const std::string& where) {
    require_names(cohort.study, {"fit", "group_by", "indicators", "assess"},
                  {{}, "", "leave out what is not to be replaced"}, where);
    Configuration fit = planned_fit(cohort);
    if (cohort.study.contains("fit")) fit = configured(fit, cohort.study["fit"], where + ".fit");
    check_freedom(fit, where + ".fit.free");
    for (const auto& [key, value] : cohort.study.items()) {
        if (key != "fit" && !value.is_array()) {
            refuse(fmt::format("{}.{}", where, key), value, "a list is needed",
                   "write it as in a study file; see docs/studies.md");
        }
    }
    if (cohort.study.contains("indicators") && !cohort.study.contains("assess")) {
        throw InputError({.where = where,
                          .problem = "indicators without \"assess\"",
                          .why = "only of its own indicators does the cohort know which label tells the truth",
                          .remedy = "give \"assess\" too, or leave \"indicators\" out"});
    }
    if (!cohort.study.contains("group_by")) return;
    const std::vector<std::string> columns = manifest_columns(cohort);
    const std::vector<std::string_view> known(columns.begin(), columns.end());
    for (const Json& column : cohort.study["group_by"]) {
        (void)read_choice(column, known, where + ".group_by");
    }
}

Configuration planned_fit(const Cohort& cohort) {
    if (cohort.transport) return fit_of_another_physics(cohort);
    const Configuration& first = cohort.groups.front().configuration;
    Configuration fit = first;
    fit.engine = resolved(fit).viewing_cone_deg ? Engine::solver : Engine::emulator;
    fit.free.fill(false);
    fit.priors.fill(std::nullopt);
    for (const Parameter parameter : varying_parameters(cohort)) {
        const auto place = static_cast<std::size_t>(parameter);
        fit.free[place] = true;
        if (!can_be_emulated(parameter)) fit.engine = Engine::solver;
        if (is_drawn_alike(cohort, place)) {
            fit.priors[place] = first.priors[place];
            continue;
        }
        fit.bounds[place] = common_bounds(cohort, place);
        value_of(fit.values, parameter) = 0.5 * (fit.bounds[place].lower + fit.bounds[place].upper);
    }
    for (std::size_t i = 0; i < derived_count; ++i) {
        const bool alike = std::ranges::all_of(cohort.groups, [&](const CohortGroup& group) {
            return same(group.configuration.derived_priors[i], first.derived_priors[i]);
        });
        if (!alike) fit.derived_priors[i].reset();
    }
    return fit;
}

Json study_json(const Cohort& cohort) {
    Json json = {{"name", cohort.name}, {"inputs", Json::array({{{"manifest", manifest_file}}})}};
    Configuration fit = planned_fit(cohort);
    if (cohort.study.contains("fit")) fit = configured(fit, cohort.study["fit"], "study.fit");
    json["fit"] = to_json(fit);
    json["group_by"] = Json::array({"group"});
    if (cohort.repeats > 1) json["repeats_of"] = "subject";
    json["indicators"] = indicators(cohort);
    json["assess"] = assessments(cohort);
    for (const char* key : {"group_by", "indicators", "assess"}) {
        if (cohort.study.contains(key)) json[key] = cohort.study[key];
    }
    json["output"] = "results";
    return json;
}

}  // namespace skinfit
