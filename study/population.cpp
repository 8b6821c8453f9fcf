#include "study/population.hpp"

#include <algorithm>

#include "fit/configuration_json.hpp"
#include "fit/json_reading.hpp"
#include "fit/prior.hpp"
#include "fit/prior_json.hpp"

namespace skinfit {
namespace {

const std::string population_example =
    R"(write it as in {"melanosome_fraction": {"kind": "log_normal", "median": 0.05, "sigma_log": 0.5}})";

/// One entry as the configuration takes it: the prior, and the limits taken out of it.
struct Entry {
    Json prior;
    Json bounds = Json::object();
};

Entry taken_apart(const Json& value) {
    Entry entry{.prior = value};
    if (!value.is_object()) return entry;
    for (const char* key : {"lower", "upper"}) {
        if (!value.contains(key)) continue;
        entry.bounds[key] = value[key];
        entry.prior.erase(key);
    }
    return entry;
}

/// Where searches begin.
double start(const std::optional<Prior>& prior, const Bounds& bounds) {
    if (!prior) return 0.5 * (bounds.lower + bounds.upper);
    return std::clamp(prior_median(*prior), bounds.lower, bounds.upper);
}

Configuration with_parameter(Configuration configuration, Parameter parameter, const Json& value,
                             const std::string& where) {
    const auto place = static_cast<std::size_t>(parameter);
    const std::string name(info(parameter).name);
    configuration.free[place] = !value.is_number();
    if (value.is_number()) return configured(std::move(configuration), {{"parameters", {{name, value}}}}, where);
    const Entry entry = taken_apart(value);
    if (!entry.bounds.empty()) {
        configuration = configured(std::move(configuration), {{"parameters", {{name, entry.bounds}}}}, where);
    }
    configuration = configured(std::move(configuration), {{"priors", {{name, entry.prior}}}}, where);
    value_of(configuration.values, parameter) = start(configuration.priors[place], configuration.bounds[place]);
    return configuration;
}

}  // namespace

Configuration with_population(Configuration configuration, const Json& population, const std::string& where) {
    const std::vector<std::string_view> known = prior_names();
    require_object(population, where, population_example);
    for (const auto& [name, value] : population.items()) {
        if (std::ranges::find(known, name) == known.end()) refuse_unknown(where, name, known);
        if (const std::optional<Parameter> parameter = find_parameter(name)) {
            configuration = with_parameter(std::move(configuration), *parameter, value, where);
        } else {
            configuration = configured(std::move(configuration), {{"priors", {{name, value}}}}, where);
        }
    }
    return configuration;
}

Json changed_population(Json base, const Json& changes) {
    for (const auto& [name, value] : changes.items()) base[name] = value;
    return base;
}

}  // namespace skinfit
