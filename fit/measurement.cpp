#include "fit/measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/input_error.hpp"
#include "fit/named_instrument.hpp"
#include "fit/viewing.hpp"
#include "model/constants.hpp"

namespace skinfit {
namespace {

bool lies_in(double wavelength_nm, const Bounds& range_nm) {
    return wavelength_nm >= range_nm.lower && wavelength_nm <= range_nm.upper;
}

bool is_fitted(double wavelength_nm, const Configuration& configuration) {
    return lies_in(wavelength_nm, {configuration.wavelength_min_nm, configuration.wavelength_max_nm}) &&
           std::ranges::none_of(configuration.exclude_nm,
                                [&](const Bounds& range_nm) { return lies_in(wavelength_nm, range_nm); });
}

double weight_at(double wavelength_nm, const Configuration& configuration) {
    const auto found = std::ranges::find_if(
        configuration.weights, [&](const Weight& weight) { return lies_in(wavelength_nm, weight.range_nm); });
    return found == configuration.weights.end() ? 1.0 : found->weight;
}

void take_data(Measurement& measurement, const Configuration& configuration, const Spectrum& spectrum) {
    for (std::size_t i = 0; i < spectrum.wavelength_nm.size(); ++i) {
        const double wavelength_nm = spectrum.wavelength_nm[i];
        if (!is_fitted(wavelength_nm, configuration)) continue;
        measurement.wavelength_nm.push_back(wavelength_nm);
        measurement.measured.push_back(spectrum.value[i]);
        measurement.sigma.push_back(spectrum.sigma.empty() ? configuration.noise.value() : spectrum.sigma[i]);
        if (!configuration.weights.empty()) measurement.weight.push_back(weight_at(wavelength_nm, configuration));
    }
    if (measurement.wavelength_nm.empty()) {
        const bool excluded = !configuration.exclude_nm.empty();
        throw InputError({.where = excluded ? "exclude_nm" : "wavelength_min_nm, wavelength_max_nm",
                          .problem = excluded ? "leaves no wavelength of the window" : "leave no wavelength",
                          .why = excluded ? "there is nothing to fit" : "the file has none between them",
                          .remedy = excluded ? "exclude less, or widen the window" : "widen the window"});
    }
    const bool constant =
        std::ranges::adjacent_find(measurement.measured, std::not_equal_to<>{}) == measurement.measured.end();
    if (measurement.measured.size() > 2 && constant) {
        throw InputError({.where = spectrum.source,
                          .problem = fmt::format("all {} values in the window are {}", measurement.measured.size(),
                                                 measurement.measured.front()),
                          .why = "no skin looks the same at every wavelength",
                          .remedy = "check the column and the file"});
    }
}

void check_wavelengths(const Configuration& configuration, const Spectrum& spectrum) {
    if (configuration.wavelength_min_nm > configuration.wavelength_max_nm) {
        throw InputError({.where = "wavelength_min_nm, wavelength_max_nm",
                          .problem = fmt::format("{} nm is not below {} nm", configuration.wavelength_min_nm,
                                                 configuration.wavelength_max_nm),
                          .why = "no wavelength lies between them",
                          .remedy = "exchange them, or set both"});
    }
    const WavelengthRange modelled = modelled_wavelengths();
    if (configuration.wavelength_min_nm < modelled.lowest_nm || configuration.wavelength_max_nm > modelled.highest_nm) {
        throw InputError(
            {.where = "wavelength_min_nm, wavelength_max_nm",
             .problem = fmt::format("{} to {} nm reaches outside the tables", configuration.wavelength_min_nm,
                                    configuration.wavelength_max_nm),
             .why = fmt::format("the pigments are tabulated from {} to {} nm", modelled.lowest_nm, modelled.highest_nm),
             .remedy = "narrow the window of the fit"});
    }
    if (spectrum.wavelength_nm.front() > configuration.wavelength_max_nm ||
        spectrum.wavelength_nm.back() < configuration.wavelength_min_nm) {
        throw InputError({.where = spectrum.source,
                          .problem = fmt::format("measured from {} to {} nm", spectrum.wavelength_nm.front(),
                                                 spectrum.wavelength_nm.back()),
                          .why = fmt::format("nothing of it lies in the window of the fit, {} to {} nm",
                                             configuration.wavelength_min_nm, configuration.wavelength_max_nm),
                          .remedy = fmt::format("check that wavelengths are in nm, or move the window with --set "
                                                "wavelength_min_nm=... and wavelength_max_nm=... within {} to {} nm",
                                                modelled.lowest_nm, modelled.highest_nm)});
    }
}

/// The geometry where neither the configuration nor its instrument nor a file states it.
Configuration with_default_geometry(Configuration configuration) {
    configuration = with_instrument(std::move(configuration));
    const bool cone = configuration.viewing_cone_deg.has_value();
    configuration.incidence_deg =
        configuration.incidence_deg.value_or(cone ? default_incidence_deg_with_cone : default_incidence_deg);
    configuration.specular = configuration.specular.value_or(cone ? default_specular_with_cone : default_specular);
    return configuration;
}

/// What the file states is taken where neither the configuration nor its instrument does, and after that the instrument
/// that the file names, if it is one of ours.
Configuration with_file(Configuration configuration, const Spectrum& spectrum) {
    configuration = with_instrument(std::move(configuration));
    configuration = with_stated(std::move(configuration), spectrum.geometry, spectrum.bandpass);
    const std::vector<std::string> names = instrument_names();
    if (configuration.instrument || std::ranges::find(names, spectrum.instrument) == names.end()) return configuration;
    configuration.instrument = spectrum.instrument;
    return with_instrument(std::move(configuration));
}

/// The bands of the readings must not lead the model outside the tables.
void check_bands(const Measurement& measurement) {
    const WavelengthRange modelled = modelled_wavelengths();
    const double lowest = measurement.bands.wavelength_nm.front();
    const double highest = measurement.bands.wavelength_nm.back();
    if (lowest >= modelled.lowest_nm && highest <= modelled.highest_nm) return;
    throw InputError(
        {.where = "bandpass_width_nm",
         .problem = fmt::format("the bands of the readings reach to {:g} and {:g} nm", lowest, highest),
         .why = fmt::format("the pigments are tabulated from {} to {} nm", modelled.lowest_nm, modelled.highest_nm),
         .remedy = "narrow the window of the fit, or the bandpass"});
}

/// Of the readings at wavelengths that both have.
void check_sum(const Measurement& reflected, const Measurement& transmitted) {
    constexpr double far_beyond_noise = 3.0;  // sigmas
    for (std::size_t i = 0; i < reflected.wavelength_nm.size(); ++i) {
        const auto found = std::ranges::find(transmitted.wavelength_nm, reflected.wavelength_nm[i]);
        if (found == transmitted.wavelength_nm.end()) continue;
        const auto k = static_cast<std::size_t>(found - transmitted.wavelength_nm.begin());
        const double sum = reflected.measured[i] + transmitted.measured[k];
        const double sigma = std::hypot(reflected.sigma[i], transmitted.sigma[k]);
        if (sum <= 1.0 + far_beyond_noise * sigma) continue;
        throw InputError(
            {.where = fmt::format("{}, {}", reflected.source, transmitted.source),
             .problem = fmt::format("reflectance {:.4g} and transmittance {:.4g} at {} nm add up to {:.4g}",
                                    reflected.measured[i], transmitted.measured[k], reflected.wavelength_nm[i], sum),
             .why = fmt::format("no specimen returns more light than it gets, and noise of {:.2g} does not explain it",
                                sigma),
             .remedy = "check units, calibration and whether both belong to one specimen"});
    }
}

}  // namespace

Experiment make_experiment(const Configuration& configuration) {
    const Configuration complete = with_default_geometry(configuration);
    std::optional<double> viewing_cone_rad;
    if (complete.viewing_cone_deg) viewing_cone_rad = *complete.viewing_cone_deg * rad_per_deg;
    return {.values = configuration.values,
            .edition = configuration.edition,
            .layers = configuration.layers,
            .base = resolved_base(configuration),
            .incidence_rad = *complete.incidence_deg * rad_per_deg,
            .specular = *complete.specular,
            .viewing_cone_rad = viewing_cone_rad};
}

Configuration resolved(Configuration configuration, const Spectrum& spectrum) {
    configuration = with_default_geometry(with_file(std::move(configuration), spectrum));
    configuration.bandpass_width_nm = configuration.bandpass_width_nm.value_or(0.0);
    configuration.bandpass_shape = configuration.bandpass_shape.value_or(BandpassShape::triangular);
    configuration.base = resolved_base(configuration);
    configuration.noise = configuration.noise.value_or(default_noise);
    configuration.quantity = configuration.quantity.value_or(spectrum.quantity.value_or(default_quantity));
    return configuration;
}

std::optional<Bandpass> bandpass_of(const Configuration& configuration) {
    const double width_nm = configuration.bandpass_width_nm.value_or(0.0);
    if (width_nm == 0.0) return std::nullopt;
    return Bandpass{.shape = configuration.bandpass_shape.value_or(BandpassShape::triangular), .width_nm = width_nm};
}

Measurement make_measurement(const Configuration& configuration, const Spectrum& spectrum) {
    check_viewing_cone(configuration);
    check_wavelengths(configuration, spectrum);
    Measurement measurement{
        .source = spectrum.source,
        .experiment = make_experiment(configuration),
        .quantity = configuration.quantity.value(),
        .wavelength_nm = {},
        .measured = {},
        .sigma = {},
        .sigma_source = spectrum.sigma.empty()
                            ? fmt::format("{} at every wavelength (setting noise)", configuration.noise.value())
                            : spectrum.sigma_source,
        .walk = {.incidence_rad = configuration.incidence_deg.value() * rad_per_deg,
                 .rays = configuration.rays,
                 .seed = configuration.seed}};
    take_data(measurement, configuration, spectrum);
    measurement.bands = sample_bands(measurement.wavelength_nm, bandpass_of(configuration));
    check_bands(measurement);
    return measurement;
}

void check_consistency(std::span<const Measurement> measurements) {
    for (std::size_t a = 0; a < measurements.size(); ++a) {
        for (std::size_t b = a + 1; b < measurements.size(); ++b) {
            const Measurement& one = measurements[a];
            const Measurement& other = measurements[b];
            if (one.measured == other.measured && one.wavelength_nm == other.wavelength_nm) {
                throw InputError({.where = fmt::format("{}, {}", one.source, other.source),
                                  .problem = fmt::format("spectra {} and {} hold the same values", a + 1, b + 1),
                                  .why = "no two measurements agree in every digit, and one counted twice makes "
                                         "intervals too narrow",
                                  .remedy = "give each spectrum once, and check --column"});
            }
            if (one.quantity == other.quantity || one.experiment.viewing_cone_rad ||
                other.experiment.viewing_cone_rad) {
                continue;
            }
            const bool first_reflects = one.quantity == Quantity::reflectance;
            check_sum(first_reflects ? one : other, first_reflects ? other : one);
        }
    }
}

}  // namespace skinfit
