#include "model/goniophotometer.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>

#include "model/analog_ray.hpp"
#include "model/chromophores.hpp"

namespace skinfit {
namespace {

/// The incidence cosine of each ray.
class Illumination {
public:
    explicit Illumination(const Incidence& incidence)
        : is_one_angle_(incidence.lowest_rad == incidence.highest_rad),
          cosine_(std::cos(incidence.lowest_rad)),
          lowest_(std::pow(std::sin(incidence.lowest_rad), 2)),
          width_(std::pow(std::sin(incidence.highest_rad), 2) - lowest_) {}

    /// Takes the second number of the first attempt at the surface; the first one decides on reflection.
    [[nodiscard]] double cosine(const RandomRay& random) const {
        return is_one_angle_ ? cosine_ : std::sqrt(1.0 - (lowest_ + width_ * random.uniforms(0, 0)[1]));
    }

private:
    bool is_one_angle_;
    double cosine_;
    double lowest_;  // squared sine
    double width_;   // of the squared sine
};

struct ExitDirection {
    double cosine;
    double azimuth_rad;
};

/// A mirror direction at azimuth 0 warped by the folds of the skin; below the horizon it is drawn again, from further
/// attempts at the surface's event. (open in [KA04])
ExitDirection warped_mirror_direction(const FoldWarp& warp, const RandomRay& random, double mirror_cosine) {
    for (std::uint32_t attempt = 1;; ++attempt) {
        const FourUniforms xi = random.uniforms(0, attempt);
        for (const std::size_t first : {0U, 2U}) {
            const double polar_cosine = warp.cosine(xi[first]);
            const Deflection deflection{.cosine = polar_cosine,
                                        .sine = std::sqrt(std::max(0.0, 1.0 - polar_cosine * polar_cosine)),
                                        .azimuth_turns = xi[first + 1]};
            const double cosine = deflected_cosine(mirror_cosine, deflection);
            if (cosine <= 0.0) continue;
            FollowedAzimuth azimuth;
            azimuth.deflect(mirror_cosine, deflection);
            return {.cosine = cosine, .azimuth_rad = azimuth.angle()};
        }
    }
}

/// What is the same for all rays of one wavelength.
struct Setup {
    LayerStack stack;
    PerLayer<double> depth;
    Illumination illumination;
    FoldWarp warp;
    AngularBins bins;
};

void count_ray(const Setup& setup, const RandomRay& random, AngularCounts& counts) {
    const double incidence_cosine = setup.illumination.cosine(random);
    DirectionalRandomWalk walk(setup.stack, random);
    const Exit exit = follow_analog(walk, setup.depth, incidence_cosine, counts.totals);
    if (exit == Exit::surface) {
        const ExitDirection direction = warped_mirror_direction(setup.warp, random, incidence_cosine);
        ++counts.surface[setup.bins.index(direction.cosine, direction.azimuth_rad)];
    } else if (exit != Exit::absorbed) {
        std::vector<std::uint64_t>& way_out = exit == Exit::reflected ? counts.subsurface : counts.transmitted;
        ++way_out[setup.bins.index(walk.exit_cosine(), walk.azimuth().angle())];
    }
}

void add(std::vector<std::uint64_t>& sum, const std::vector<std::uint64_t>& other) {
    std::ranges::transform(sum, other, sum.begin(), std::plus<>());
}

/// The rays of `counts` that leave as `light` in bins `first` to before `last`.
std::uint64_t count_of(const AngularCounts& counts, Light light, std::size_t first, std::size_t last) {
    const auto sum = [&](const std::vector<std::uint64_t>& bins) {
        const auto begin = bins.begin();
        return std::accumulate(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last),
                               std::uint64_t{0});
    };
    switch (light) {
        case Light::surface:
            return sum(counts.surface);
        case Light::subsurface:
            return sum(counts.subsurface);
        case Light::transmitted:
            return sum(counts.transmitted);
        default:
            return sum(counts.surface) + sum(counts.subsurface);
    }
}

}  // namespace

std::size_t AngularBins::count() const {
    return static_cast<std::size_t>(polar) * static_cast<std::size_t>(azimuth);
}

