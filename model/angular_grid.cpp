#include "model/angular_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/input_error.hpp"
#include "model/constants.hpp"
#include "model/scattering.hpp"
#include "model/viewing_cone.hpp"

namespace skinfit {
namespace {

constexpr int polynomials_per_panel = 4;
constexpr int first_dermis = static_cast<int>(Layer::papillary_dermis);

PanelBasis panel_basis(int panels) {
    PanelBasis basis{.edges = {0.0}, .order = polynomials_per_panel};
    for (int i = 1; i < panels; ++i) basis.edges.push_back(std::sin(0.5 * pi * i / panels));
    basis.edges.push_back(1.0);
    return basis;
}

/// Panels of which every edge of `coarse` is an edge, `panels` of equal width in polar angle and more.
PanelBasis entry_basis(const PanelBasis& coarse, int panels) {
    PanelBasis basis = panel_basis(panels);
    basis.edges.insert(basis.edges.end(), coarse.edges.begin(), coarse.edges.end());
    std::ranges::sort(basis.edges);
    std::vector<double> apart;
    for (const double edge : basis.edges) {
        if (apart.empty() || edge - apart.back() > 1e-9) apart.push_back(edge);
    }
    apart.back() = 1.0;
    basis.edges = apart;
    return basis;
}

std::vector<StateSpace> state_spaces(const Sample& sample, Eigen::Index polynomials, Eigen::Index rayleigh_terms) {
    const bool remembers_bounce = sample.edition == Edition::printed && sample.layers > first_dermis;
    std::vector<StateSpace> spaces(remembers_bounce ? 2 : 1);
    for (std::size_t s = 0; s < spaces.size(); ++s) {
        spaces[s].size = 0;
        for (int layer = 0; layer < sample.layers; ++layer) {
            for (const Heading heading : {Heading::down, Heading::up}) {
                const bool bounced = s > 0;
                const bool rayleigh =
                    in_dermis(layer) && asks_for_rayleigh(sample.edition, heading == Heading::down, bounced);
                const Eigen::Index size = !in_dermis(layer) ? polynomials : rayleigh ? 1 + rayleigh_terms : 1;
                spaces[s].blocks[static_cast<std::size_t>(layer)][static_cast<std::size_t>(heading)] = {
                    .first = spaces[s].size, .size = size, .rayleigh = rayleigh};
                spaces[s].size += size;
            }
        }
    }
    return spaces;
}

double index_beyond(const Sample& sample, int next) {
    if (next < 0) return 1.0;
    if (next == sample.layers) return sample.base.kind == Base::Kind::index ? sample.base.refractive_index : 1.0;
    return refractive_index(sample.skin)[static_cast<std::size_t>(next)];
}

/// `AngularSide::leaving` of the side of an exit. The light in the cone has an outer cosine above `cone_cosine`.
Eigen::MatrixXd ways_out(const InterfaceNodes& nodes, Heading heading, std::optional<double> cone_cosine) {
    Eigen::MatrixXd leaving = Eigen::MatrixXd::Zero(nodes.transmitting, cone_cosine ? 3 : 2);
    leaving.col(heading == Heading::up ? top_exit : bottom_exit).setOnes();
    if (cone_cosine && heading == Heading::up) {
        leaving.col(cone_exit) = (nodes.refracted > *cone_cosine).cast<double>();
    }
    return leaving;
}

}  // namespace

AngularResolution AngularResolution::for_accuracy(double accuracy) {
    if (accuracy >= 1e-3)
        return {.panels = 4, .rayleigh_terms = 8, .points = 7, .crowded_points = 12, .entry_panels = 48};
    if (accuracy >= 1e-4)
        return {.panels = 6, .rayleigh_terms = 12, .points = 7, .crowded_points = 12, .entry_panels = 48};
    if (accuracy >= 2e-5)
        return {.panels = 16, .rayleigh_terms = 20, .points = 7, .crowded_points = 20, .entry_panels = 48};
    throw InputError({.where = fmt::format("accuracy {}", accuracy),
                      .problem = "finer than the angular solver's finest resolution",
                      .why = "its error was measured down to 2e-5 only",
                      .remedy = "ask for 2e-5 or more"});
}

AngularResolution AngularResolution::refined(double factor) const {
    const auto times = [factor](int count) { return static_cast<int>(std::lround(factor * count)); };
    return {.panels = times(panels),
            .rayleigh_terms = times(rayleigh_terms),
            .points = points,
            .crowded_points = times(crowded_points),
            .entry_panels = times(entry_panels)};
}

AngularGrid::AngularGrid(const Sample& sample, const AngularResolution& resolution,
                         std::optional<double> viewing_cone_rad)
    : exits(viewing_cone_rad ? 3 : 2),
      basis(panel_basis(resolution.panels)),
      kernel(ForwardKernel::of(basis)),
      rayleigh(rayleigh_coefficients(sample.edition, resolution.rayleigh_terms)),
      spaces(state_spaces(sample, basis.size(), rayleigh.size())),
      entry{.deflection = std::make_shared<const ForwardDeflection>(entry_basis(basis, resolution.entry_panels)),
            .side = {},
            .polynomials = {}} {
    for (int layer = 0; layer < sample.layers; ++layer) {
        for (const Heading heading : {Heading::down, Heading::up}) {
            sides.push_back(side(sample, resolution, viewing_cone_rad, {layer, heading}, basis.edges));
        }
    }
    const PanelBasis& fine = entry.deflection->basis();
    entry.side = side(sample, resolution, viewing_cone_rad, {0, Heading::down}, fine.edges);
    entry.polynomials = fine.sparsely_at(entry.side.nodes.cosine);
}

AngularSide AngularGrid::side(const Sample& sample, const AngularResolution& resolution,
                              std::optional<double> viewing_cone_rad, const LayerHeading& rays,
                              const std::vector<double>& edges_here) const {
    const int layer = rays.layer;
    const int next = rays.heading == Heading::down ? layer + 1 : layer - 1;
    std::optional<double> cone_cosine;
    if (viewing_cone_rad) cone_cosine = viewing_cone_cosine(*viewing_cone_rad);
    const auto edges = [&](int at, const std::vector<double>& panels) {
        if (at < 0 && cone_cosine) return std::vector<double>{*cone_cosine};
        const bool panelled = at >= 0 && at < sample.layers && !in_dermis(at);
        return panelled ? panels : std::vector<double>{};
    };
    const double beyond = index_beyond(sample, next);
    const int rayleigh_degree = 2 * static_cast<int>(rayleigh.size()) - 2;
    InterfaceNodes nodes = interface_nodes(
        {.kind = interface_kind(sample.base.kind, sample.layers, next),
         .ratio = refractive_index(sample.skin)[static_cast<std::size_t>(layer)] / beyond,
         .edges_here = edges(layer, edges_here),
         .edges_beyond = edges(next, basis.edges)},
        {.degree = in_dermis(layer) ? std::max(1, rayleigh_degree) : polynomials_per_panel - 1,
         .regular = in_dermis(layer) ? 2 * resolution.points : resolution.points,  // pieces are wider there
         .crowded = resolution.crowded_points});
    const bool exit = next < 0 || next == sample.layers;
    Eigen::MatrixXd leaving = exit ? ways_out(nodes, rays.heading, cone_cosine) : Eigen::MatrixXd{};
    Tabulated own_polynomials = polynomials(layer, nodes.cosine);
    Tabulated beyond_polynomials = exit ? Tabulated{} : polynomials(next, nodes.refracted);
    return {.layer = layer,
            .heading = rays.heading,
            .next = next,
            .exit = exit,
            .index_beyond = beyond,
            .nodes = std::move(nodes),
            .own = std::move(own_polynomials),
            .beyond = std::move(beyond_polynomials),
            .leaving = std::move(leaving)};
}

Tabulated AngularGrid::polynomials(int layer, const Eigen::ArrayXd& cosine) const {
    return in_dermis(layer) ? even_legendre(cosine, static_cast<int>(rayleigh.size())) : basis.at(cosine);
}

std::size_t AngularGrid::space_after_reflection(std::size_t space, const AngularSide& side) const {
    return bounces(side.layer, side.next) && space + 1 < spaces.size() ? space + 1 : space;
}

}  // namespace skinfit
