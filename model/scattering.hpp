#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

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
        auto segment = static_cast<std::size_t>(guide_[static_cast<std::size_t>(xi * guide_size)]);
        while (share_[segment + 1] < xi) ++segment;
        return offset_[segment] + slope_[segment] * xi;
    }

    static constexpr std::size_t table_size = 32;  ///< of the tables of knots
    /// What `polar_angle` reads, for code that draws many angles at once: the angle of xi in `segment`, which is the
    /// first from guide[xi * guide_size] on with xi <= share[segment + 1], is offset[segment] + slope[segment] xi.
    /// Shares beyond the last knot are infinite.
    struct Lookup {
        const double* share;
        const double* offset;  ///< rad
        const double* slope;   ///< rad
        const std::int64_t* guide;
    };
    static constexpr std::size_t guide_bits = 9;  ///< of xi choose the entry of the guide
    [[nodiscard]] Lookup lookup() const { return {share_.data(), offset_.data(), slope_.data(), guide_.data()}; }

    /// The share of the light scattered within `polar_angle`, rad.
    [[nodiscard]] double share_within(double polar_angle) const;

private:
    static constexpr std::size_t guide_size = std::size_t{1} << guide_bits;

    // The inverse is piecewise linear between knots, of which two columns of 14 rows have at most 28.
    std::size_t knot_count_ = 0;
    std::array<double, table_size> angle_{};        // rad
    std::array<double, table_size> share_;          // 0 to 1
    std::array<double, table_size> slope_{};        // rad per share, of the segment that starts here
    std::array<double, table_size> offset_{};       // rad, of the line through the segment at share 0
    std::array<std::int64_t, guide_size> guide_{};  // the segment that holds the share i / guide_size
};

/// The direction of a ray diffused by the dermis: cosine-distributed about the normal. [KA04, Eq. 4]
struct DiffuseScattering {
    [[nodiscard]] static double cosine(double xi) { return std::sqrt(xi); }
    /// The share of rays whose cosine is below `cosine`, 0 to 1.
    [[nodiscard]] static double share_below(double cosine);
};

/// Scattering by collagen fibrils: the law that the rejection of each edition draws from (`model/REFERENCES.md`),
/// by inversion of its cumulative share. One number a draw keeps well spread numbers well spread angles.
class RayleighScattering {
public:
    explicit RayleighScattering(Edition edition) : edition_(edition) {}

    /// The cosine of the polar angle that the uniform number `xi`, 0 to 1, stands for.
    [[nodiscard]] double cosine(double xi) const {
        return edition_ == Edition::printed ? printed_cosine(xi) : revised_cosine(xi);
    }
    /// The share of scattered rays whose deflection has a cosine below `cosine`, -1 to 1.
    [[nodiscard]] double share_below(double cosine) const;

    /// Steps of Newton's method, each of which squares the error: from 0.02 and 0.06 to the rounding of the result and
    /// to the error of the sine.
    static constexpr int revised_steps = 3;
    static constexpr int printed_steps = 4;

private:
    /// The root of (c^3 + 3 c + 4) / 8 = xi.
    [[nodiscard]] static double revised_cosine(double xi) {
        const double q = 8.0 * xi - 4.0;
        double cosine = q / (3.0 + q * q * 0.0625);
        for (int step = 0; step < revised_steps; ++step) {
            const double square = cosine * cosine;
            cosine = (2.0 * square * cosine + q) / (3.0 * square + 3.0);
        }
        return cosine;
    }
    /// The root of t + sin(2 pi t) / (6 pi) = xi, where t is the angle over pi.
    [[nodiscard]] static double printed_cosine(double xi) {
        double turns = xi;
        for (int step = 0; step < printed_steps; ++step) {
            const double excess = turns + sine_of_turns(turns) * (1.0 / (6.0 * pi)) - xi;
            turns = turns - excess / (1.0 + cosine_of_turns(turns) * (1.0 / 3.0));
        }
        return cosine_of_turns(0.5 * turns);
    }

    Edition edition_;
};

/// Whether a run through a dermal layer begins with the test for Rayleigh scattering: of a ray that travels downward,
/// and, as printed, of one that no interface of the dermis has reflected yet. (`model/REFERENCES.md`)
[[nodiscard]] constexpr bool asks_for_rayleigh(Edition edition, bool downward, bool bounced) {
    return edition == Edition::revised ? downward : !bounced;
}

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
