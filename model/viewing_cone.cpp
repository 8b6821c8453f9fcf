#include "model/viewing_cone.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <cmath>

#include "model/analog_ray.hpp"
#include "model/chromophores.hpp"
#include "model/constants.hpp"

namespace skinfit {

double viewing_cone_cosine(double viewing_cone_rad) {
    return viewing_cone_rad < 0.5 * pi ? std::cos(viewing_cone_rad) : 0.0;
}

double white_share(std::optional<double> viewing_cone_rad) {
    if (!viewing_cone_rad) return 1.0;
    const double sine = std::sin(*viewing_cone_rad);
    return sine * sine;
}

ViewedCounts& ViewedCounts::operator+=(const ViewedCounts& other) {
    totals += other.totals;
    viewed += other.viewed;
    return *this;
}

std::vector<ViewedCounts> viewed_walk(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                      const WalkOptions& options, std::optional<double> viewing_cone_rad) {
    std::vector<ViewedCounts> spectrum;
    if (!viewing_cone_rad) {
        for (const WalkCounts& counts : random_walk(sample, wavelengths_nm, options)) {
            spectrum.push_back({.totals = counts, .viewed = counts.subsurface_reflected});
        }
        return spectrum;
    }
    const double incidence_cosine = std::cos(options.incidence_rad);
    const double cone_cosine = viewing_cone_cosine(*viewing_cone_rad);
    for (const double wavelength_nm : wavelengths_nm) {
        const LayerStack stack = layer_stack(sample, wavelength_nm);
        const PerLayer<double> depth = optical_depth(sample.skin, Extinction::at(wavelength_nm, sample.edition));
        spectrum.push_back(tbb::parallel_reduce(
            tbb::blocked_range<std::uint64_t>(0, options.rays, 1000), ViewedCounts{},
            [&](const tbb::blocked_range<std::uint64_t>& range, ViewedCounts counts) {
                for (std::uint64_t ray = range.begin(); ray != range.end(); ++ray) {
                    RandomWalk walk(stack, RandomRay(options.seed, ray));
                    const Exit exit = follow_analog(walk, depth, incidence_cosine, counts.totals);
                    if (exit == Exit::reflected && walk.exit_cosine() > cone_cosine) ++counts.viewed;
                }
                return counts;
            },
            [](ViewedCounts a, const ViewedCounts& b) { return a += b; }));
    }
    return spectrum;
}

}  // namespace skinfit
