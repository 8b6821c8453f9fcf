#include "tests/study/synthetic_cube.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "fit/emulation.hpp"
#include "fit/measurement.hpp"
#include "fit/problem.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/measurements/made_cube.hpp"

namespace skinfit::test {
namespace {

Configuration configuration_with(double noise) {
    Configuration configuration =
        with_free(default_configuration(),
                  {Parameter::melanosome_fraction, Parameter::papillary_blood_fraction,
                   Parameter::reticular_blood_fraction, Parameter::oxygen_saturation, Parameter::bilirubin_g_per_l});
    configuration.engine = Engine::emulator;
    configuration.incidence_deg = 8;
    configuration.specular = Specular::included;
    configuration.noise = noise;
    return configuration;
}

/// The skin at a place, both coordinates from 0 to 1.
Skin skin_at(Skin skin, double x, double y) {
    const double mole = std::exp(-(std::pow(x - 0.7, 2.0) + std::pow(y - 0.3, 2.0)) / 0.01);
    const double vessel = std::exp(-std::pow((y - 0.7 - 0.1 * std::sin(6.0 * x)) / 0.05, 2.0));
    skin.melanosome_fraction = 0.03 + 0.03 * x + 0.1 * mole;
    skin.papillary_blood_fraction = 0.01 + 0.02 * y;
    skin.reticular_blood_fraction = 0.015 + 0.03 * vessel;
    skin.oxygen_saturation = 0.75 - 0.25 * x;
    skin.bilirubin_g_per_l = 0.3 + 0.7 * y;
    return skin;
}

}  // namespace

SyntheticCube synthetic_cube(std::size_t samples, std::size_t lines, double noise, std::uint64_t seed) {
    SyntheticCube cube{.configuration = configuration_with(noise),
                       .wavelength_nm = grid_nm(400, 700, 10),
                       .samples = samples,
                       .lines = lines,
                       .truth = {},
                       .fractions = {}};
    Configuration here = cube.configuration;
    const Emulator emulator = Emulator::build(emulator_domain(here, Side::top, cube.wavelength_nm));
    const std::vector<double> normal = normal_numbers(seed, samples * lines * cube.wavelength_nm.size());
    for (std::size_t pixel = 0; pixel < samples * lines; ++pixel) {
        const double x = (static_cast<double>(pixel % samples) + 0.5) / static_cast<double>(samples);
        const auto line = pixel / samples;
        const double y = (static_cast<double>(line) + 0.5) / static_cast<double>(lines);
        here.values.skin = skin_at(cube.configuration.values.skin, x, y);
        cube.truth.emplace_back();
        for (const Parameter parameter : free_parameters(here)) {
            cube.truth.back().push_back(value_of(here.values, parameter));
        }
        for (const Reading& reading :
             read_by_emulator(make_experiment(here), cube.wavelength_nm, emulator, std::nullopt)) {
            cube.fractions.push_back(reading.reflectance + noise * normal[cube.fractions.size()]);
        }
    }
    return cube;
}

void write_synthetic_cube(const SyntheticCube& cube, const std::filesystem::path& header,
                          const std::string& interleave) {
    write_cube(header,
               {.samples = cube.samples,
                .lines = cube.lines,
                .bands = cube.wavelength_nm.size(),
                .interleave = interleave,
                .data_type = 4,
                .more = fmt::format("wavelength = {{{}}}\nmap info = {{UTM, 1, 1, 5, 6, 0.5, 0.5, 33, North}}\n",
                                    fmt::join(cube.wavelength_nm, ", ")),
                .given = cube.fractions});
}

}  // namespace skinfit::test
