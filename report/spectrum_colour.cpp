#include "report/spectrum_colour.hpp"

#include <fmt/format.h>

#include <cassert>

#include "model/colour_difference.hpp"
#include "model/srgb.hpp"

namespace skinfit {
namespace {

SpectrumColour colour(const ColourStimulus& stimulus) {
    const SeenColour seen = colour_of(stimulus, {});
    const Rgb encoded = encoded_srgb(linear_srgb(seen.xyz, seen.white));
    const Lab lab = lab_from_xyz(seen.xyz, seen.white);
    return {.lab = lab,
            .hex = hex_string(clipped_to_srgb_gamut(encoded)),
            .is_in_gamut = in_srgb_gamut(encoded),
            .individual_typology_angle_deg = individual_typology_angle_deg(lab)};
}

}  // namespace

std::string why_without_colour(const FittedSpectrum& spectrum) {
    constexpr double first_nm = 420;  // as `colour_of` asks for
    constexpr double last_nm = 680;
    if (spectrum.configuration.quantity != Quantity::reflectance) return "it is a transmittance";
    if (spectrum.wavelength_nm.front() <= first_nm && spectrum.wavelength_nm.back() >= last_nm) return "";
    return fmt::format("its wavelengths, {:g} to {:g} nm, do not reach from {:g} to {:g} nm",
                       spectrum.wavelength_nm.front(), spectrum.wavelength_nm.back(), first_nm, last_nm);
}

FittedColour fitted_colour(const FittedSpectrum& spectrum) {
    assert(why_without_colour(spectrum).empty());
    const SpectrumColour measured = colour({.wavelength_nm = spectrum.wavelength_nm, .value = spectrum.measured});
    const SpectrumColour modelled = colour({.wavelength_nm = spectrum.wavelength_nm, .value = spectrum.modelled});
    return {.measured = measured, .modelled = modelled, .ciede2000 = ciede2000(measured.lab, modelled.lab)};
}

}  // namespace skinfit
