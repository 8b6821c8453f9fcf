#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skinfit {

/// What the numbers along a spectrum are, as its file states it.
struct Abscissa {
    std::string name{};          ///< of the unit, as `nm`, `THz` or `1/cm`
    double nm_per_unit = 1;      ///< wavelength = number times this; 0 where they are reciprocal
    double nm_times_unit = 0;    ///< wavelength = this over the number; 0 where they are proportional
    std::string unusable{};      ///< the words by which they are no wavelengths at all, as `Raman shift (cm-1)`
    bool named_by_unit = false;  ///< a unit was stated, not only the word wavelength

    /// Whether the numbers are wavelengths in nm as they stand.
    [[nodiscard]] bool is_nm() const { return nm_per_unit == 1 && unusable.empty(); }
};

/// What a name states about an abscissa: `Wavelength (nm)`, `lambda`, `X [1/cm]`, `Frequency (THz)`, `Energy [eV]`,
/// `Raman shift`, `pixel`; nothing where it speaks of none. Wavelengths without a unit are taken as nm, wavenumbers as
/// 1/cm.
[[nodiscard]] std::optional<Abscissa> abscissa_stated(std::string_view text);

/// True for the name of a column of wavelengths or their like: one that speaks of them, or a unit alone as in `nm`.
/// That a name holds a unit, as in `spot of 3 mm`, is not enough.
[[nodiscard]] bool is_abscissa_name(std::string_view name);

/// What the corner of a table with a spectrum in each row states of the numbers beside it: `wavelength (nm)`, or what
/// stands behind a stroke as in `sample \ THz`.
[[nodiscard]] std::optional<Abscissa> abscissa_in_corner(std::string_view corner);

/// The wavelengths, nm, that `numbers` in this unit are in vacuum. Numbers must not be 0 where they are reciprocal.
[[nodiscard]] std::vector<double> wavelengths_nm(const Abscissa& abscissa, std::span<const double> numbers);

/// Throws InputError at `where` for an abscissa that is unusable.
void refuse_unusable(const Abscissa& abscissa, const std::string& where);

}  // namespace skinfit
