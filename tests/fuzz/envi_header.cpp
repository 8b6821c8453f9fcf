#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/input_error.hpp"
#include "measurements/envi_header.hpp"

/// Reads the bytes as the header of a cube: it is what `EnviHeader` promises, or an InputError says why not.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const auto header = skinfit::parse_envi_header({reinterpret_cast<const char*>(data), size}, "fuzz");
        const bool good = header.samples > 0 && header.lines > 0 && header.good.size() == header.bands &&
                          header.data_file_bytes() > 0 &&
                          (header.wavelength_nm.empty() || header.wavelength_nm.size() == header.bands);
        if (!good) std::abort();
    } catch (const skinfit::InputError&) {
    }
    return 0;
}