std::size_t AngularBins::index(double cosine, double azimuth_rad) const {
    const int polar_bin = static_cast<int>(std::acos(std::min(cosine, 1.0)) / (0.5 * pi) * polar);
    const int turned = static_cast<int>(std::lround(azimuth_rad / (2.0 * pi) * azimuth)) + azimuth;
    return static_cast<std::size_t>(std::min(polar_bin, polar - 1)) * static_cast<std::size_t>(azimuth) +
           static_cast<std::size_t>(turned % azimuth);
}

double AngularBins::polar_edge_rad(int polar_bin) const {
    return 0.5 * pi * polar_bin / polar;
}

double AngularBins::projected_solid_angle(int polar_bin) const {
    const double low = std::sin(polar_edge_rad(polar_bin));
    const double high = std::sin(polar_edge_rad(polar_bin + 1));
    return 2.0 * pi / azimuth * 0.5 * (high * high - low * low);
}

AngularCounts::AngularCounts(const AngularBins& bins)
    : surface(bins.count()), subsurface(bins.count()), transmitted(bins.count()) {}

AngularCounts& AngularCounts::operator+=(const AngularCounts& other) {
    totals += other.totals;
    add(surface, other.surface);
    add(subsurface, other.subsurface);
    add(transmitted, other.transmitted);
    return *this;
}

std::vector<AngularCounts> goniophotometer(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                           const GoniophotometerOptions& options) {
    assert(options.bins.polar >= 1 && options.bins.azimuth >= 2 && options.bins.azimuth % 2 == 0);
    std::vector<AngularCounts> spectrum;
    std::uint64_t first_ray = options.first_ray;
    for (const double wavelength_nm : wavelengths_nm) {
        const Setup setup{.stack = layer_stack(sample, wavelength_nm),
                          .depth = optical_depth(sample.skin, Extinction::at(wavelength_nm, sample.edition)),
                          .illumination = Illumination(options.incidence),
                          .warp = FoldWarp(sample.edition, sample.skin.fold_aspect_ratio),
                          .bins = options.bins};
        spectrum.push_back(tbb::parallel_reduce(
            tbb::blocked_range<std::uint64_t>(first_ray, first_ray + options.rays, 10'000), AngularCounts(options.bins),
            [&](const tbb::blocked_range<std::uint64_t>& range, AngularCounts counts) {
                for (std::uint64_t ray = range.begin(); ray != range.end(); ++ray) {
                    count_ray(setup, RandomRay(options.seed, ray), counts);
                }
                return counts;
            },
            [](AngularCounts a, const AngularCounts& b) { return a += b; }));
        first_ray += options.rays;
    }
    return spectrum;
}

BrdfValue brdf(const AngularSpectrum& spectrum, Light light, int polar_bin, std::optional<int> azimuth_bin) {
    assert(spectrum.weights.size() == spectrum.counts.size());
    const auto azimuths = static_cast<std::size_t>(spectrum.bins.azimuth);
    const std::size_t ring = static_cast<std::size_t>(polar_bin) * azimuths;
    const std::size_t first = ring + static_cast<std::size_t>(azimuth_bin.value_or(0));
    const std::size_t last = azimuth_bin ? first + 1 : ring + azimuths;
    const double total_weight = std::accumulate(spectrum.weights.begin(), spectrum.weights.end(), 0.0);
    double share = 0.0;
    double variance = 0.0;
    double of_one_ray = 0.0;  // the most that one ray counts
    for (std::size_t i = 0; i < spectrum.counts.size(); ++i) {
        const double weight = spectrum.weights[i] / total_weight;
        const auto rays = static_cast<double>(spectrum.counts[i].totals.rays);
        const double part = static_cast<double>(count_of(spectrum.counts[i], light, first, last)) / rays;
        share += weight * part;
        variance += weight * weight * part * (1.0 - part) / rays;
        of_one_ray = std::max(of_one_ray, weight / rays);
    }
    const double standard_error = variance > 0.0 ? std::sqrt(variance) : of_one_ray;
    const double solid_angle =
        spectrum.bins.projected_solid_angle(polar_bin) * static_cast<double>(azimuth_bin ? 1 : spectrum.bins.azimuth);
    return {.per_sr = share / solid_angle, .standard_error = standard_error / solid_angle};
}

}  // namespace skinfit
