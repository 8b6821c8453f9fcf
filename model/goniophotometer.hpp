#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/random_walk.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// How exit directions are told apart, in either hemisphere: equal steps of the angle to the normal, and of the azimuth
/// with its first bin centred on the forward (mirror) half plane of incidence.
struct AngularBins {
    int polar = 18;    ///< steps from the normal to the horizon; at least 1
    int azimuth = 36;  ///< even, so that another bin is centred on the backward half plane; at least 2

    /// Bins of one hemisphere.
    [[nodiscard]] std::size_t count() const;
    /// The bin of a direction: its cosine to the normal, 0 to 1, and its azimuth, -pi to pi. The azimuth runs fastest.
    [[nodiscard]] std::size_t index(double cosine, double azimuth_rad) const;
    /// The angle to the normal at which polar bin `polar_bin` begins, 0 to `polar`.
    [[nodiscard]] double polar_edge_rad(int polar_bin) const;
    /// Of one bin: the integral of the cosine over its solid angle, sr.
    [[nodiscard]] double projected_solid_angle(int polar_bin) const;

    bool operator==(const AngularBins&) const = default;
};

/// Where the rays of one wavelength went. The counts of each way out sum to that of `totals` exactly.
struct AngularCounts {
    explicit AngularCounts(const AngularBins& bins);

    WalkCounts totals;
    std::vector<std::uint64_t> surface;      ///< by `AngularBins::index`
    std::vector<std::uint64_t> subsurface;   ///< likewise
    std::vector<std::uint64_t> transmitted;  ///< likewise, below; the direction is the one in the base

    AngularCounts& operator+=(const AngularCounts& other);
    bool operator==(const AngularCounts&) const = default;
};

/// The angles to the normal under which light arrives, at azimuth 0: one angle where both are equal, else a range that
/// is filled evenly by projected solid angle (the squared sine). 0 to below pi/2.
struct Incidence {
    double lowest_rad = 0.0;
    double highest_rad = 0.0;
};

/// What the goniophotometer does.
struct GoniophotometerOptions {
    Incidence incidence;
    std::uint64_t rays = 1'000'000;  ///< per wavelength
    std::uint64_t seed = 1;
    std::uint64_t first_ray = 0;  ///< rays of the same seed and other numbers are independent
    AngularBins bins;
};

/// The analog walk with exit directions, one result per wavelength; the same for any number of threads. Wavelength j
/// follows the rays from `first_ray + j * rays`, so the errors of different wavelengths are independent; those of the
/// first wavelength end as in `random_walk`. Throws InputError for a wavelength outside the tables.
[[nodiscard]] std::vector<AngularCounts> goniophotometer(const Sample& sample,
                                                         const std::vector<double>& wavelengths_nm,
                                                         const GoniophotometerOptions& options);

/// The light looked at: what leaves above in all, its two parts, or what leaves below.
enum class Light { reflected, surface, subsurface, transmitted };

/// Counts of several wavelengths and how much each wavelength weighs in the whole; one wavelength is a whole too.
struct AngularSpectrum {
    AngularBins bins;
    std::vector<AngularCounts> counts;
    std::vector<double> weights;  ///< one per wavelength, not negative, their sum above 0 but not necessarily 1
};

/// A mean BRDF (BTDF for transmitted light) and its standard error, from the binomial error of its counts; 1/sr.
/// Where no ray was counted, or all were, the error is what one ray counts.
struct BrdfValue {
    double per_sr = 0.0;
    double standard_error = 0.0;
};

/// The mean over one bin, or over all azimuths of a polar bin: the weighted share of the rays there over the projected
/// solid angle.
[[nodiscard]] BrdfValue brdf(const AngularSpectrum& spectrum, Light light, int polar_bin,
                             std::optional<int> azimuth_bin = std::nullopt);

}  // namespace skinfit
