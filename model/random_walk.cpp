#include "model/random_walk.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>

#include "model/chromophores.hpp"

namespace skinfit {
namespace {

void count_ray(const LayerStack& stack, const PerLayer<double>& optical_depth, const RandomRay& random,
               double incidence_cosine, WalkCounts& counts) {
    RandomWalk walk(stack, random);
    const RandomWalk::FirstHit first = walk.first_hit(incidence_cosine);
    if (first.reflected) {
        ++counts.surface_reflected;
        return;
    }
    std::size_t last_layer = 0;
    const Exit exit = walk.below_surface(first.refracted_cosine, [&](int layer, double cosine, double xi) {
        last_layer = static_cast<std::size_t>(layer);
        return xi < std::exp(-optical_depth[last_layer] / cosine);  // [KA04, Eq. 5]
    });
    switch (exit) {
        case Exit::reflected:
            ++counts.subsurface_reflected;
            break;
        case Exit::transmitted:
            ++counts.transmitted;
            break;
        default:
            ++counts.absorbed[last_layer];
            break;
    }
}

}  // namespace

WalkCounts& WalkCounts::operator+=(const WalkCounts& other) {
    rays += other.rays;
    surface_reflected += other.surface_reflected;
    subsurface_reflected += other.subsurface_reflected;
    transmitted += other.transmitted;
    for (std::size_t layer = 0; layer < layer_count; ++layer) absorbed[layer] += other.absorbed[layer];
    return *this;
}

std::vector<WalkCounts> random_walk(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                    const WalkOptions& options) {
    const double incidence_cosine = std::cos(options.incidence_rad);
    std::vector<WalkCounts> spectrum;
    for (const double wavelength_nm : wavelengths_nm) {
        const LayerStack stack = layer_stack(sample, wavelength_nm);
        const PerLayer<double> depth = optical_depth(sample.skin, Extinction::at(wavelength_nm, sample.edition));
        spectrum.push_back(tbb::parallel_reduce(
            tbb::blocked_range<std::uint64_t>(0, options.rays, 1000), WalkCounts{},
            [&](const tbb::blocked_range<std::uint64_t>& range, WalkCounts counts) {
                for (std::uint64_t ray = range.begin(); ray != range.end(); ++ray) {
                    count_ray(stack, depth, RandomRay(options.seed, ray), incidence_cosine, counts);
                }
                counts.rays += range.size();
                return counts;
            },
            [](WalkCounts a, const WalkCounts& b) { return a += b; }));
    }
    return spectrum;
}

}  // namespace skinfit
