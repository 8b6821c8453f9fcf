#include <exception>
#include <iostream>

#include "fit/fit.hpp"
#include "fit/preset.hpp"
#include "fit/report.hpp"
#include "measurements/text_reader.hpp"
#include "model/spectrophotometer.hpp"

/// Prints the reflectance of skin with little, some and much melanin; with a file, also what explains its spectrum.
int main(int argc, char** argv) try {
    std::cout << "melanosome_fraction,wavelength_nm,reflectance\n";
    skinfit::Experiment experiment;
    for (const double melanosome_fraction : {0.01, 0.05, 0.2}) {
        experiment.values.skin.melanosome_fraction = melanosome_fraction;
        for (const skinfit::Reading& reading : skinfit::read_by_solver(experiment, {450, 550, 650})) {
            std::cout << melanosome_fraction << ',' << reading.wavelength_nm << ',' << reading.reflectance << '\n';
        }
    }
    if (argc > 1) {
        const skinfit::Spectrum spectrum = skinfit::read_spectrum(argv[1]);
        std::cout << text_report(fit_spectrum(skinfit::measured_configuration(), spectrum, {}));
    }
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
