#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/input_error.hpp"
#include "measurements/spectrum_file.hpp"

/// Reads the bytes with the reader SKINFIT_FUZZED_READER. Whatever they are, they give spectra that are what
/// `Spectrum` promises, or an InputError.
namespace skinfit {
namespace {

void require(bool law) {
    if (!law) std::abort();
}

void check(const Spectrum& spectrum) {
    require(!spectrum.wavelength_nm.empty());
    require(spectrum.value.size() == spectrum.wavelength_nm.size());
    require(spectrum.sigma.empty() || spectrum.sigma.size() == spectrum.value.size());
    for (std::size_t i = 0; i < spectrum.value.size(); ++i) {
        require(std::isfinite(spectrum.value[i]));
        require(spectrum.wavelength_nm[i] >= 100 && spectrum.wavelength_nm[i] <= 10000);
        require(i == 0 || spectrum.wavelength_nm[i - 1] < spectrum.wavelength_nm[i]);
    }
    for (const std::vector<double>& repeat : spectrum.repeats) require(repeat.size() == spectrum.value.size());
}

}  // namespace
}  // namespace skinfit

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace skinfit;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const std::string_view reader = SKINFIT_FUZZED_READER;
    try {
        const SpectrumFile file =
            parse_spectra(text, "fuzz", {}, reader == "any" ? std::nullopt : std::optional<std::string>(reader));
        require(!file.spectra.empty());
        for (const Spectrum& spectrum : file.spectra) check(spectrum);
    } catch (const InputError& error) {
        require(std::string_view(error.what()).find('\n') == std::string_view::npos);
    }
    return 0;
}
