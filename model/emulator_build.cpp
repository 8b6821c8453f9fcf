#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/input_error.hpp"
#include "core/stop.hpp"
#include "model/angular_error.hpp"
#include "model/angular_solver.hpp"
#include "model/chebyshev.hpp"
#include "model/chromophores.hpp"
#include "model/depth_box.hpp"
#include "model/emulator.hpp"

namespace skinfit {
namespace {

/// Loops over terms end with the last of this size, and the nodes suffice where the series along a layer has fallen
/// below it. The error this leads to is found by `certify`.
constexpr double least_coefficient = 5e-7;

using DepthVector = std::vector<PerLayer<double>>;

/// One wavelength on the way to an emulator.
struct Wavelength {
    DepthBox box;
    std::array<int, layer_count> counts;  // of nodes, and of coefficients
    std::vector<double> coefficients;     // tensor, last layer fastest
    DepthVector test_upper;               // the specimens on which the error is found: all combinations of upper
    DepthVector test_lower;               // and lower layers
    ShareTable test_shares;
    double solver_error = 0.0;  // the largest that the solver states
};

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
    constexpr std::array<double, parameter_count> primes = {2,  3,  5,  7,  11, 13, 17, 19, 23, 29, 31, 37, 41,
                                                            43, 47, 53, 59, 61, 67, 71, 73, 79, 83, 89, 97, 101};
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

/// The solver whose shares are expanded, and the finer ones that tell its error.
struct Solvers {
    AngularSolver solver;
    std::array<AngularSolver, finer_resolutions.size()> finer;
};

/// The largest error that the solver states where the layers absorb least, most and in between: it is largest where
/// little is absorbed, and changes slowly.
double solver_error(const Solvers& solvers, const AngularComposition& composition, const DepthBox& box, Side side,
                    double wavelength_nm) {
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

Wavelength computed(const Solvers& solvers, const EmulatorDomain& domain, double wavelength_nm) {
    constexpr int upper_specimens = 32;
    constexpr int lower_specimens = 64;
    const Extinction extinction = Extinction::at(wavelength_nm, domain.sample.edition);
    const AngularComposition composition = solvers.solver.composition(wavelength_nm);
    Wavelength result{.box = depth_box(domain, extinction),
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

/// A group with what its series refers to.
struct Grouped {
    Emulator::Group group{};
    std::vector<std::uint8_t> counts;
    std::vector<float> coefficients;

    [[nodiscard]] EmulatorSeries series() const {
        return {.most = group.most, .counts = counts, .coefficients = coefficients};
    }
};

/// The wavelengths of a group.
using Members = std::array<const Wavelength*, emulator_lanes>;
using Degrees = PerLayer<int>;

/// The coefficient of some degrees, zero beyond the nodes of its wavelength.
double coefficient(const Wavelength& wavelength, const Degrees& degrees) {
    std::size_t place = 0;
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
        if (degrees[layer] >= wavelength.counts[layer]) return 0.0;
        place = place * static_cast<std::size_t>(wavelength.counts[layer]) + static_cast<std::size_t>(degrees[layer]);
    }
    return wavelength.coefficients[place];
}

/// Whether any term matters that has these degrees in the layers up to `layer`.
bool matters(const Members& members, const Degrees& most, Degrees degrees, std::size_t layer) {
    if (layer + 1 == layer_count) {
        return std::ranges::any_of(members, [&](const Wavelength* wavelength) {
            return std::abs(coefficient(*wavelength, degrees)) >= least_coefficient;
        });
    }
    for (int next = 0; next < most[layer + 1]; ++next) {
        degrees[layer + 1] = next;
        if (matters(members, most, degrees, layer + 1)) return true;
    }
    return false;
}

/// Adds the loop over the degrees of `layer` and those within, given the degrees of the layers above.
void add_loop(const Members& members, const Degrees& most, Degrees degrees, std::size_t layer, Grouped& grouped) {
    int count = most[layer];
    for (; count > 0; --count) {
        degrees[layer] = count - 1;
        if (matters(members, most, degrees, layer)) break;
    }
    grouped.counts.push_back(static_cast<std::uint8_t>(count));
    grouped.group.most[layer] = std::max(grouped.group.most[layer], count);
    for (int degree = 0; degree < count; ++degree) {
        degrees[layer] = degree;
        if (layer + 1 < layer_count) {
            add_loop(members, most, degrees, layer + 1, grouped);
            continue;
        }
        for (const Wavelength* wavelength : members) {
            grouped.coefficients.push_back(static_cast<float>(coefficient(*wavelength, degrees)));
        }
    }
}

Grouped grouped(const Members& members) {
    Grouped result;
    Degrees most{};
    for (std::size_t lane = 0; lane < emulator_lanes; ++lane) {
        const DepthBox& box = members[lane]->box;
        for (std::size_t layer = 0; layer < layer_count; ++layer) {
            const DepthCoordinate coordinate(box, layer);
            result.group.coordinate.shift[layer][lane] = coordinate.shift;
            result.group.coordinate.scale[layer][lane] = coordinate.scale;
            result.group.coordinate.offset[layer][lane] = coordinate.offset;
            result.group.lowest[layer][lane] = box.lowest[layer];
            result.group.highest[layer][lane] = box.highest[layer];
            most[layer] = std::max(most[layer], members[lane]->counts[layer]);
        }
    }
    add_loop(members, most, {}, 0, result);
    result.group.count_count = result.counts.size();
    result.group.coefficient_count = result.coefficients.size();
    return result;
}

/// Finds the largest deviations on the test specimens and notes them, half as much again for what lies between, and the
/// solver's own error.
void certify(const Members& members, Grouped& grouped) {
    constexpr double margin = 1.5;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const EmulatorSeries series = grouped.series();
    for (std::size_t upper = 0; upper < members[0]->test_upper.size(); ++upper) {
        for (std::size_t lower = 0; lower < members[0]->test_lower.size(); ++lower) {
            PerLayer<Lanes<double>> depths;
            for (std::size_t lane = 0; lane < emulator_lanes; ++lane) {
                for (std::size_t layer = 0; layer < layer_count; ++layer) {
                    depths[layer][lane] =
                        layer < 2 ? members[lane]->test_upper[upper][layer] : members[lane]->test_lower[lower][layer];
                }
            }
            const EmulatorSums sums = sum_series(series, grouped.group.coordinate, depths);
            for (std::size_t lane = 0; lane < emulator_lanes; ++lane) {
                const double exact =
                    members[lane]->test_shares(static_cast<Eigen::Index>(upper), static_cast<Eigen::Index>(lower));
                const double deviation = margin * std::abs(sums.value[lane] - exact);
                double& certified = grouped.group.certified_error[lane];
                certified = std::max(certified, std::isfinite(deviation) ? deviation : infinity);
            }
        }
    }
    for (std::size_t lane = 0; lane < emulator_lanes; ++lane) {
        grouped.group.certified_error[lane] += members[lane]->solver_error;
    }
}

void check(const EmulatorDomain& domain) {
    for (const ParameterRange& range : domain.ranges) {
        assert(range.lower <= range.upper);
        refuse_to_emulate(range.parameter);
    }
}

}  // namespace

void refuse_to_emulate(Parameter parameter) {
    const ParameterInfo& row = info(parameter);
    if (!row.steers) return;
    throw InputError({.where = fmt::format("free parameter {}", row.name),
                      .problem = "cannot be adjusted by engine emulator",
                      .why = "it changes where light goes, and an emulator stands for one geometry",
                      .remedy = fmt::format("set engine=solver, or fix it (--fix {})", row.name)});
}

Emulator Emulator::build(const EmulatorDomain& domain, const std::stop_token& stop) {
    check(domain);
    const AngularSolver solver(domain.sample, {.incidence_rad = domain.incidence_rad});
    const Solvers solvers{.solver = solver,
                          .finer = {solver.refined(finer_resolutions[0]), solver.refined(finer_resolutions[1])}};
    const std::size_t count = domain.wavelengths_nm.size();
    std::vector<Wavelength> wavelengths(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        leave_if_cancelled(stop);
        wavelengths[i] = computed(solvers, domain, domain.wavelengths_nm[i]);
    });
    struct Owner {
        std::vector<std::uint8_t> counts;
        std::vector<float> coefficients;
    };
    const auto owner = std::make_shared<Owner>();
    std::vector<Grouped> groups((count + emulator_lanes - 1) / emulator_lanes);
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t i) {
        leave_if_cancelled(stop);
        Members members{};
        for (std::size_t lane = 0; lane < emulator_lanes; ++lane) {
            members[lane] = &wavelengths[std::min(i * emulator_lanes + lane, count - 1)];
        }
        groups[i] = grouped(members);
        certify(members, groups[i]);
    });
    std::vector<Group> plain;
    for (const Grouped& group : groups) {
        plain.push_back(group.group);
        owner->counts.insert(owner->counts.end(), group.counts.begin(), group.counts.end());
        owner->coefficients.insert(owner->coefficients.end(), group.coefficients.begin(), group.coefficients.end());
    }
    return Emulator({.surface_share = solver.surface_share(),
                     .wavelength_count = count,
                     .groups = std::move(plain),
                     .coefficients = owner->coefficients,
                     .counts = owner->counts,
                     .owner = owner});
}

}  // namespace skinfit
