#include "transport/photon_paths.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/memory.hpp"
#include "core/stop.hpp"
#include "model/constants.hpp"
#include "model/fresnel.hpp"
#include "model/trigonometry.hpp"
#include "model/viewing_cone.hpp"
#include "transport/photon_walk.hpp"

namespace skinfit {
namespace {

constexpr std::uint64_t photons_of_a_part = 1000;  // chosen: much longer than the start of a task

void append(EscapedPhotons& all, const PhotonExit& exit, std::size_t layers) {
    for (std::size_t l = 0; l < layers; ++l) all.lengths_cm[l].push_back(static_cast<float>(exit.lengths_cm[l]));
    all.radius_cm.push_back(static_cast<float>(exit.radius_cm));
    all.cosine.push_back(static_cast<float>(exit.cosine));
    all.weight.push_back(static_cast<float>(exit.weight));
}

double seen_cosine(const Gathering& gathering) {
    return gathering.viewing_cone_rad ? viewing_cone_cosine(*gathering.viewing_cone_rad) : 0.0;
}

/// The weight of each photon as `gathering` takes it in.
std::vector<double> gathered_weights(const EscapedPhotons& escaped, const Gathering& gathering) {
    std::vector<double> weights(escaped.count());
    const double least_cosine = seen_cosine(gathering);
    const double white = white_share(gathering.viewing_cone_rad);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (escaped.cosine[i] <= least_cosine) continue;
        weights[i] = escaped.weight[i] * port_share(gathering, escaped.radius_cm[i]) / white;
    }
    return weights;
}

/// What is left of each photon.
std::vector<double> survivals(const EscapedPhotons& escaped, std::size_t layers, const PerTurbidLayer& absorption) {
    std::vector<double> left(escaped.count());
    for (std::size_t l = 0; l < layers; ++l) {
        const std::vector<float>& lengths = escaped.lengths_cm[l];
        for (std::size_t i = 0; i < left.size(); ++i) left[i] += absorption[l] * lengths[i];
    }
    for (double& each : left) each = decay(each);
    return left;
}

/// The mean of weight times survival over `photons`, of which those that are not here count as zero.
PhotonMean mean_of(const std::vector<double>& weights, const std::vector<double>& survivals, std::uint64_t photons) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double light = weights[i] * survivals[i];
        sum += light;
        squares += light * light;
    }
    const auto n = static_cast<double>(photons);
    const double mean = sum / n;
    return {.value = mean, .standard_error = std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1.0))};
}

/// The reflected share of diffuse light that arrives with at least this cosine: the integral of 2 c F(c), by midpoints.
double diffuse_surface_share(const FresnelInterface& surface, double least_cosine) {
    constexpr int points = 10'000;  // chosen: the error is below 1e-7
    const double width = (1.0 - least_cosine) / points;
    double sum = 0.0;
    for (int i = 0; i < points; ++i) {
        const double cosine = least_cosine + (i + 0.5) * width;
        sum += 2.0 * cosine * surface.reflectance(cosine);
    }
    return sum * width;
}

}  // namespace

double port_share(const Gathering& gathering, double step_cm) {
    const double spot = gathering.spot_radius_cm;
    const double port = gathering.port_radius_cm;
    if (step_cm + spot <= port) return 1.0;
    if (step_cm >= port + spot) return 0.0;
    if (step_cm + port <= spot) return port * port / (spot * spot);
    // The lens that two circles have in common: two circular segments.
    const auto segment = [step_cm](double radius, double other) {
        const double height = (step_cm * step_cm + radius * radius - other * other) / (2.0 * step_cm);
        const double cosine = std::clamp(height / radius, -1.0, 1.0);
        return radius * radius * (std::acos(cosine) - cosine * std::sqrt(1.0 - cosine * cosine));
    };
    return (segment(spot, port) + segment(port, spot)) / (pi * spot * spot);
}

PhotonPaths::PhotonPaths(const TurbidStack& stack, const PhotonOptions& options)
    : incidence_rad_(options.incidence_rad),
      index_above_(stack.index_above),
      first_index_(stack.layers.front().refractive_index),
      layers_(stack.layers.size()),
      photons_(options.photons) {}

PhotonPaths PhotonPaths::trace(const TurbidStack& stack, const PhotonOptions& options, const std::stop_token& stop) {
    assert(options.photons >= 2 && !stack.layers.empty());
    // The parts lie beside the whole before they join it.
    const auto bytes = static_cast<double>(sizeof(PhotonExit) + sizeof(float) * (stack.layers.size() + 3));
    refuse_beyond_memory(bytes * static_cast<double>(options.photons),
                         fmt::format("{} photons of the layered transport", options.photons), "take fewer photons");
    const PhotonWalk walk(stack, options);
    const std::uint64_t count = (options.photons + photons_of_a_part - 1) / photons_of_a_part;
    std::vector<std::vector<PhotonExit>> parts(count);
    tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t part) {
        leave_if_cancelled(stop);
        const std::uint64_t end = std::min(options.photons, (part + 1) * photons_of_a_part);
        for (std::uint64_t photon = part * photons_of_a_part; photon < end; ++photon) {
            if (const std::optional<PhotonExit> exit = walk.follow(photon)) parts[part].push_back(*exit);
        }
    });
    PhotonPaths paths(stack, options);
    for (std::vector<PhotonExit>& part : parts) {
        for (const PhotonExit& exit : part) {
            append(paths.escaped_[static_cast<std::size_t>(exit.side)], exit, paths.layers_);
        }
        part = {};
    }
    return paths;
}

std::uint64_t PhotonPaths::lost() const {
    return photons_ - escaped(Side::top).count() - escaped(Side::bottom).count();
}

double PhotonPaths::surface_share(const Gathering& gathering) const {
    const FresnelInterface surface(index_above_, first_index_);
    const double least_cosine = seen_cosine(gathering);
    const double port = port_share(gathering, 0.0) / white_share(gathering.viewing_cone_rad);
    if (!incidence_rad_) return port * diffuse_surface_share(surface, least_cosine);
    const double cosine = std::cos(*incidence_rad_);
    return cosine > least_cosine ? port * surface.reflectance(cosine) : 0.0;
}

std::vector<std::vector<PhotonMean>> PhotonPaths::shares(Side side, std::span<const PerTurbidLayer> absorptions,
                                                         std::span<const Gathering> gatherings) const {
    const EscapedPhotons& photons = escaped(side);
    std::vector<std::vector<double>> weights;
    for (const Gathering& gathering : gatherings) weights.push_back(gathered_weights(photons, gathering));
    std::vector<std::vector<PhotonMean>> means(absorptions.size());
    tbb::parallel_for(std::size_t{0}, absorptions.size(), [&](std::size_t a) {
        const std::vector<double> left = survivals(photons, layers_, absorptions[a]);
        for (std::size_t g = 0; g < gatherings.size(); ++g) {
            PhotonMean mean = mean_of(weights[g], left, photons_);
            if (side == Side::top && gatherings[g].specular == Specular::included) {
                mean.value += surface_share(gatherings[g]);
            }
            means[a].push_back(mean);
        }
    });
    return means;
}

}  // namespace skinfit
