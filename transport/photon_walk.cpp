#include "transport/photon_walk.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/trigonometry.hpp"
#include "transport/henyey_greenstein.hpp"

namespace skinfit {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Roulette begins where the least absorption has left exp(-3), and is played again after each further factor of e,
/// with one chance in e to go on: chosen, for photons this faint add little to the scatter of any reading.
constexpr double depth_before_roulette = 3.0;

}  // namespace

struct PhotonWalk::Photon {
    struct Direction {
        double along;  // the plane of incidence
        double across;
        double down;
    };
    Direction direction;
    std::size_t layer = 0;  // beyond the last: below the stack
    bool above = false;     // has left through the top
    double depth_cm = 0.0;  // from the top of its layer
    double along_cm = 0.0;  // from the point of entry
    double across_cm = 0.0;
    double weight = 1.0;
    double dimming = 0.0;  // optical depth of the least absorption
    PerTurbidLayer lengths_cm{};

    void move(double distance_cm) {
        along_cm += distance_cm * direction.along;
        across_cm += distance_cm * direction.across;
        depth_cm += distance_cm * direction.down;
        lengths_cm[layer] += distance_cm;
    }

    /// By a polar angle and an azimuth of full turns. [WANG95]
    void deflect(double cosine, double turns) {
        const double sine_squared = 1.0 - cosine * cosine;
        const double sine = std::sqrt(sine_squared > 0.0 ? sine_squared : 0.0);
        const double first = sine * cosine_of_turns(turns);
        const double second = sine * sine_of_turns(turns);
        const auto [along, across, down] = direction;
        const double level_squared = 1.0 - down * down;
        if (level_squared < 1e-12) {
            direction = {first, second, std::copysign(cosine, cosine * down)};
            return;
        }
        const double level = std::sqrt(level_squared);
        const double per_level = 1.0 / level;
        direction = {(along * down * first - across * second) * per_level + along * cosine,
                     (across * down * first + along * second) * per_level + across * cosine,
                     down * cosine - level * first};
    }
};

PhotonWalk::PhotonWalk(const TurbidStack& stack, const PhotonOptions& options)
    : surface_(stack.index_above, stack.layers.front().refractive_index),
      incidence_rad_(options.incidence_rad),
      seed_(options.seed) {
    assert(stack.layers.size() <= most_turbid_layers);
    for (std::size_t i = 0; i < stack.layers.size(); ++i) {
        const TurbidLayer& layer = stack.layers[i];
        const bool is_last = i + 1 == stack.layers.size();
        assert(layer.thickness_cm > 0.0 && (is_last || layer.thickness_cm < infinity));
        assert(layer.anisotropy > -1.0 && layer.anisotropy < 1.0);
        assert(layer.thickness_cm < infinity || options.least_absorption_per_cm[i] > 0.0);
        const double n = layer.refractive_index;
        layers_.push_back(
            {.free_path_cm = layer.scattering_per_cm > 0.0 ? 1.0 / layer.scattering_per_cm : infinity,
             .anisotropy = layer.anisotropy,
             .thickness_cm = layer.thickness_cm,
             .least_absorption_per_cm = options.least_absorption_per_cm[i],
             .above = FresnelInterface(n, i == 0 ? stack.index_above : stack.layers[i - 1].refractive_index),
             .below = FresnelInterface(n, is_last ? stack.index_below : stack.layers[i + 1].refractive_index)});
    }
}

PhotonWalk::Photon PhotonWalk::entered(double xi) const {
    // Diffuse light arrives in proportion to the cosine.
    const double cosine = incidence_rad_ ? std::cos(*incidence_rad_) : std::sqrt(xi);
    const double down = surface_.transmitted_cosine(cosine);
    return {.direction = {.along = std::sqrt(1.0 - down * down), .across = 0.0, .down = down},
            .weight = 1.0 - surface_.reflectance(cosine)};
}

/// At the boundary of its layer the photon is reflected, or goes on beyond. Returns whether it is still in the stack.
bool PhotonWalk::cross(Photon& photon, double xi) const {
    Photon::Direction& direction = photon.direction;
    const bool downward = direction.down > 0.0;
    const Layer& layer = layers_[photon.layer];
    const FresnelInterface& interface = downward ? layer.below : layer.above;
    photon.depth_cm = downward ? layer.thickness_cm : 0.0;
    const double cosine = std::fabs(direction.down);
    // Where nothing changes, the sum of squares would lose the smallest cosines.
    const bool matched = interface.n1() == interface.n2();
    const double transmitted = matched ? cosine : interface.transmitted_cosine(cosine);
    if (transmitted == 0.0 || interface.reflects(xi, cosine, transmitted)) {
        direction.down = -direction.down;
        return true;
    }
    const double ratio = interface.n1() / interface.n2();
    direction = {direction.along * ratio, direction.across * ratio, downward ? transmitted : -transmitted};
    if (!downward && photon.layer == 0) {
        photon.above = true;
        return false;
    }
    photon.layer = downward ? photon.layer + 1 : photon.layer - 1;
    if (photon.layer == layers_.size()) return false;
    photon.depth_cm = downward ? 0.0 : layers_[photon.layer].thickness_cm;
    return true;
}

std::optional<PhotonExit> PhotonWalk::follow(std::uint64_t number) const {
    const RandomRay random(seed_, number);
    Photon photon = entered(random.uniforms(0, 0)[0]);
    if (photon.weight <= 0.0) return std::nullopt;
    double next_roulette = depth_before_roulette;
    FourUniforms next_xi = random.uniforms(1, 0);
    for (std::uint32_t event = 1;; ++event) {
        const FourUniforms xi = next_xi;
        next_xi = random.uniforms(event + 1, 0);  // drawn early: its latency hides behind this event
        const Layer& layer = layers_[photon.layer];
        // Free paths have no memory: one that a boundary has cut is drawn anew beyond it.
        const double free_cm = -std::log(xi[0]) * layer.free_path_cm;
        const double down = photon.direction.down;
        const double ahead_cm = down > 0.0 ? layer.thickness_cm - photon.depth_cm : -photon.depth_cm;
        const double boundary_cm = down == 0.0 ? infinity : ahead_cm / down;
        if (free_cm == infinity && boundary_cm == infinity) return std::nullopt;
        const double moved_cm = std::max(0.0, std::min(free_cm, boundary_cm));
        photon.move(moved_cm);
        photon.dimming += moved_cm * layer.least_absorption_per_cm;
        if (free_cm < boundary_cm) {
            photon.deflect(henyey_greenstein_cosine(layer.anisotropy, xi[1]), xi[2]);
        } else if (!cross(photon, xi[3])) {
            return PhotonExit{.side = photon.above ? Side::top : Side::bottom,
                              .lengths_cm = photon.lengths_cm,
                              .radius_cm = std::hypot(photon.along_cm, photon.across_cm),
                              .cosine = std::fabs(photon.direction.down),
                              .weight = photon.weight};
        }
        for (std::uint32_t game = 1; photon.dimming > next_roulette; ++game, next_roulette += 1.0) {
            if (random.uniforms(event, game)[0] > 1.0 / std::numbers::e) return std::nullopt;
            photon.weight *= std::numbers::e;
        }
    }
}

}  // namespace skinfit
