#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace skinfit::test {

/// An ENVI cube to be written byte by byte, without any library: the value of a pixel is a whole number that every type
/// can hold, or what is given.
struct MadeCube {
    std::size_t samples = 5;
    std::size_t lines = 4;
    std::size_t bands = 3;
    std::string interleave = "bsq";
    int data_type = 12;
    bool most_significant_byte_first = false;
    std::size_t header_offset = 0;
    std::string more = "wavelength = {400, 500, 600}\nreflectance scale factor = 100\n";  ///< further header lines
    std::vector<double> given{};  ///< pixel after pixel, with all bands of each together

    /// What is given, else from 1 to 120 while the cube has no more than 120 numbers.
    [[nodiscard]] double number(std::size_t line, std::size_t sample, std::size_t band) const {
        if (!given.empty()) return given[(line * samples + sample) * bands + band];
        return static_cast<double>(1 + (band * lines + line) * samples + sample);
    }
};

/// The header, as instruments write it.
[[nodiscard]] std::string header_text(const MadeCube& cube);

/// The bytes of `numbers` in an ENVI data type.
[[nodiscard]] std::string stored(const std::vector<double>& numbers, int data_type, bool most_significant_byte_first);

/// The cube's numbers in the order of its data.
[[nodiscard]] std::vector<double> numbers_in_order(const MadeCube& cube);

/// Writes `header` (ending in hdr) and the data beside it, ending in dat.
void write_cube(const std::filesystem::path& header, const MadeCube& cube);

void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace skinfit::test
