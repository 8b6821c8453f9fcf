#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "core/geometry.hpp"
#include "model/path_ensemble.hpp"

/// Transport of light through plane turbid layers by Monte Carlo, as the field does it [WANG95]: free paths from the
/// scattering coefficient, Henyey-Greenstein deflections, Fresnel's equations at every step of refractive index. The
/// paths are recorded without absorption, which never steers a photon: one trace serves all absorptions, ports and
/// viewing cones.
namespace skinfit {

/// A plane layer that scatters light.
struct TurbidLayer {
    double scattering_per_cm = 0.0;  ///< mu_s, 0 or more
    double anisotropy = 0.0;         ///< mean cosine g of the deflection, -1 to 1, both excluded
    double refractive_index = 1.0;   ///< 1 or more
    double thickness_cm = 0.0;       ///< above 0; infinite for the last layer of a semi-infinite stack

    bool operator==(const TurbidLayer&) const = default;
};

/// As many layers as a stack may have.
inline constexpr std::size_t most_turbid_layers = 8;
/// A number per layer, from the top; the rest is zero.
using PerTurbidLayer = std::array<double, most_turbid_layers>;

/// Layers from top to bottom, and what is around them.
struct TurbidStack {
    std::vector<TurbidLayer> layers;  ///< 1 to most_turbid_layers
    double index_above = 1.0;         ///< refractive index, 1 or more
    double index_below = 1.0;         ///< 1 or more; of no account below a semi-infinite layer

    bool operator==(const TurbidStack&) const = default;
};

/// Which photons to follow.
struct PhotonOptions {
    std::optional<double> incidence_rad = 0.0;  ///< of a collimated beam, 0 to below pi/2; none: diffuse light
    std::uint64_t photons = 100'000;            ///< that enter, 2 or more
    std::uint64_t seed = 1;
    /// Absorption coefficients, per cm, below which no reading will be asked for: photons that these have dimmed to
    /// exp(-3) play Russian roulette. Readings are unbiased for any absorption, but precise only from these on. Must be
    /// above 0 in a semi-infinite layer, which photons would not leave in finite time.
    PerTurbidLayer least_absorption_per_cm{};
};

/// What an instrument takes in of the light that leaves.
struct Gathering {
    double spot_radius_cm = 0.0;  ///< of the disc that is lit evenly; 0: a pencil beam
    /// Of the round port about the middle of the spot; infinite: all light, as an integrating sphere with a wide port.
    double port_radius_cm = std::numeric_limits<double>::infinity();
    std::optional<double> viewing_cone_rad =
        {};                                  ///< half angle about the normal, relative to a white diffuser; none: all
    Specular specular = Specular::included;  ///< whether what the first surface reflects counts
};

/// The share of evenly lit points of a disc from which a step of `step_cm`, in a direction that is any with equal
/// probability, ends inside the port: the share of the spot that two discs at this distance have in common.
[[nodiscard]] double port_share(const Gathering& gathering, double step_cm);

/// A mean over photons.
struct PhotonMean {
    double value = 0.0;
    double standard_error = 0.0;  ///< from the scatter of the photons
};

/// The photons of one trace that left through one side, by column; all columns are of equal size.
struct EscapedPhotons {
    std::array<std::vector<float>, most_turbid_layers> lengths_cm;  ///< the path in each layer
    std::vector<float> radius_cm;                                   ///< from the point of entry to that of exit
    std::vector<float> cosine;                                      ///< outside, to the normal
    std::vector<float> weight;  ///< transmittance of the first surface, times what roulette has added

    /// How many photons.
    [[nodiscard]] std::size_t count() const { return weight.size(); }
};

/// Recorded photons of one wavelength. What they say of an absorption mu of the layers is
///
///     share = 1/N sum_i weight_i exp(-sum_l mu_l L_il) [gathered],   L_il = photon i's path in layer l
class PhotonPaths {
public:
    /// Traces `options.photons` photons. Each is a function of the seed and its number: the same bits on any number of
    /// threads. Throws InputError where memory would not do, Cancelled soon after `stop` is requested.
    [[nodiscard]] static PhotonPaths trace(const TurbidStack& stack, const PhotonOptions& options,
                                           const std::stop_token& stop = {});

    /// Those that left through one side, in the order of their numbers.
    [[nodiscard]] const EscapedPhotons& escaped(Side side) const { return escaped_[static_cast<std::size_t>(side)]; }
    /// Those that did not: lost in roulette or in the depth of a semi-infinite layer without scattering.
    [[nodiscard]] std::uint64_t lost() const;
    /// All that entered.
    [[nodiscard]] std::uint64_t photons() const { return photons_; }
    /// The share of the light that the first surface reflects, as `gathering` takes it in; exact.
    [[nodiscard]] double surface_share(const Gathering& gathering) const;

    /// What leaves through one side, relative to the light that arrives (within a viewing cone, to that of a white
    /// diffuser): [absorption][gathering], for absorption coefficients per cm of each layer, 0 or more. The share of
    /// the first surface is in it at the top, where specular light counts.
    [[nodiscard]] std::vector<std::vector<PhotonMean>> shares(Side side, std::span<const PerTurbidLayer> absorptions,
                                                              std::span<const Gathering> gatherings) const;

private:
    PhotonPaths(const TurbidStack& stack, const PhotonOptions& options);

    std::optional<double> incidence_rad_;
    double index_above_;
    double first_index_;
    std::size_t layers_;
    std::uint64_t photons_;
    std::array<EscapedPhotons, side_count> escaped_;
};

}  // namespace skinfit
