#include "model/emulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>
#include <utility>

#include "core/input_error.hpp"

namespace skinfit {
namespace {

[[noreturn]] void refuse(std::size_t layer, double depth, double lowest, double highest) {
    throw InputError({.where = "engine emulator",
                      .problem = fmt::format("an optical depth of {:.6g} in the {} lies outside its domain", depth,
                                             layer_in_words(layer)),
                      .why = fmt::format("it was made for {:.6g} to {:.6g}, which follow from the bounds of the free "
                                         "parameters",
                                         lowest, highest),
                      .remedy = "keep the values within the bounds, widen them, or set engine=solver"});
}

}  // namespace

Emulator::Emulator(Parts parts)
    : surface_share_(parts.surface_share),
      wavelength_count_(parts.wavelength_count),
      groups_(std::move(parts.groups)),
      coefficients_(parts.coefficients),
      counts_(parts.counts),
      owner_(std::move(parts.owner)) {
    std::size_t count = 0;
    std::size_t coefficient = 0;
    for (const Group& group : groups_) {
        series_.push_back({.most = group.most,
                           .counts = counts_.subspan(count, group.count_count),
                           .coefficients = coefficients_.subspan(coefficient, group.coefficient_count)});
        count += group.count_count;
        coefficient += group.coefficient_count;
    }
}

Emulator::Parts Emulator::parts() const {
    return {.surface_share = surface_share_,
            .wavelength_count = wavelength_count_,
            .groups = groups_,
            .coefficients = coefficients_,
            .counts = counts_,
            .owner = owner_};
}

double Emulator::certified_error(std::size_t wavelength) const {
    assert(wavelength < wavelength_count_);
    return groups_[wavelength / emulator_lanes].certified_error[wavelength % emulator_lanes];
}

double Emulator::certified_error() const {
    double largest = 0.0;
    for (std::size_t i = 0; i < wavelength_count_; ++i) largest = std::max(largest, certified_error(i));
    return largest;
}

PerLayer<Lanes<double>> Emulator::depths_of(std::size_t group, std::span<const PerLayer<double>> optical_depths) const {
    constexpr double rounding = 1e-9;
    const Group& domain = groups_[group];
    PerLayer<Lanes<double>> depths;
    for (std::size_t lane = 0; lane < emulator_lanes; ++lane) {
        const PerLayer<double>& depth = optical_depths[std::min(group * emulator_lanes + lane, wavelength_count_ - 1)];
        for (std::size_t layer = 0; layer < layer_count; ++layer) {
            const double lowest = domain.lowest[layer][lane];
            const double highest = domain.highest[layer][lane];
            // Written so that a depth that is no number is refused.
            if (!(depth[layer] >= lowest * (1.0 - rounding) && depth[layer] <= highest * (1.0 + rounding))) {
                refuse(layer, depth[layer], lowest, highest);
            }
            depths[layer][lane] = depth[layer];
        }
    }
    return depths;
}

std::vector<EmulatedShare> Emulator::respond(std::span<const PerLayer<double>> optical_depths) const {
    assert(optical_depths.size() == wavelength_count_);
    std::vector<EmulatedShare> shares(wavelength_count_);
    for (std::size_t group = 0; group < groups_.size(); ++group) {
        const EmulatorSums sums =
            sum_series(series_[group], groups_[group].coordinate, depths_of(group, optical_depths));
        const std::size_t first = group * emulator_lanes;
        for (std::size_t i = first; i < std::min(first + emulator_lanes, wavelength_count_); ++i) {
            shares[i].share = sums.value[i - first];
            for (std::size_t layer = 0; layer < layer_count; ++layer) {
                shares[i].by_optical_depth[layer] = sums.by_optical_depth[layer][i - first];
            }
        }
    }
    return shares;
}

}  // namespace skinfit
