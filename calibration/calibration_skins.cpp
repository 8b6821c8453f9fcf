#include <fmt/format.h>
#include <fmt/os.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "calibration/drawn_skins.hpp"
#include "model/random.hpp"
#include "transport/skin_spectra.hpp"

/// Writes the spectra on which hemoglobin of the dermis is calibrated, `sphere.csv` and `port.csv`, of one and the same
/// skins, and their truth, `manifest.csv`, into the folder that is the only argument. `recipe` says what becomes of
/// them.
namespace skinfit {
namespace {

constexpr std::uint64_t families = 16;
constexpr std::uint64_t skins_of_each = 30;
constexpr std::uint64_t seed = 20;
constexpr double noise = 0.003;
constexpr std::array<const char*, 2> instruments = {"sphere", "port"};

std::vector<double> wavelengths() {
    std::vector<double> grid;
    for (int nm = 400; nm <= 700; nm += 10) grid.push_back(nm);
    return grid;
}

/// An integrating sphere that takes in all light, and one with a port of 5 mm, evenly lit.
SkinTransportOptions transport_options(const DrawnFamily& family, std::uint64_t number) {
    constexpr double port_radius_cm = 0.25;
    return {.gatherings = {Gathering{}, {.spot_radius_cm = port_radius_cm, .port_radius_cm = port_radius_cm}},
            .photons = 30'000,
            .seed = seed + number,
            .bilirubin = family.bilirubin,
            .node_ratio = 1.35};
}

/// Gaussian noise of one reading.
double drawn_noise(std::uint64_t reading) {
    const FourUniforms xi = RandomRay(seed, reading).uniforms(1, 0);
    return noise * std::sqrt(-2.0 * std::log(xi[0])) * std::cos(2.0 * std::numbers::pi * xi[1]);
}

void print_header(fmt::ostream& out) {
    out.print("# skin by a conventional Monte Carlo, drawn by calibration/drawn_skins.cpp\n");
    out.print("# noise: Gaussian, sigma {}\n# quantity: reflectance\n# incidence_deg: 8\n# specular: included\n",
              noise);
    out.print("id");
    for (const double nm : wavelengths()) out.print(",{}", nm);
    out.print("\n");
}

void print_spectra(fmt::ostream& out, const DrawnFamily& family, std::uint64_t number, std::size_t instrument,
                   const SkinReadings& readings) {
    for (std::size_t i = 0; i < family.skins.size(); ++i) {
        const std::uint64_t id = number * skins_of_each + i;
        out.print("s{:03}", id);
        std::uint64_t reading = 100 * (id * instruments.size() + instrument);  // more than there are wavelengths
        for (const PhotonMean& mean : readings[i][instrument]) {
            out.print(",{:.5f}", mean.value + drawn_noise(reading++));
        }
        out.print("\n");
    }
}

void write_manifest(const std::vector<DrawnFamily>& drawn, const std::filesystem::path& folder) {
    auto out = fmt::output_file((folder / "manifest.csv").string());
    out.print("file,spectrum,instrument,true_dermal_hemoglobin_umol_per_l\n");
    for (const char* const instrument : instruments) {
        std::uint64_t id = 0;
        for (const DrawnFamily& family : drawn) {
            for (const LayeredSkin& skin : family.skins) {
                out.print("{}.csv,s{:03},{},{:.4g}\n", instrument, id++, instrument,
                          dermal_hemoglobin_umol_per_l(skin));
            }
        }
    }
}

void write_spectra(const std::filesystem::path& folder) {
    const std::vector<DrawnFamily> drawn = drawn_families(families, skins_of_each, seed);
    write_manifest(drawn, folder);
    auto sphere = fmt::output_file((folder / "sphere.csv").string());
    auto port = fmt::output_file((folder / "port.csv").string());
    for (fmt::ostream* const out : {&sphere, &port}) print_header(*out);
    std::uint64_t number = 0;
    for (const DrawnFamily& family : drawn) {
        const SkinReadings readings = skin_spectra(family.skins, wavelengths(), transport_options(family, number));
        print_spectra(sphere, family, number, 0, readings);
        print_spectra(port, family, number, 1, readings);
        sphere.flush();
        port.flush();
        ++number;
    }
}

}  // namespace
}  // namespace skinfit

int main(int count, char** words) {
    if (count != 2) {
        fmt::print(stderr, "calibration_skins: one folder is needed, for sphere.csv and port.csv\n");
        return 2;
    }
    skinfit::write_spectra(words[1]);
}
