#pragma once

#include <vector>

namespace skinfit {

/// The light a specimen is seen in: CIE standard illuminant D65, or the same power at every wavelength.
enum class Illuminant { d65, equal_energy };

/// The CIE standard observers of 1931 (2 degrees) and 1964 (10 degrees). [CIE15]
enum class Observer { two_degrees, ten_degrees };

/// Who sees it, in which light.
struct Viewing {
    Illuminant illuminant = Illuminant::d65;
    Observer observer = Observer::two_degrees;
};

/// CIE tristimulus values, Y = 100 for the perfect diffuser.
struct Xyz {
    double x, y, z;
};

/// A reflectance or transmittance, to be looked at. Entry i of both vectors belongs to one wavelength.
struct ColourStimulus {
    std::vector<double> wavelength_nm;  ///< ascends strictly
    std::vector<double> value;          ///< fractions, 1 for the perfect diffuser or the perfect transmitter
};

/// The colour of a spectrum, and how much of it the spectrum did not tell.
struct SeenColour {
    Xyz xyz;
    Xyz white;              ///< of the perfect diffuser, seen in the same way
    Xyz held_share;         ///< shares of the white's X, Y and Z that lie beyond the ends of the spectrum, 0 to 1
    double widest_step_nm;  ///< between neighbouring wavelengths of the spectrum in the visible range
};

/// The tristimulus values of the perfect diffuser.
[[nodiscard]] Xyz white(const Viewing& viewing);

/// The colour of a spectrum: the sum of [CIE15] from 380 to 780 nm in steps of 5 nm, with the spectrum linear between
/// its wavelengths and holding its first and last value beyond them. Throws InputError unless the spectrum reaches
/// from 420 to 680 nm or further; there the shares held are below 0.017, 0.003 and 0.06 of X, Y and Z.
[[nodiscard]] SeenColour colour_of(const ColourStimulus& stimulus, const Viewing& viewing);

}  // namespace skinfit
