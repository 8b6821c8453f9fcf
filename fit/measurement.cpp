#include "fit/measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/input_error.hpp"
#include "fit/viewing.hpp"
#include "fit/wavelength_sets.hpp"
#include "measurements/text_reader.hpp"
#include "measurements/wavelength_window.hpp"
#include "model/constants.hpp"

namespace skinfit {
namespace {

bool lies_in(double wavelength_nm, const Bounds& range_nm) {
    return wavelength_nm >= range_nm.lower && wavelength_nm <= range_nm.upper;
}

double weight_at(double wavelength_nm, const ResolvedConfiguration& configuration) {
    const auto found = std::ranges::find_if(
        configuration.weights, [&](const Weight& weight) { return lies_in(wavelength_nm, weight.range_nm); });
    return found == configuration.weights.end() ? 1.0 : found->weight;
}

void take_data(Measurement& measurement, const ResolvedConfiguration& configuration, const Spectrum& spectrum) {
    const Spectrum used = part_of(spectrum, window_of(configuration));
    refuse_repeated(used);
    for (std::size_t i = 0; i < used.wavelength_nm.size(); ++i) {
        refuse_sigma(used, i, [&](std::size_t) { return ValuePlace{.where = used.source}; });
        measurement.wavelength_nm.push_back(used.wavelength_nm[i]);
        measurement.measured.push_back(used.value[i]);
        measurement.sigma.push_back(used.sigma.empty() ? configuration.noise : used.sigma[i]);
        if (!configuration.weights.empty())
            measurement.weight.push_back(weight_at(used.wavelength_nm[i], configuration));
    }
    if (measurement.wavelength_nm.empty()) {
        const bool excluded = !configuration.exclude_nm.empty();
        throw InputError({.where = excluded ? "exclude_nm" : "wavelength_min_nm, wavelength_max_nm",
                          .problem = excluded ? "leaves no wavelength of the window" : "leave no wavelength",
                          .why = excluded ? "there is nothing to fit" : "the file has none between them",
                          .remedy = excluded ? "exclude less, or widen the window" : "widen the window"});
    }
    if (measurement.wavelength_nm.size() > most_wavelengths) {
        throw InputError(
            {.where = spectrum.source,
             .problem = fmt::format("holds {} wavelengths between {:g} and {:g} nm", measurement.wavelength_nm.size(),
                                    configuration.wavelength_min_nm, configuration.wavelength_max_nm),
             .why = fmt::format("at most {} are fitted", most_wavelengths),
             .remedy = "average neighbours, or narrow the window"});
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

void check_wavelengths(const ResolvedConfiguration& configuration, const Spectrum& spectrum) {
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

Measurement make_measurement(const ResolvedConfiguration& configuration, const Spectrum& spectrum) {
    check_viewing_cone(configuration);
    check_wavelengths(configuration, spectrum);
    Measurement measurement{
        .name = spectrum.name,
        .source = spectrum.source,
        .unit_rule = spectrum.unit_rule,
        .configuration = configuration,
        .experiment = make_experiment(configuration),
        .quantity = configuration.quantity,
        .wavelength_nm = {},
        .measured = {},
        .sigma = {},
        .sigma_source = spectrum.sigma.empty()
                            ? fmt::format("{} at every wavelength (setting noise)", configuration.noise)
                            : spectrum.sigma_source + ", in place of the setting noise",
        .walk = {.incidence_rad = configuration.incidence_deg * rad_per_deg,
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
