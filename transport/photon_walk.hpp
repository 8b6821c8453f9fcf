#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/fresnel.hpp"
#include "model/random.hpp"
#include "transport/photon_paths.hpp"

namespace skinfit {

/// How a photon that left did so.
struct PhotonExit {
    Side side;
    PerTurbidLayer lengths_cm;
    double radius_cm;
    double cosine;
    double weight;
};

/// The walk of single photons through a stack.
class PhotonWalk {
public:
    /// Of photons of a stack, as the options have them; checks both by assertion.
    PhotonWalk(const TurbidStack& stack, const PhotonOptions& options);

    /// The walk of photon `number`; nothing for one that does not leave.
    [[nodiscard]] std::optional<PhotonExit> follow(std::uint64_t number) const;

private:
    struct Layer {
        double free_path_cm;  // mean; infinite without scattering
        double anisotropy;
        double thickness_cm;
        double least_absorption_per_cm;
        FresnelInterface above;
        FresnelInterface below;
    };
    struct Photon;

    [[nodiscard]] Photon entered(double xi) const;
    bool cross(Photon& photon, double xi) const;

    std::vector<Layer> layers_;
    FresnelInterface surface_;
    std::optional<double> incidence_rad_;
    std::uint64_t seed_;
};

}  // namespace skinfit
