#include "transport/skin_spectra.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "transport/scattering_nodes.hpp"

namespace skinfit {
namespace {

/// Skins that differ in absorption and in `scattering` alone.
struct SkinFamily {
    LayeredSkin first;
    std::vector<std::size_t> members;
};

/// What steers photons besides `scattering`: the layers with that made equal.
TurbidStack steering(LayeredSkin skin, double wavelength_nm) {
    skin.scattering = {1.0, 0.0};
    return turbid_stack(skin, wavelength_nm);
}

std::vector<SkinFamily> families_of(std::span<const LayeredSkin> skins, double wavelength_nm) {
    std::vector<SkinFamily> families;
    std::vector<TurbidStack> stacks;
    for (std::size_t i = 0; i < skins.size(); ++i) {
        const TurbidStack stack = steering(skins[i], wavelength_nm);
        const auto known = static_cast<std::size_t>(std::ranges::find(stacks, stack) - stacks.begin());
        if (known == stacks.size()) {
            stacks.push_back(stack);
            families.push_back({.first = skins[i], .members = {}});
        }
        families[known].members.push_back(i);
    }
    return families;
}

PerTurbidLayer least_of(std::span<const PerTurbidLayer> absorptions) {
    PerTurbidLayer least = absorptions.front();
    for (const PerTurbidLayer& absorption : absorptions) {
        std::ranges::transform(least, absorption, least.begin(), [](double a, double b) { return std::min(a, b); });
    }
    return least;
}

/// Readings at one wavelength: [skin][gathering], the standard errors squared until all parts are in.
using WavelengthReadings = std::vector<std::vector<PhotonMean>>;

/// The seed of one trace: any two differ in far more than a bit, by an odd number near 2^64 over the golden ratio.
std::uint64_t trace_seed(std::uint64_t seed, std::uint64_t trace) {
    return seed + trace * 0x9E3779B97F4A7C15ULL;
}

/// The members' readings as far as they come from one node.
struct NodeWork {
    TurbidStack stack;
    std::uint64_t seed;
    std::vector<std::pair<std::size_t, double>> skins;  // number and weight
};

void add_node(const NodeWork& work, std::span<const PerTurbidLayer> absorptions, const SkinTransportOptions& options,
              WavelengthReadings& readings, const std::stop_token& stop) {
    std::vector<PerTurbidLayer> own;
    for (const auto& [skin, weight] : work.skins) own.push_back(absorptions[skin]);
    const PhotonPaths paths = PhotonPaths::trace(work.stack,
                                                 {.incidence_rad = options.incidence_rad,
                                                  .photons = options.photons,
                                                  .seed = work.seed,
                                                  .least_absorption_per_cm = least_of(own)},
                                                 stop);
    const auto shares = paths.shares(Side::top, own, options.gatherings);
    for (std::size_t i = 0; i < own.size(); ++i) {
        const auto [skin, weight] = work.skins[i];
        for (std::size_t g = 0; g < options.gatherings.size(); ++g) {
            const double error = weight * shares[i][g].standard_error;
            readings[skin][g].value += weight * shares[i][g].value;
            readings[skin][g].standard_error += error * error;
        }
    }
}

WavelengthReadings readings_at(double wavelength_nm, std::span<const LayeredSkin> skins,
                               const SkinTransportOptions& options, const std::stop_token& stop) {
    const TissueExtinction extinction = TissueExtinction::at(wavelength_nm, options.bilirubin);
    std::vector<PerTurbidLayer> absorptions;
    for (const LayeredSkin& skin : skins) absorptions.push_back(layer_absorption_per_cm(skin, extinction));
    WavelengthReadings readings(skins.size(), std::vector<PhotonMean>(options.gatherings.size()));
    std::uint64_t trace = 0;
    for (SkinFamily& family : families_of(skins, wavelength_nm)) {
        std::vector<double> reduced;
        for (const std::size_t i : family.members) reduced.push_back(skins[i].scattering.reduced_per_cm(wavelength_nm));
        const ScatteringNodes nodes = scattering_nodes(reduced, options.node_ratio);
        for (std::size_t node = 0; node < nodes.reduced_per_cm.size(); ++node) {
            family.first.scattering = {nodes.reduced_per_cm[node], 0.0};
            NodeWork work{.stack = turbid_stack(family.first, wavelength_nm),
                          .seed = trace_seed(options.seed, trace++),
                          .skins = {}};
            for (std::size_t m = 0; m < family.members.size(); ++m) {
                for (const NodePart& part : nodes.parts[m]) {
                    if (part.node == node) work.skins.emplace_back(family.members[m], part.weight);
                }
            }
            if (!work.skins.empty()) add_node(work, absorptions, options, readings, stop);
        }
    }
    return readings;
}

}  // namespace

SkinReadings skin_spectra(std::span<const LayeredSkin> skins, const std::vector<double>& wavelengths_nm,
                          const SkinTransportOptions& options, const std::stop_token& stop) {
    SkinReadings spectra(skins.size(), std::vector<std::vector<PhotonMean>>(options.gatherings.size()));
    for (const double wavelength_nm : wavelengths_nm) {
        const WavelengthReadings readings = readings_at(wavelength_nm, skins, options, stop);
        for (std::size_t skin = 0; skin < skins.size(); ++skin) {
            for (std::size_t g = 0; g < options.gatherings.size(); ++g) {
                const PhotonMean& reading = readings[skin][g];
                spectra[skin][g].push_back(
                    {.value = reading.value, .standard_error = std::sqrt(reading.standard_error)});
            }
        }
    }
    return spectra;
}

}  // namespace skinfit
