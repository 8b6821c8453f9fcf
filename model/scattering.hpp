#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>

#include "model/constants.hpp"
#include "model/skin.hpp"
#include "model/trigonometry.hpp"

/// Where a scattered ray goes. Every sampler here comes with its law as a cumulative share, so that one test can hold
/// the two against each other.
namespace skinfit {

/// The cosine to the normal of a ray of cosine `cosine` after a deflection by a polar angle (its cosine and sine) and
/// an azimuth (its cosine) about the ray itself. Spherical law of cosines.
[[nodiscard]] inline double deflected_cosine(double cosine, double deflection_cosine, double deflection_sine,
                                             double azimuth_cosine) {
    const double sine_squared = 1.0 - cosine * cosine;
    const double sine = std::sqrt(sine_squared > 0.0 ? sine_squared : 0.0);
    return cosine * deflection_cosine + sine * deflection_sine * azimuth_cosine;
}

/// Polar angle of scattering in stratum corneum and epidermis: the inverse of the measured cumulative distribution
/// [BRULS84], linear between its angles. Between measured wavelengths the two inverses, that is the angles at the same
/// share, are blended linearly; outside the measured wavelengths the nearest is used. [KA04, Sec. 3.2]
class ForwardScattering {
public:
    /// `layer` is stratum corneum or epidermis.
    ForwardScattering(Layer layer, double wavelength_nm);

    /// The polar angle, rad, below which the share `xi`, 0 to below 1, of the light stays.
    [[nodiscard]] double polar_angle(double xi) const {
        assert(xi >= 0.0 && xi < 1.0);
        std::size_t segment = guide_[static_cast<std::size_t>(xi * guide_size)];
        while (share_[segment + 1] < xi) ++segment;
        return angle_[segment] + slope_[segment] * (xi - share_[segment]);
    }

    /// The share of the light scattered within `polar_angle`, rad.
    [[nodiscard]] double share_within(double polar_angle) const;

private:
    static constexpr std::size_t most_knots = 28;  // the shares of two columns of 14 rows
    static constexpr std::size_t guide_size = 256;

    // The inverse is piecewise linear between knots; what lies behind the last knot is never read.
    std::size_t knot_count_ = 0;
    std::array<double, most_knots> angle_{};         // rad
    std::array<double, most_knots> share_{};         // 0 to 1
    std::array<double, most_knots> slope_{};         // rad per share, of the segment that starts here
    std::array<unsigned char, guide_size> guide_{};  // the segment that holds the share i / guide_size
};

/// The direction of a ray diffused by the dermis: cosine-distributed about the normal. [KA04, Eq. 4]
struct DiffuseScattering {
    [[nodiscard]] static double cosine(double xi) { return std::sqrt(xi); }
    /// The share of rays whose cosine is below `cosine`, 0 to 1.
    [[nodiscard]] static double share_below(double cosine);
};

/// Scattering by collagen fibrils: the polar angle by rejection, both editions (`model/REFERENCES.md`).
class RayleighScattering {
public:
    explicit RayleighScattering(Edition edition) : edition_(edition) {}

    /// The cosine of the polar angle proposed by `xi`, or nothing when `acceptance_xi` rejects it.
    [[nodiscard]] std::optional<double> cosine(double xi, double acceptance_xi) const {
        const double cosine = edition_ == Edition::printed ? std::cos(pi * xi) : 1.0 - 2.0 * xi;
        if (1.5 * acceptance_xi > 0.75 * (1.0 + cosine * cosine)) return std::nullopt;
        return cosine;
    }
    /// The share of scattered rays whose deflection has a cosine below `cosine`, -1 to 1.
    [[nodiscard]] double share_below(double cosine) const;

private:
    Edition edition_;
};

/// The Rayleigh optical depth of a dermal layer at normal passage, R cosine in [KA04, Eq. 3]; dimensionless.
struct RayleighLayer {
    double wavelength_nm;
    double fibre_refractive_index;
    double medium_refractive_index;
    double fibril_radius_nm;
    double thickness_cm;
};
[[nodiscard]] double rayleigh_optical_depth(const RayleighLayer& layer);

/// The deflection of a surface-reflected ray from its mirror direction by the folds of the skin, [KA04, Eq. 1]; both
/// editions (`model/REFERENCES.md`). `fold_aspect_ratio` in (0, 1].
class FoldWarp {
public:
    FoldWarp(Edition edition, double fold_aspect_ratio) : edition_(edition), ratio_(fold_aspect_ratio) {}

    /// The cosine of the polar angle of deflection.
    [[nodiscard]] double cosine(double xi) const;
    /// The share of deflections whose cosine is below `cosine`, 0 to 1.
    [[nodiscard]] double share_below(double cosine) const;

private:
    Edition edition_;
    double ratio_;
};

}  // namespace skinfit
