#include <fmt/format.h>

#include "core/version.hpp"
#include "fit/configuration_json.hpp"
#include "fit/problem.hpp"
#include "fit/report.hpp"

namespace skinfit {
namespace {

/// The settings with what a simulation takes by default; it has no quantity unless one is stated.
Json settings_of(const Configuration& configuration) {
    Configuration complete = as_stated(resolved(configuration));
    complete.quantity = configuration.quantity;
    return to_json(complete);
}

std::string parameters_text(const Configuration& configuration) {
    std::string text;
    for (const ParameterInfo& info : parameter_table()) {
        text += fmt::format(" {}={}", info.name, value_of(configuration.values, info.parameter));
    }
    return text;
}

struct ErrorNames {
    std::string reflectance;
    std::string transmittance;
};

/// What the errors of the readings are called. Those of solver and emulator are bounds, alike from one run to the next:
/// no standard uncertainties by which a fit may weigh the readings.
ErrorNames error_names(const Configuration& configuration) {
    if (configuration.engine == Engine::paths || configuration.engine == Engine::walk) {
        return {.reflectance = "reflectance_se", .transmittance = "transmittance_se"};
    }
    return {.reflectance = "reflectance_model_error", .transmittance = "transmittance_model_error"};
}

}  // namespace

std::string simulation_csv(const std::vector<Reading>& readings, const Configuration& configuration) {
    const ResolvedConfiguration complete = resolved(configuration);
    const Json settings = settings_of(configuration);
    const auto word = [&settings](const char* key) {
        return settings[key].is_string() ? settings[key].get<std::string>() : settings[key].dump();
    };
    std::string text = fmt::format("# skinfit {} simulation\n", version);
    for (const char* key : {"edition", "engine", "rays", "seed", "layers", "base", "incidence_deg", "specular"}) {
        text += fmt::format("# {}: {}\n", key, word(key));
    }
    if (complete.viewing_cone_deg) text += fmt::format("# viewing_cone_deg: {}\n", *complete.viewing_cone_deg);
    if (const std::optional<Bandpass> band = bandpass_of(complete)) {
        text += fmt::format("# bandpass_shape: {}\n# bandpass_width_nm: {}\n", word("bandpass_shape"), band->width_nm);
    }
    text += fmt::format("# unit: fraction\n# parameters:{}\n", parameters_text(configuration));
    const ErrorNames errors = error_names(configuration);
    text += fmt::format("wavelength_nm,reflectance,{},transmittance,{},surface_reflectance\n", errors.reflectance,
                        errors.transmittance);
    for (const Reading& reading : readings) {
        text += fmt::format("{},{},{},{},{},{}\n", reading.wavelength_nm, reading.reflectance, reading.reflectance_se,
                            reading.transmittance, reading.transmittance_se, reading.surface_reflectance);
    }
    return text;
}

Json simulation_json(const std::vector<Reading>& readings, const Configuration& configuration) {
    const Json settings = settings_of(configuration);
    const ErrorNames errors = error_names(configuration);
    Json json;
    const auto column = [&](const std::string& name, double Reading::*field) {
        json[name] = Json::array();
        for (const Reading& reading : readings) json[name].push_back(reading.*field);
    };
    column("wavelength_nm", &Reading::wavelength_nm);
    column("reflectance", &Reading::reflectance);
    column(errors.reflectance, &Reading::reflectance_se);
    column("transmittance", &Reading::transmittance);
    column(errors.transmittance, &Reading::transmittance_se);
    column("surface_reflectance", &Reading::surface_reflectance);
    for (const char* key : {"edition", "engine", "seed", "rays"}) json[key] = settings[key];
    json["version"] = version;
    json["configuration"] = settings;
    return json;
}

}  // namespace skinfit
