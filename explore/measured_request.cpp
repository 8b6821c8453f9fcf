#include "explore/measured_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/input_error.hpp"
#include "explore/configuration_request.hpp"
#include "fit/configuration_json.hpp"
#include "fit/file_settings.hpp"
#include "fit/resolution.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {
namespace {

Configuration configuration_for(const Json& stated, std::span<const Spectrum> spectra) {
    const Configuration configuration = requested_configuration(explore_configuration(), stated);
    return spectra.empty() ? configuration : with_file_settings(configuration, spectra);
}

/// What an instrument says of the settings.
Json settings_of(const std::optional<NamedInstrument>& instrument) {
    Configuration configuration;
    configuration.instrument = instrument;
    return to_json(with_instrument(std::move(configuration)));
}

bool states(const Spectrum& spectrum, std::string_view setting) {
    const Geometry& geometry = spectrum.geometry;
    if (setting == "quantity") return spectrum.quantity.has_value();
    if (setting == "incidence_deg") return geometry.incidence_deg.has_value();
    if (setting == "specular") return geometry.specular.has_value();
    if (setting == "viewing_cone_deg") return geometry.viewing_cone_deg.has_value();
    if (setting == "bandpass_shape" || setting == "bandpass_width_nm") return spectrum.bandpass.has_value();
    return std::ranges::find(spectrum.notes, setting, &FileNote::key) != spectrum.notes.end();
}

/// `configuration` is that for `spectrum`, before it is resolved.
Json deciders(const Json& stated, const Configuration& configuration, const Spectrum& spectrum) {
    const Json open = to_json(configuration);
    const Json by_instrument = settings_of(configuration.instrument);
    const Json by_file = to_json(resolved(configuration_for(Json::object(), std::span(&spectrum, 1)), spectrum));
    const Json by_default = to_json(resolved(explore_configuration()));
    Json deciders;
    for (const std::string_view name : measurement_settings) {
        const std::string key(name);
        if (stated.contains(key) && !stated[key].is_null()) {
            deciders[key] = "stated";
        } else if (configuration.instrument && open[key].is_null() && !by_instrument[key].is_null()) {
            deciders[key] = "instrument";
        } else {
            deciders[key] = states(spectrum, name) || by_file[key] != by_default[key] ? "file" : "default";
        }
    }
    return deciders;
}

}  // namespace

MeasuredRequest measured_request(const Json& request) {
    const Json named = request.value("source", Json());
    MeasuredRequest found{.stated = request.value("configuration", Json::object()),
                          .source = named.is_string() ? named.get<std::string>() : "measured",
                          .spectra = {}};
    const Json measured = request.value("measured", Json::array());
    if (measured.is_array() && measured.empty()) return found;
    const std::string text = Json{{"spectra", measured}}.dump(-1, ' ', false, Json::error_handler_t::replace);
    const WavelengthWindow window = window_of(stated_configuration(found));
    found.spectra = parse_spectra(text, found.source, {.window = window}, "json").spectra;
    return found;
}

Configuration stated_configuration(const MeasuredRequest& request) {
    return configuration_for(request.stated, {});
}

Configuration fit_configuration(const MeasuredRequest& request) {
    return configuration_for(request.stated, request.spectra);
}

std::vector<MeasuredModel> measured_models(const MeasuredRequest& request) {
    constexpr std::size_t most = 4;  // chosen: what one can tell apart in a plot, and follows a slider
    std::vector<Spectrum> spectra = request.spectra;
    if (spectra.empty()) spectra.emplace_back();
    std::vector<MeasuredModel> models;
    for (std::size_t i = 0; i < spectra.size(); ++i) {
        const auto own = request.spectra.empty() ? std::span<const Spectrum>() : std::span(&spectra[i], 1);
        const Configuration configuration = configuration_for(request.stated, own);
        const Configuration complete = as_stated(resolved(configuration, spectra[i]));
        const Json json = to_json(complete);
        auto same = std::ranges::find_if(
            models, [&](const MeasuredModel& each) { return to_json(each.configuration) == json; });
        if (same == models.end()) {
            if (models.size() == most) {
                throw InputError({.where = request.source,
                                  .problem = fmt::format("spectra of more than {} geometries are shown", most),
                                  .why = "each needs a model of its own, and so many do not follow a slider",
                                  .remedy = "show fewer"});
            }
            models.push_back({.configuration = complete,
                              .spectra = {},
                              .decided_by = deciders(request.stated, configuration, spectra[i])});
            same = models.end() - 1;
        }
        if (!request.spectra.empty()) same->spectra.push_back(i);
    }
    return models;
}

}  // namespace skinfit
