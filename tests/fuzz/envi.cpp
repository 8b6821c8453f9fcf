#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include "core/input_error.hpp"
#include "measurements/envi_reader.hpp"

namespace {

/// A folder in memory for the two files of a cube, removed when the program ends.
struct Folder {
    std::filesystem::path path;
    Folder() {
        std::string name = "/dev/shm/skinfit_fuzz_XXXXXX";
        if (::mkdtemp(name.data()) == nullptr) std::abort();
        path = name;
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path); }
};

void write(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

/// Reads the bytes as a cube or library: its header up to the first byte 0, then its data.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Folder folder;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const std::size_t end = bytes.find('\0');
    write(folder.path / "a.hdr", bytes.substr(0, end));
    write(folder.path / "a.dat", end == std::string_view::npos ? "" : bytes.substr(end + 1));
    try {
        const std::vector<skinfit::Spectrum> spectra =
            skinfit::read_envi(skinfit::find_envi_files(folder.path / "a.hdr"));
        if (spectra.empty()) std::abort();
        for (const skinfit::Spectrum& spectrum : spectra) {
            if (spectrum.value.empty() || spectrum.value.size() != spectrum.wavelength_nm.size()) std::abort();
        }
    } catch (const skinfit::InputError&) {
    }
    return 0;
}
