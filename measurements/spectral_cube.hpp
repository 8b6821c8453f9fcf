#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "measurements/envi_files.hpp"
#include "measurements/unit_rule.hpp"

namespace skinfit {

/// The unit of a cube's numbers.
struct CubeScale {
    double one;        ///< the number that stands for 1, after gains and offsets
    std::string rule;  ///< how it was found, in words
    bool stated;
};

/// A picture with a spectrum in every pixel, in an ENVI file, of which no more than some lines are in memory at a time.
///
/// Unit: the header's gains and offsets are applied; then the numbers are divided by its `reflectance scale factor`;
/// where it has none, they are fractions, or percent where `unit` or the header's titles say so. `unit` goes before
/// the header's factor and titles. One thread at a time may use a cube.
class SpectralCube {
public:
    /// `path` names the header or the data. Throws InputError as `find_envi_files` and `read_envi_header`; when the
    /// header has no wavelengths, marks all bands as bad, or gives a good one a wavelength outside [100, 10000] nm; for
    /// whole numbers without a scale factor or gains; for a classification, for values that the header calls no shares
    /// of light (a word of its description apart, where `unit` is given); and as `open_envi_data`.
    explicit SpectralCube(const std::filesystem::path& path, std::optional<Unit> unit = {});
    /// The same of files that have been found.
    explicit SpectralCube(EnviFiles files, std::optional<Unit> unit = {});

    /// What it was opened from.
    [[nodiscard]] const EnviFiles& files() const { return files_; }
    [[nodiscard]] const EnviHeader& header() const { return header_; }

    /// Pixels in a line.
    [[nodiscard]] std::size_t samples() const { return header_.samples; }
    [[nodiscard]] std::size_t lines() const { return header_.lines; }

    /// The good bands, counted from 0 as in the file, by ascending wavelength.
    [[nodiscard]] const std::vector<std::size_t>& bands() const { return bands_; }

    /// Their wavelengths.
    [[nodiscard]] const std::vector<double>& wavelength_nm() const { return wavelength_nm_; }

    /// How the unit of the values was found, in words.
    [[nodiscard]] const std::string& unit_rule() const { return scale_.rule; }

    /// Whether it is stated, by the header or by `unit`.
    [[nodiscard]] bool has_stated_unit() const { return scale_.stated; }

    /// The fraction that the number 0 of the data is in the good band `i`, after its gain and offset.
    [[nodiscard]] double fraction_of_zero(std::size_t i) const;

    /// The lines that take some 24 MB when read at once, at least 1: few enough for little memory, and enough for long
    /// runs of bytes in bsq files.
    [[nodiscard]] std::size_t lines_at_once() const;

    /// The fractions of `count` lines from line `first` on: pixel after pixel, the values of `bands()` of each
    /// together. NaN for numbers that are not finite or stand for no measurement: the header's `data ignore value`,
    /// -9999, -32768 and 1e30 or more; and in all bands of a pixel whose numbers are one and the same in three good
    /// bands or more, as where what lies outside the object was set to 0. Throws InputError when the data cannot be
    /// read.
    [[nodiscard]] std::vector<double> read_lines(std::size_t first, std::size_t count) const;

private:
    /// Whether a number of the file stands for no measurement.
    [[nodiscard]] bool is_missing(double number) const;
    /// The fraction that a number of the file is in the good band `i`.
    [[nodiscard]] double fraction(double number, std::size_t i) const;

    EnviFiles files_;
    EnviHeader header_;
    std::vector<std::size_t> bands_;
    std::vector<double> wavelength_nm_;
    CubeScale scale_;
    double ignored_;  ///< as it reads when stored in the data's type; NaN where there is none
    Raster numbers_;
};

}  // namespace skinfit
