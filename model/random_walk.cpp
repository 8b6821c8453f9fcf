#include "model/random_walk.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>

#include "model/analog_ray.hpp"
#include "model/chromophores.hpp"

namespace skinfit {
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
                    RandomWalk walk(stack, RandomRay(options.seed, ray));
                    (void)follow_analog(walk, depth, incidence_cosine, counts);
                }
                return counts;
            },
            [](WalkCounts a, const WalkCounts& b) { return a += b; }));
    }
    return spectrum;
}

}  // namespace skinfit
