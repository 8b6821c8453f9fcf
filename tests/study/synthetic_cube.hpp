#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fit/configuration.hpp"

namespace skinfit::test {

/// A picture of skin whose parameters are known in every pixel.
struct SyntheticCube {
    Configuration configuration;  ///< of the fit: five free pigments, noise as it was added, geometry
    std::vector<double> wavelength_nm;
    std::size_t samples;
    std::size_t lines;
    std::vector<std::vector<double>> truth;  ///< of each pixel, of the free parameters
    std::vector<double> fractions;           ///< pixel after pixel, all wavelengths of each together
};

/// Melanin, blood, saturation and bilirubin that change over the picture, with a mole and a vessel; every parameter
/// stays away from its bounds. Values are those of the emulator with independent normal noise of `noise`.
[[nodiscard]] SyntheticCube synthetic_cube(std::size_t samples, std::size_t lines, double noise, std::uint64_t seed);

/// Writes it as 32-bit numbers: `header` (ending in hdr) and the data beside it, ending in dat.
void write_synthetic_cube(const SyntheticCube& cube, const std::filesystem::path& header,
                          const std::string& interleave = "bil");

}  // namespace skinfit::test
