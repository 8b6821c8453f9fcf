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
    double one;        ///< the number that stands for 1
    std::string rule;  ///< how it was found, in words
};

/// A picture with a spectrum in every pixel, in an ENVI file, of which no more than some lines are in memory at a time.
///
/// Unit: the numbers are divided by the header's `reflectance scale factor`; where it has none, they are fractions, or
/// percent where `unit` says so. `unit` goes before the header. One thread at a time may use a cube.
class SpectralCube {
public:
    /// `path` names the header or the data. Throws InputError as `find_envi_files` and `read_envi_header`; when the
    /// header has no wavelengths, marks all bands as bad, or gives a good one a wavelength outside [100, 10000] nm;
    /// for whole numbers without a scale factor; and as `open_envi_data`.
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

    /// The lines that take some 24 MB when read at once, at least 1: few enough for little memory, and enough for long
    /// runs of bytes in bsq files.
    [[nodiscard]] std::size_t lines_at_once() const;

    /// The fractions of `count` lines from line `first` on: pixel after pixel, the values of `bands()` of each
    /// together; NaN for numbers that are the header's `data ignore value` or not finite. Throws InputError when the
    /// data cannot be read.
    [[nodiscard]] std::vector<double> read_lines(std::size_t first, std::size_t count) const;

private:
    EnviFiles files_;
    EnviHeader header_;
    std::vector<std::size_t> bands_;
    std::vector<double> wavelength_nm_;
    CubeScale scale_;
    double ignored_;  ///< as it reads when stored in the data's type; NaN where there is none
    Raster numbers_;
};

}  // namespace skinfit
