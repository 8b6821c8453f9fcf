#include "measurements/wavelength_window.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace skinfit {
namespace {

bool lies_in(double wavelength_nm, const WavelengthWindow::Range& range) {
    return wavelength_nm >= range.lowest_nm && wavelength_nm <= range.highest_nm;
}

}  // namespace

bool WavelengthWindow::contains(double wavelength_nm) const {
    return lies_in(wavelength_nm, range) &&
           std::ranges::none_of(excluded, [&](const Range& each) { return lies_in(wavelength_nm, each); });
}

Spectrum part_of(const Spectrum& spectrum, const WavelengthWindow& window) {
    Spectrum part = spectrum;
    const auto keep = [&](std::vector<double>& numbers) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (window.contains(spectrum.wavelength_nm[i])) numbers[kept++] = numbers[i];
        }
        numbers.resize(kept);
    };
    keep(part.wavelength_nm);
    keep(part.value);
    keep(part.sigma);
    for (std::vector<double>& repeat : part.repeats) keep(repeat);
    std::erase_if(part.missing_nm, [&](double nm) { return !window.contains(nm); });
    std::erase_if(part.repeated, [&](const RepeatedWavelength& each) { return !window.contains(each.wavelength_nm); });
    return part;
}

std::vector<double> used_values(const WavelengthWindow& window, std::span<const double> wavelength_nm,
                                std::span<const double> values) {
    assert(wavelength_nm.size() == values.size());
    std::vector<double> present;
    std::vector<double> used;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isnan(values[i])) continue;
        present.push_back(values[i]);
        if (window.contains(wavelength_nm[i])) used.push_back(values[i]);
    }
    return used.empty() ? present : used;
}

}  // namespace skinfit
