#include "fit/resolution.hpp"

#include <algorithm>
#include <utility>

#include "core/input_error.hpp"
#include "fit/file_settings.hpp"
#include "model/constants.hpp"

namespace skinfit {
namespace {

/// `configuration` with what it leaves unset of geometry and bandpass as they are here.
Configuration with_stated(Configuration configuration, const Geometry& geometry,
                          const std::optional<Bandpass>& bandpass) {
    if (!configuration.incidence_deg) configuration.incidence_deg = geometry.incidence_deg;
    if (!configuration.specular) configuration.specular = geometry.specular;
    if (!configuration.viewing_cone_deg) configuration.viewing_cone_deg = geometry.viewing_cone_deg;
    if (bandpass) {
        if (!configuration.bandpass_shape) configuration.bandpass_shape = bandpass->shape;
        if (!configuration.bandpass_width_nm) configuration.bandpass_width_nm = bandpass->width_nm;
    }
    return configuration;
}

/// What the file states is taken where neither the configuration nor its instrument does, and after that the instrument
/// that the file names, if it is one of ours.
Configuration with_file(Configuration configuration, const Spectrum& spectrum) {
    configuration = with_stated(with_instrument(std::move(configuration)), spectrum.geometry, spectrum.bandpass);
    if (!configuration.quantity) configuration.quantity = spectrum.quantity;
    const std::vector<std::string> names = instrument_names();
    if (configuration.instrument || std::ranges::find(names, spectrum.instrument) == names.end()) return configuration;
    configuration.instrument = find_instrument(spectrum.instrument, "instrument");
    return with_instrument(std::move(configuration));
}

Base base_under(int layers, const std::optional<Base>& stated) {
    const bool separated = layers == 2;
    if (!stated) return separated ? Base{.kind = Base::Kind::index, .refractive_index = 1.0} : Base{};
    if (separated && stated->kind == Base::Kind::hypodermis) {
        throw InputError({.where = "base",
                          .problem = "hypodermis under two layers",
                          .why = "separated stratum corneum and epidermis have no dermis above a hypodermis",
                          .remedy = "leave base unset for air, or give matched or a refractive index"});
    }
    return *stated;
}

}  // namespace

Configuration with_instrument(Configuration configuration) {
    if (!configuration.instrument) return configuration;
    const NamedInstrument instrument = *configuration.instrument;
    configuration = with_stated(std::move(configuration), instrument.geometry, instrument.bandpass);
    if (!configuration.noise) configuration.noise = instrument.noise;
    return configuration;
}

ResolvedConfiguration resolved(Configuration configuration, const Spectrum& spectrum) {
    const Configuration stated = with_file(std::move(configuration), spectrum);
    const bool cone = stated.viewing_cone_deg.has_value();
    ResolvedConfiguration resolved;
    static_cast<FitSettings&>(resolved) = stated;
    resolved.edition = stated.edition.value_or(default_edition);
    resolved.layers = stated.layers.value_or(default_layers);
    resolved.base = base_under(resolved.layers, stated.base);
    resolved.incidence_deg =
        stated.incidence_deg.value_or(cone ? default_incidence_deg_with_cone : default_incidence_deg);
    resolved.specular = stated.specular.value_or(cone ? default_specular_with_cone : default_specular);
    resolved.specular_is_assumed = !stated.specular;
    resolved.viewing_cone_deg = stated.viewing_cone_deg;
    if (stated.instrument) resolved.instrument = stated.instrument->name;
    resolved.bandpass = {.shape = stated.bandpass_shape.value_or(default_bandpass_shape),
                         .width_nm = stated.bandpass_width_nm.value_or(0.0)};
    resolved.quantity = stated.quantity.value_or(default_quantity);
    resolved.noise = stated.noise.value_or(default_noise);
    return resolved;
}

Configuration as_stated(const ResolvedConfiguration& resolved) {
    Configuration stated;
    static_cast<FitSettings&>(stated) = resolved;
    stated.edition = resolved.edition;
    stated.layers = resolved.layers;
    stated.base = resolved.base;
    stated.incidence_deg = resolved.incidence_deg;
    stated.specular = resolved.specular;
    stated.viewing_cone_deg = resolved.viewing_cone_deg;
    if (!resolved.instrument.empty())
        stated.instrument = NamedInstrument{.name = resolved.instrument, .description = {}};
    stated.bandpass_shape = resolved.bandpass.shape;
    stated.bandpass_width_nm = resolved.bandpass.width_nm;
    stated.quantity = resolved.quantity;
    stated.noise = resolved.noise;
    return stated;
}

Experiment make_experiment(const ResolvedConfiguration& resolved) {
    std::optional<double> viewing_cone_rad;
    if (resolved.viewing_cone_deg) viewing_cone_rad = *resolved.viewing_cone_deg * rad_per_deg;
    return {.values = resolved.values,
            .edition = resolved.edition,
            .layers = resolved.layers,
            .base = resolved.base,
            .incidence_rad = resolved.incidence_deg * rad_per_deg,
            .specular = resolved.specular,
            .viewing_cone_rad = viewing_cone_rad};
}

Experiment make_experiment(const Configuration& configuration) {
    return make_experiment(resolved(configuration));
}

std::optional<Bandpass> bandpass_of(const ResolvedConfiguration& resolved) {
    if (resolved.bandpass.width_nm == 0.0) return std::nullopt;
    return resolved.bandpass;
}

FitInput fit_input(const Configuration& configuration, std::span<const Spectrum> spectra) {
    FitInput input{.stated = with_file_settings(configuration, spectra), .parts = {}};
    for (const Spectrum& spectrum : spectra) {
        input.parts.push_back({.configuration = resolved(input.stated, spectrum), .spectrum = spectrum});
    }
    return input;
}

}  // namespace skinfit
