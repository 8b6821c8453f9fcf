#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "model/path_sums.hpp"
#include "model/random_walk.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// The two ways out of a sample.
enum class Side : std::size_t { top, bottom };
inline constexpr std::size_t side_count = 2;

/// The share of the incident light that leaves through one side, and how it answers to absorption.
struct Escape {
    double share = 0.0;
    double standard_error = 0.0;          ///< of `share`, from the scatter of the batches; infinite for one batch
    PerLayer<double> by_optical_depth{};  ///< derivative of `share` by each layer's optical depth
};

/// Escape at one wavelength.
struct EnsembleResponse {
    std::array<Escape, side_count> side;

    [[nodiscard]] const Escape& operator[](Side which) const { return side[static_cast<std::size_t>(which)]; }
};

/// Recorded walks. Absorption never steers a ray, so rays traced once without it give the expected reflectance and
/// transmittance for any pigments, smoothly and with exact derivatives:
///
///     share = (1 - F) / N  sum_i exp(-sum_l depth_l S_il),   S_il = sum over path i's runs in layer l of 1/cosine
///
/// with F the surface's Fresnel reflectance. The rays are those of `record_batch`, independent from batch to batch
/// only. Copies share the recording, which never changes.
class PathEnsemble {
public:
    /// Rays are recorded in this many batches, whose scatter shows the Monte Carlo error of anything computed here.
    static constexpr std::size_t batch_count = 32;

    /// Traces `options.rays` rays, `batch_count` at least, that enter the sample, per wavelength. The same bits for any
    /// number of threads and instruction set, and on any machine whose C library gives the same bits for the cos, sin
    /// and pow from which directions and scattering start. Throws Cancelled soon after `stop` is requested.
    [[nodiscard]] static PathEnsemble trace(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                            const WalkOptions& options, const std::stop_token& stop = {});

    /// The share of the light that the surface reflects.
    [[nodiscard]] double surface_share() const { return surface_share_; }
    [[nodiscard]] std::size_t wavelength_count() const { return segments_.size(); }
    /// Rays per wavelength.
    [[nodiscard]] std::uint64_t rays() const { return rays_; }
    /// Rays per wavelength in the batches in use.
    [[nodiscard]] std::uint64_t used_rays() const;

    /// The response at each wavelength to the layers' optical depths there.
    [[nodiscard]] std::vector<EnsembleResponse> respond(std::span<const PerLayer<double>> optical_depths) const;

    /// `Escape::share` of one side as each batch alone estimates it: [wavelength][batch].
    [[nodiscard]] std::vector<std::array<double, batch_count>> batch_shares(
        std::span<const PerLayer<double>> optical_depths, Side side) const;

    /// The same ensemble with its first batches only, at least as many as hold `rays` rays: a cheap approximation.
    [[nodiscard]] PathEnsemble with_about(std::uint64_t rays) const;

    /// The paths of one wavelength that leave through one side, in the order of their rays.
    struct Segment {
        std::uint64_t first_float;                                ///< where layer 0 begins; layer l is l * count later
        std::array<std::uint64_t, batch_count + 1> batch_begins;  ///< path numbers; the last is the count
    };
    using Segments = std::array<Segment, side_count>;  ///< of one wavelength

    /// The recording as plain data, for storage.
    struct Recording {
        std::span<const Segments> segments;
        std::span<const float> lengths;
    };
    /// Valid as long as the ensemble.
    [[nodiscard]] Recording recording() const { return {segments_, lengths_}; }

    /// An ensemble from stored parts; `lengths` lives as long as `owner`.
    struct Parts {
        double surface_share;
        std::uint64_t rays;
        std::vector<Segments> segments;
        std::span<const float> lengths;
        std::shared_ptr<const void> owner;
    };
    /// Takes `parts` as they are: whoever stored them has checked them.
    explicit PathEnsemble(Parts parts);

private:
    [[nodiscard]] PathSpan paths(std::size_t wavelength, Side side, std::size_t batch) const;

    double surface_share_;
    std::uint64_t rays_;
    std::size_t used_batches_ = batch_count;
    std::vector<Segments> segments_;
    std::span<const float> lengths_;
    std::shared_ptr<const void> owner_;
};

}  // namespace skinfit
