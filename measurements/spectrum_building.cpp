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
    const auto first = std::ranges::adjacent_find(grid.wavelength_nm);
    if (first == grid.wavelength_nm.end()) return grid;
    const std::size_t* const pair = grid.order.data() + (first - grid.wavelength_nm.begin());
    throw InputError({.where = place(pair[1]).where,
                      .problem = fmt::format("repeats the wavelength {} nm", *first),
                      .why = fmt::format("{} has it already", place(pair[0]).which),
                      .remedy = "keep one of the two or average them"});
}

namespace {

/// The readings in the order of the grid, in the unit of the file, without those that are missing.
void take_numbers(Spectrum& spectrum, const Grid& grid, const Readings& readings) {
    spectrum.wavelength_nm.reserve(grid.order.size());
    spectrum.value.reserve(grid.order.size());
    for (std::size_t i = 0; i < grid.order.size(); ++i) {
        const double value = readings.value[grid.order[i]];
        if (std::isnan(value)) continue;
        spectrum.wavelength_nm.push_back(grid.wavelength_nm[i]);
        spectrum.value.push_back(value);
        if (!readings.sigma.empty()) spectrum.sigma.push_back(readings.sigma[grid.order[i]]);
    }
    spectrum.missing = grid.order.size() - spectrum.value.size();
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
    if (!spectrum.value.empty()) take_unit(spectrum, find_unit(statements, spectrum.value));
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
