#include "model/emulator_wavelength.hpp"

#include <algorithm>
#include <cmath>

#include "model/chebyshev.hpp"
#include "model/chromophores.hpp"

namespace skinfit {
namespace {

ShareTable shares_of(const AngularComposition& composition, const DepthVector& upper, const DepthVector& lower,
                     Side side) {
    std::vector<UpperDepths> upper_depths;
    std::vector<LowerDepths> lower_depths;
    for (const PerLayer<double>& depth : upper) upper_depths.push_back({depth[0], depth[1]});
    for (const PerLayer<double>& depth : lower) lower_depths.push_back({depth[2], depth[3]});
    return composition.shares(upper_depths, lower_depths, side == Side::top ? Heading::up : Heading::down);
}

/// The depths of one layer at `count` nodes.
std::vector<double> node_depths(const DepthBox& box, std::size_t layer, int count) {
    if (!box.varies(layer)) return {box.lowest[layer]};
    const DepthCoordinate coordinate(box, layer);
    std::vector<double> depths;
    for (const double node : chebyshev_nodes(count)) depths.push_back(coordinate.depth(node));
    return depths;
}

/// All combinations of the nodes of two layers, those of the second running fastest.
DepthVector node_pairs(const DepthBox& box, std::size_t first, std::size_t second,
                       const std::array<int, layer_count>& counts) {
    DepthVector pairs;
    for (const double a : node_depths(box, first, counts[first])) {
        for (const double b : node_depths(box, second, counts[second])) {
            pairs.push_back(box.lowest);
            pairs.back()[first] = a;
            pairs.back()[second] = b;
        }
    }
    return pairs;
}

/// How many nodes a layer needs, from the series along it where the others absorb least: the share is largest there
/// and bends most.
int node_count(const AngularComposition& composition, const DepthBox& box, std::size_t layer, Side side) {
    if (!box.varies(layer)) return 1;
    DepthVector along;
    for (const double depth : node_depths(box, layer, most_emulator_terms)) {
        along.push_back(box.lowest);
        along.back()[layer] = depth;
    }
    const DepthVector rest = {box.lowest};
    const bool upper = layer < 2;
    const ShareTable table =
        upper ? shares_of(composition, along, rest, side) : shares_of(composition, rest, along, side);
    const std::vector<double> coefficients =
        chebyshev_coefficients({table.data(), along.size()}, std::array{most_emulator_terms});
    int count = most_emulator_terms;
    while (count > 1 && std::abs(coefficients[static_cast<std::size_t>(count) - 1]) < least_coefficient) --count;
    return count;
}

/// Specimens of the domain by Richtmyer's low-discrepancy sequence from its number `first` on. A tenth of each range is
/// drawn to either bound, so that faces, edges and corners are met; every other specimen is crowded at the lower
/// bounds, where the share bends most.
DepthVector specimens(const EmulatorDomain& domain, const Extinction& extinction, int first, int count) {
    constexpr std::array<double, parameter_count> primes = {2,  3,  5,  7,  11, 13,  17,  19,  23,  29,
                                                            31, 37, 41, 43, 47, 53,  59,  61,  67,  71,
                                                            73, 79, 83, 89, 97, 101, 103, 107, 109, 113};
    DepthVector depths;
    for (int number = first; number < first + count; ++number) {
        ParameterValues values{.skin = domain.sample.skin, .instrument = {}};
        for (std::size_t i = 0; i < domain.ranges.size(); ++i) {
            const double turns = number * std::sqrt(primes[i]);
            const double place = std::clamp((turns - std::floor(turns)) * 1.25 - 0.125, 0.0, 1.0);
            const ParameterRange& range = domain.ranges[i];
            value_of(values, range.parameter) =
                std::lerp(range.lower, range.upper, number % 2 == 0 ? place : place * place * place);
        }
        depths.push_back(optical_depth(values.skin, extinction));
    }
    return depths;
}

/// The largest error that the solver states where the layers absorb least, most and in between: it is largest where
/// little is absorbed, and changes slowly.
double solver_error(const EmulatorSolvers& solvers, const AngularComposition& composition, const DepthBox& box,
                    Side side, double wavelength_nm) {
    constexpr double offset = 1e-6;  // chosen: the mean of depths is geometric above it
    PerLayer<double> middle;
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
        middle[layer] = std::sqrt((box.lowest[layer] + offset) * (box.highest[layer] + offset)) - offset;
    }
    const DepthVector depths = {box.lowest, middle, box.highest};
    const ShareTable shares = shares_of(composition, depths, depths, side);
    std::array<ShareTable, finer_resolutions.size()> finer;
    for (std::size_t i = 0; i < finer.size(); ++i) {
        finer[i] = shares_of(solvers.finer[i].composition(wavelength_nm), depths, depths, side);
    }
    double largest = 0.0;
    for (Eigen::Index i = 0; i < shares.size(); ++i) {
        largest = std::max(largest,
                           stated_solver_error(shares.data()[i], std::array{finer[0].data()[i], finer[1].data()[i]}));
    }
    return largest;
}

}  // namespace

EmulatedWavelength emulated_wavelength(const EmulatorSolvers& solvers, const EmulatorDomain& domain,
                                       double wavelength_nm) {
    constexpr int upper_specimens = 32;
    constexpr int lower_specimens = 64;
    const Extinction extinction = Extinction::at(wavelength_nm, domain.sample.edition);
    const AngularComposition composition = solvers.solver.composition(wavelength_nm);
    EmulatedWavelength result{.box = depth_box(domain, extinction),
                              .counts = {},
                              .coefficients = {},
                              .test_upper = specimens(domain, extinction, 1, upper_specimens),
                              .test_lower = specimens(domain, extinction, 1 + upper_specimens, lower_specimens),
                              .test_shares = {}};
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
        result.counts[layer] = node_count(composition, result.box, layer, domain.side);
    }
    const ShareTable values = shares_of(composition, node_pairs(result.box, 0, 1, result.counts),
                                        node_pairs(result.box, 2, 3, result.counts), domain.side);
    result.coefficients =
        chebyshev_coefficients({values.data(), static_cast<std::size_t>(values.size())}, result.counts);
    result.test_shares = shares_of(composition, result.test_upper, result.test_lower, domain.side);
    result.solver_error = solver_error(solvers, composition, result.box, domain.side, wavelength_nm);
    return result;
}

}  // namespace skinfit
