#include "measurements/spectrum_building.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "measurements/words.hpp"

namespace skinfit {

namespace {

/// The first readings of runs that ascend, or descend as `sign` is -1.
std::vector<std::size_t> starts_of_runs(std::span<const double> wavelength_nm, double sign) {
    std::vector<std::size_t> starts{0};
    for (std::size_t i = 1; i < wavelength_nm.size(); ++i) {
        if (sign * (wavelength_nm[i] - wavelength_nm[i - 1]) <= 0) starts.push_back(i);
    }
    return starts;
}

/// Runs over mostly the same range are several spectra. Throws InputError for them where no wavelength comes twice, by
/// which they would be told apart later.
void refuse_second_spectrum(std::span<const double> wavelength_nm, std::span<const std::size_t> again,
                            const GridPlace& start) {
    const std::span<const double> before = wavelength_nm.first(again.front());
    const bool repeats = std::ranges::any_of(
        again, [&](std::size_t i) { return std::ranges::find(before, wavelength_nm[i]) != before.end(); });
    if (repeats) return;
    throw InputError(
        {.where = start.where,
         .problem = fmt::format("a second run of wavelengths begins at {} nm", wavelength_nm[again.front()]),
         .why = "it goes over mostly the same range as the one before it, as another spectrum would",
         .remedy = "give each spectrum a column, or a file, of its own"});
}

/// How many of the readings before `start` lie at its wavelength or beyond.
std::size_t reaching_into(std::span<const double> wavelength_nm, double sign, std::size_t start) {
    return static_cast<std::size_t>(std::ranges::count_if(
        wavelength_nm.first(start), [&](double each) { return sign * (each - wavelength_nm[start]) >= 0; }));
}

/// The readings of later detectors at wavelengths that an earlier one has measured; nothing where the wavelengths are
/// no overlapping runs.
std::vector<std::size_t> overlaps(std::span<const double> wavelength_nm,
                                  const std::function<GridPlace(std::size_t)>& place) {
    constexpr std::size_t fewest_readings = 10;  // chosen: fewer may be a slip in one line
    constexpr std::size_t most_detectors = 6;    // chosen: instruments have up to three or four
    if (wavelength_nm.size() < 2 * fewest_readings) return {};
    const double sign = wavelength_nm[1] > wavelength_nm[0] ? 1 : -1;
    std::vector<std::size_t> starts = starts_of_runs(wavelength_nm, sign);
    if (starts.size() < 2 || starts.size() > most_detectors) return {};
    starts.push_back(wavelength_nm.size());
    std::vector<std::size_t> left_out;
    double reached = sign * wavelength_nm[starts[1] - 1];
    for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
        const double last = sign * wavelength_nm[starts[k + 1] - 1];
        if (starts[k + 1] - starts[k] < fewest_readings || (k > 0 && last <= reached)) return {};
        std::size_t shared = 0;
        for (std::size_t i = starts[k]; k > 0 && i < starts[k + 1]; ++i) {
            if (sign * wavelength_nm[i] > reached) continue;
            left_out.push_back(i);
            ++shared;
        }
        if (k > 0 && std::min(shared, reaching_into(wavelength_nm, sign, starts[k])) < 2) return {};  // a slip
        if (2 * shared > starts[k + 1] - starts[k]) {
            refuse_second_spectrum(wavelength_nm, left_out, place(starts[k]));
            return {};
        }
        reached = last;
    }
    return left_out;
}

}  // namespace

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
    if (const std::vector<std::size_t> left_out = overlaps(wavelength_nm, place); !left_out.empty()) {
        std::erase_if(grid.order, [&](std::size_t i) { return std::ranges::binary_search(left_out, i); });
        grid.remark =
            fmt::format("{} readings between {} and {} nm, where a detector overlaps the one before it, are left out",
                        left_out.size(), wavelength_nm[left_out.front()], wavelength_nm[left_out.back()]);
    }
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
    if (!grid.remark.empty()) spectrum.remarks.push_back(grid.remark);
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
    take_unit(spectrum, find_unit(statements, used_values(statements.window, spectrum.wavelength_nm, spectrum.value)));
}

void take_readings(Spectrum& spectrum, const Grid& grid, const Readings& readings, const UnitFinding& found) {
    take_numbers(spectrum, grid, readings);
    take_unit(spectrum, found);
}

std::vector<double> used_values(const WavelengthWindow& window, const Grid& grid, std::span<const double> readings) {
    std::vector<double> in_order;
    for (const std::size_t i : grid.order) in_order.push_back(readings[i]);
    return used_values(window, grid.wavelength_nm, in_order);
}

std::vector<Declared> declared_of_several(std::span<const Declared> declared) {
    std::vector<Declared> sure;
    std::ranges::copy_if(declared, std::back_inserter(sure), [](const Declared& each) {
        const std::string key = bare_key(each.key);
        return key != "points" && key != "channels" && key != "numberofchannels";
    });
    return sure;
}

std::optional<Quantity> quantity_named(std::string_view text) {
    const std::string name = lower_case(text);
    const bool reflectance = name.find("reflectance") != std::string::npos;
    const bool transmittance = name.find("transmittance") != std::string::npos;
    if (reflectance == transmittance) return std::nullopt;
    return reflectance ? Quantity::reflectance : Quantity::transmittance;
}

void name_quantity(Spectrum& spectrum, Quantity named) {
    if (spectrum.quantity && *spectrum.quantity != named) {
        spectrum.doubts.push_back(
            {.message = fmt::format("the file states {}, the name of these values {}, which is taken",
                                    quantity_names[static_cast<std::size_t>(*spectrum.quantity)],
                                    quantity_names[static_cast<std::size_t>(named)]),
             .remedy = "correct the one that is wrong"});
    }
    spectrum.quantity = named;
}

}  // namespace skinfit
