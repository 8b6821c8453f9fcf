#include "measurements/spectrum_building.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "measurements/words.hpp"

namespace skinfit {

Grid make_grid(std::span<const double> wavelength_nm, const std::function<GridPlace(std::size_t)>& place) {
    for (std::size_t i = 0; i < wavelength_nm.size(); ++i) {
        if (wavelength_range_nm.contains(wavelength_nm[i])) continue;
        throw InputError({.where = place(i).where,
                          .problem = fmt::format("the wavelength is {} nm", wavelength_nm[i]),
                          .why = fmt::format("it must lie between {} and {} nm", wavelength_range_nm.lowest,
                                             wavelength_range_nm.highest),
                          .remedy = "give wavelengths in nanometres, or name their unit in the header"});
    }
    Grid grid;
    grid.order.resize(wavelength_nm.size());
    std::iota(grid.order.begin(), grid.order.end(), std::size_t{0});
    std::ranges::stable_sort(grid.order, {}, [&](std::size_t i) { return wavelength_nm[i]; });
    for (const std::size_t i : grid.order) grid.wavelength_nm.push_back(wavelength_nm[i]);
    for (std::size_t i = 1; i < grid.order.size() && grid.repeated.size() < most_repeated; ++i) {
        if (grid.wavelength_nm[i] != grid.wavelength_nm[i - 1]) continue;
        grid.repeated.push_back({.wavelength_nm = grid.wavelength_nm[i],
                                 .where = place(grid.order[i]).where,
                                 .first = place(grid.order[i - 1]).which});
    }
    return grid;
}

namespace {

/// The readings in the order of the grid, in the unit of the file, without those that are missing.
void take_numbers(Spectrum& spectrum, const Grid& grid, const Readings& readings) {
    spectrum.wavelength_nm.reserve(grid.order.size());
    spectrum.value.reserve(grid.order.size());
    for (std::size_t i = 0; i < grid.order.size(); ++i) {
        const double value = readings.value[grid.order[i]];
        if (std::isnan(value)) {
            spectrum.missing_nm.push_back(grid.wavelength_nm[i]);
            continue;
        }
        spectrum.wavelength_nm.push_back(grid.wavelength_nm[i]);
        spectrum.value.push_back(value);
        if (!readings.sigma.empty()) spectrum.sigma.push_back(readings.sigma[grid.order[i]]);
    }
    spectrum.repeated = grid.repeated;
    // Where one of the two has no value, there is one value.
    std::erase_if(spectrum.repeated, [&](const RepeatedWavelength& each) {
        const auto [first, last] = std::ranges::equal_range(spectrum.wavelength_nm, each.wavelength_nm);
        return last - first < 2;
    });
}

void take_unit(Spectrum& spectrum, const UnitFinding& found) {
    spectrum.unit_rule = found.rule;
    if (found.unit == Unit::fraction) return;
    for (double& value : spectrum.value) value /= 100;
    for (double& sigma : spectrum.sigma) sigma /= 100;
}

}  // namespace

void take_readings(Spectrum& spectrum, const Grid& grid, const Readings& readings, const UnitStatements& statements) {
    take_numbers(spectrum, grid, readings);
    if (spectrum.value.empty()) return;
    std::vector<double> used;
    for (std::size_t i = 0; i < spectrum.value.size(); ++i) {
        if (statements.window.contains(spectrum.wavelength_nm[i])) used.push_back(spectrum.value[i]);
    }
    take_unit(spectrum, find_unit(statements, used.empty() ? spectrum.value : used));
}

void take_readings(Spectrum& spectrum, const Grid& grid, const Readings& readings, const UnitFinding& found) {
    take_numbers(spectrum, grid, readings);
    take_unit(spectrum, found);
}

std::optional<Quantity> quantity_named(std::string_view text) {
    const std::string name = lower_case(text);
    const bool reflectance = name.find("reflectance") != std::string::npos;
    const bool transmittance = name.find("transmittance") != std::string::npos;
    if (reflectance == transmittance) return std::nullopt;
    return reflectance ? Quantity::reflectance : Quantity::transmittance;
}

}  // namespace skinfit
