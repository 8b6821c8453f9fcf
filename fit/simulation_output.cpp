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

/// The errors of the readings, whatever made them, are the model's and not those of a measurement: their names are none
/// by which a fit would weigh the readings.
constexpr std::string_view reflectance_error = "reflectance_model_error";
constexpr std::string_view transmittance_error = "transmittance_model_error";

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
    text += fmt::format("wavelength_nm,reflectance,{},transmittance,{},surface_reflectance\n", reflectance_error,
                        transmittance_error);
    for (const Reading& reading : readings) {
        text += fmt::format("{},{},{},{},{},{}\n", reading.wavelength_nm, reading.reflectance, reading.reflectance_se,
                            reading.transmittance, reading.transmittance_se, reading.surface_reflectance);
    }
    return text;
}

Json simulation_json(const std::vector<Reading>& readings, const Configuration& configuration) {
    const Json settings = settings_of(configuration);
    Json json;
    const auto column = [&](std::string_view name, double Reading::*field) {
        json[name] = Json::array();
        for (const Reading& reading : readings) json[name].push_back(reading.*field);
    };
    column("wavelength_nm", &Reading::wavelength_nm);
    column("reflectance", &Reading::reflectance);
    column(reflectance_error, &Reading::reflectance_se);
    column("transmittance", &Reading::transmittance);
    column(transmittance_error, &Reading::transmittance_se);
    column("surface_reflectance", &Reading::surface_reflectance);
    for (const char* key : {"edition", "engine", "seed", "rays"}) json[key] = settings[key];
    json["version"] = version;
    json["configuration"] = settings;
    return json;
}

}  // namespace skinfit
