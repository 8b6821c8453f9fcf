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
#include "model/emulator.hpp"
#include "model/emulator_wavelength.hpp"

namespace skinfit {
namespace {

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
using Members = std::array<const EmulatedWavelength*, emulator_lanes>;
using Degrees = PerLayer<int>;

/// The coefficient of some degrees, zero beyond the nodes of its wavelength.
double coefficient(const EmulatedWavelength& wavelength, const Degrees& degrees) {
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
        return std::ranges::any_of(members, [&](const EmulatedWavelength* wavelength) {
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
        for (const EmulatedWavelength* wavelength : members) {
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

[[noreturn]] void refuse(const ParameterInfo& row) {
    throw InputError({.where = fmt::format("free parameter {}", row.name),
                      .problem = "cannot be adjusted by engine emulator",
                      .why = "it changes where light goes, and an emulator stands for one geometry",
                      .remedy = fmt::format("set engine=solver, or fix it (--fix {})", row.name)});
}

void check(const EmulatorDomain& domain) {
    for (const ParameterRange& range : domain.ranges) {
        assert(range.lower <= range.upper);
        if (range.parameter == Parameter::fibril_radius_nm) refuse(info(range.parameter));
        refuse_to_emulate(range.parameter);
    }
}

}  // namespace

bool can_be_emulated(Parameter parameter) {
    return !info(parameter).steers || parameter == Parameter::fibril_radius_nm;
}

void refuse_to_emulate(Parameter parameter) {
    if (!can_be_emulated(parameter)) refuse(info(parameter));
}

Emulator Emulator::build(const EmulatorDomain& domain, const std::stop_token& stop) {
    check(domain);
    const AngularSolver solver(domain.sample, {.incidence_rad = domain.incidence_rad});
    const EmulatorSolvers solvers{
        .solver = solver, .finer = {solver.refined(finer_resolutions[0]), solver.refined(finer_resolutions[1])}};
    const std::size_t count = domain.wavelengths_nm.size();
    std::vector<EmulatedWavelength> wavelengths(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        leave_if_cancelled(stop);
        wavelengths[i] = emulated_wavelength(solvers, domain, domain.wavelengths_nm[i]);
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
