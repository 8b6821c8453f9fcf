#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "model/skin.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit::test {

/// A spectrum of an independent Monte Carlo: the sample it describes and what it found.
struct ReferenceSpectrum {
    std::string name;
    Sample sample;
    double incidence_rad = 0.0;
    std::vector<double> wavelengths_nm;
    std::vector<Estimate> reflectance;  ///< surface reflectance included
    std::vector<Estimate> transmittance;
    std::vector<Estimate> surface_reflectance;
};

/// Reads a spectrum from the text of a `../shared/reference/*.csv` file, whose first line names edition, incidence and
/// what differs from [KA04, Table 1]. Throws std::runtime_error on anything it does not know.
[[nodiscard]] ReferenceSpectrum parse_reference_spectrum(std::string_view name, std::string_view text);

/// The spectra in `folder`, in the order of their names; goniophotometer files (`brdf_*`) are left out.
[[nodiscard]] std::vector<ReferenceSpectrum> load_reference_spectra(const std::filesystem::path& folder);

/// `tests/data`, and the folder `shared` beside the project, which may be absent.
[[nodiscard]] std::filesystem::path test_data_folder();
[[nodiscard]] std::filesystem::path shared_folder();

}  // namespace skinfit::test
