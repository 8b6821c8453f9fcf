#include "model/angular_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "model/angular_system.hpp"
#include "model/chromophores.hpp"
#include "model/layer_stack.hpp"
#include "model/viewing_cone.hpp"

namespace skinfit {
namespace {

Parameter of_layer(Parameter first, int layer) {
    return static_cast<Parameter>(static_cast<std::size_t>(first) + static_cast<std::size_t>(layer));
}

/// Collects the derivatives of the shares that escape.
struct EscapeDerivatives {
    std::array<PerExit, parameter_count> by;

    explicit EscapeDerivatives(Eigen::Index exits) { by.fill(PerExit::Zero(exits)); }
    PerExit& operator[](Parameter parameter) { return by[static_cast<std::size_t>(parameter)]; }
};

/// Rayleigh depth goes with thickness, radius^3 and (ratio^2 - 1)^2, ratio = fibre index / layer index. [KA04, Eq. 3]
void add_rayleigh_derivatives(const Sample& sample, const PerLayer<double>& rayleigh_depth, const AngularShares& shares,
                              EscapeDerivatives& derivatives) {
    const PerLayer<double> index = refractive_index(sample.skin);
    const PerLayer<double> thickness = thickness_cm(sample.skin);
    for (int layer = static_cast<int>(Layer::papillary_dermis); layer < sample.layers; ++layer) {
        const auto l = static_cast<std::size_t>(layer);
        const PerExit by_log_depth = rayleigh_depth[l] * shares.by_rayleigh_depth[l];
        derivatives[of_layer(Parameter::stratum_corneum_thickness_cm, layer)] += by_log_depth / thickness[l];
        derivatives[Parameter::fibril_radius_nm] += 3.0 / sample.skin.fibril_radius_nm * by_log_depth;
        const double ratio = sample.skin.fibre_refractive_index / index[l];
        if (ratio == 1.0) continue;  // no contrast: the depth is zero to second order
        const PerExit by_ratio = 4.0 * ratio / (ratio * ratio - 1.0) * by_log_depth;
        derivatives[Parameter::fibre_refractive_index] += by_ratio / index[l];
        derivatives[of_layer(Parameter::stratum_corneum_refractive_index, layer)] -= ratio / index[l] * by_ratio;
    }
}

void add_interface_derivatives(const AngularGrid& grid, const PerLayer<double>& index, const AngularShares& shares,
                               EscapeDerivatives& derivatives) {
    for (std::size_t i = 0; i < grid.sides.size(); ++i) {
        const AngularSide& side = grid.sides[i];
        const PerExit by_here = shares.by_ratio[i] / side.index_beyond;
        derivatives[of_layer(Parameter::stratum_corneum_refractive_index, side.layer)] += by_here;
        if (side.exit) continue;
        const double ratio = index[static_cast<std::size_t>(side.layer)] / side.index_beyond;
        derivatives[of_layer(Parameter::stratum_corneum_refractive_index, side.next)] -= ratio * by_here;
    }
}

/// Cosines of light that arrives at the exit `side` and leaves with a cosine from `low` to `high`, with weights that
/// integrate over the cosine inside and include the share that gets out.
Quadrature exit_nodes(const AngularGrid& grid, const AngularSide& side, double index, double low, double high) {
    if (side.nodes.transmitting == 0) return {};
    const bool open = side.nodes.reflectance.tail(side.nodes.transmitting).maxCoeff() == 0.0;
    const double ratio = open ? 1.0 : index / side.index_beyond;
    const FresnelInterface inwards(side.index_beyond, side.index_beyond * ratio);
    const auto inside = [&](double cosine) { return inwards.transmitted_cosine(cosine); };
    std::vector<double> ends = {low, high};
    for (const double edge : in_dermis(side.layer) ? std::vector<double>{} : grid.basis.edges) {
        const double image = FresnelInterface(ratio, 1.0).transmitted_cosine(edge);
        if (image > low && image < high) ends.push_back(image);
    }
    std::ranges::sort(ends);
    const Quadrature rule = gauss_legendre(12);
    const auto pieces = static_cast<Eigen::Index>(ends.size()) - 1;
    Quadrature nodes{.node = Eigen::ArrayXd(12 * pieces), .weight = Eigen::ArrayXd::Zero(12 * pieces)};
    for (Eigen::Index i = 0; i < 12 * pieces; ++i) {
        // Smooth in the outer cosine below the critical angle, in the inner one elsewhere; nodes crowd at grazing exit.
        const auto piece = static_cast<std::size_t>(i / 12);
        const double t = rule.node(i % 12);
        const double weight = 2.0 * t * rule.weight(i % 12);
        const bool by_outer = ratio > 1.0;
        const double begin = by_outer ? ends[piece] : inside(ends[piece]);
        const double width = (by_outer ? ends[piece + 1] : inside(ends[piece + 1])) - begin;
        const double cosine = begin + width * t * t;
        const double outer = by_outer ? cosine : FresnelInterface(ratio, 1.0).transmitted_cosine(cosine);
        nodes.node(i) = by_outer ? inside(cosine) : cosine;
        const double inner_by_cosine = by_outer ? cosine / (ratio * ratio * nodes.node(i)) : 1.0;
        if (width > 0.0) nodes.weight(i) = width * weight * inner_by_cosine * (1.0 - inwards.reflectance(outer));
    }
    return nodes;
}

}  // namespace

/// The system of one wavelength with all that it refers to.
struct AngularSolver::Wavelength {
    Extinction extinction;
    AngularMedium medium;
    AngularEntry first;
    AngularSystem system;

    Wavelength(const AngularSolver& solver, double wavelength_nm)
        : Wavelength(solver, layer_stack(solver.sample_, wavelength_nm),
                     Extinction::at(wavelength_nm, solver.sample_.edition)) {}

    Wavelength(const AngularSolver& solver, const LayerStack& stack, const Extinction& extinction_at)
        : extinction(extinction_at),
          medium{.optical_depth = optical_depth(solver.sample_.skin, extinction_at),
                 .rayleigh_depth = stack.rayleigh_depth,
                 .forward = {solver.grid_->kernel->matrix(stack.forward[0]),
                             solver.grid_->kernel->matrix(stack.forward[1])}},
          first(first_scattering(*solver.grid_, *solver.entry_, stack.forward[0])),
          system(*solver.grid_, medium, first) {}
    Wavelength(const Wavelength&) = delete;
    ~Wavelength() = default;
    Wavelength& operator=(const Wavelength&) = delete;

    static AngularEntry first_scattering(const AngularGrid& grid, const Entry& entry,
                                         const ForwardScattering& scattering) {
        const ForwardDeflection& deflection = *grid.entry.deflection;
        const Eigen::VectorXd one = deflection.basis().one();
        const Eigen::RowVectorXd shares = deflection.segment_shares(scattering);
        const Eigen::RowVectorXd mean = shares * entry.means;
        const Eigen::RowVectorXd mean_by_cosine = shares * entry.means_by_cosine;
        const double forward = mean * one;
        const double forward_by_cosine = mean_by_cosine * one;
        return {.scattered = mean / forward,
                .by_cosine = mean_by_cosine / forward - mean * (forward_by_cosine / (forward * forward))};
    }
};

AngularSolver::AngularSolver(const Sample& sample, const AngularSolverOptions& options)
    : sample_(sample), options_(options) {
    assert(sample.layers == 2 || sample.layers == 4);
    grid_ = std::make_shared<const AngularGrid>(sample, options.resolution, options.viewing_cone_rad);
    entry_ = std::make_shared<const Entry>(
        entry(*grid_, sample.skin.stratum_corneum_refractive_index, options.incidence_rad));
}

AngularSolver AngularSolver::with(const Skin& skin) const {
    Sample sample = sample_;
    sample.skin = skin;
    AngularSolver solver = *this;
    solver.sample_ = sample;
    if (refractive_index(skin) != refractive_index(sample_.skin)) {
        solver.grid_ = std::make_shared<const AngularGrid>(sample, options_.resolution, options_.viewing_cone_rad);
    }
    if (skin.stratum_corneum_refractive_index != sample_.skin.stratum_corneum_refractive_index) {
        solver.entry_ = std::make_shared<const Entry>(
            entry(*solver.grid_, skin.stratum_corneum_refractive_index, options_.incidence_rad));
    }
    return solver;
}

AngularSolver AngularSolver::refined(double factor) const {
    AngularSolverOptions options = options_;
    options.resolution = options_.resolution.refined(factor);
    return {sample_, options};
}

AngularSolver::Entry AngularSolver::entry(const AngularGrid& grid, double index, double incidence_rad) {
    const double outside = std::cos(incidence_rad);
    const double sine = std::sin(incidence_rad);
    const double inside = std::sqrt(1.0 - sine * sine / (index * index));
    const double inside_by_index = sine * sine / (index * index * index * inside);
    const double perpendicular_sum = outside + index * inside;
    const double perpendicular = (outside - index * inside) / perpendicular_sum;
    const double perpendicular_by_index =
        -2.0 * outside * (inside + index * inside_by_index) / (perpendicular_sum * perpendicular_sum);
    const double parallel_sum = index * outside + inside;
    const double parallel = (index * outside - inside) / parallel_sum;
    const double parallel_by_index = 2.0 * outside * (inside - index * inside_by_index) / (parallel_sum * parallel_sum);
    // The means depend on the cosine smoothly but for kinks too faint to matter; at normal incidence the cosine does
    // not depend on the index.
    const double step = std::min(1e-5, 0.5 * (1.0 - inside));
    const Eigen::MatrixXd means = grid.entry.deflection->segment_means(inside);
    Eigen::MatrixXd means_by_cosine = Eigen::MatrixXd::Zero(means.rows(), means.cols());
    if (step > 0.0) {
        means_by_cosine = (grid.entry.deflection->segment_means(inside + step) -
                           grid.entry.deflection->segment_means(inside - step)) /
                          (2.0 * step);
    }
    return {.reflectance = 0.5 * (perpendicular * perpendicular + parallel * parallel),
            .reflectance_by_index = perpendicular * perpendicular_by_index + parallel * parallel_by_index,
            .cosine_by_index = inside_by_index,
            .means = means,
            .means_by_cosine = means_by_cosine};
}

AngularResponse AngularSolver::respond(double wavelength_nm) const {
    return response(wavelength_nm, true);
}

AngularResponse AngularSolver::shares(double wavelength_nm) const {
    return response(wavelength_nm, false);
}

AngularResponse AngularSolver::response(double wavelength_nm, bool with_derivatives) const {
    const Wavelength wavelength(*this, wavelength_nm);
    const AngularShares shares = wavelength.system.shares(with_derivatives);
    const double entering = 1.0 - entry_->reflectance;
    struct Escaped {
        AngularShare AngularResponse::*share;
        Eigen::Index exit;
        double factor;
    };
    const std::array<Escaped, 3> escaped = {{
        {&AngularResponse::reflected, top_exit, entering},
        {&AngularResponse::transmitted, bottom_exit, entering},
        {&AngularResponse::viewed, options_.viewing_cone_rad ? cone_exit : top_exit,
         entering / white_share(options_.viewing_cone_rad)},
    }};
    AngularResponse response;
    response.surface.share = entry_->reflectance;
    for (const auto& [share, exit, factor] : escaped) (response.*share).share = factor * shares.escaped(exit);
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
        response.absorbed[layer] = entering * shares.absorbed[layer];
    }
    if (!with_derivatives) return response;

    EscapeDerivatives derivatives(grid_->exits);
    for (std::size_t p = 0; p < parameter_count; ++p) {
        const PerLayer<double> depth_by =
            optical_depth_derivative(sample_.skin, wavelength.extinction, static_cast<Parameter>(p));
        for (std::size_t layer = 0; layer < layer_count; ++layer) {
            derivatives.by[p] += depth_by[layer] * shares.by_optical_depth[layer];
        }
    }
    add_rayleigh_derivatives(sample_, wavelength.medium.rayleigh_depth, shares, derivatives);
    add_interface_derivatives(*grid_, refractive_index(sample_.skin), shares, derivatives);
    derivatives[Parameter::stratum_corneum_refractive_index] +=
        entry_->cosine_by_index * shares.by_entry_cosine - entry_->reflectance_by_index / entering * shares.escaped;
    for (const auto& [share, exit, factor] : escaped) {
        AngularShare& filled = response.*share;
        for (std::size_t p = 0; p < parameter_count; ++p) filled.by_parameter[p] = factor * derivatives.by[p](exit);
        for (std::size_t layer = 0; layer < layer_count; ++layer) {
            filled.by_optical_depth[layer] = factor * shares.by_optical_depth[layer](exit);
        }
    }
    response.surface.by_parameter[static_cast<std::size_t>(Parameter::stratum_corneum_refractive_index)] =
        entry_->reflectance_by_index;
    return response;
}

AngularComposition AngularSolver::composition(double wavelength_nm) const {
    const Wavelength wavelength(*this, wavelength_nm);
    return {grid_, wavelength.medium, wavelength.first.scattered, 1.0 - entry_->reflectance};
}

std::vector<double> AngularSolver::exit_shares(double wavelength_nm, Side side,
                                               std::span<const double> cosine_edges) const {
    const Wavelength wavelength(*this, wavelength_nm);
    const AngularSide& exit = side == Side::top ? grid_->sides[1] : grid_->sides[grid_->sides.size() - 2];
    const auto layer = static_cast<std::size_t>(exit.layer);
    const double index = refractive_index(sample_.skin)[layer];
    std::vector<double> shares;
    for (std::size_t bin = 0; bin + 1 < cosine_edges.size(); ++bin) {
        const Quadrature nodes = exit_nodes(*grid_, exit, index, cosine_edges[bin], cosine_edges[bin + 1]);
        const Eigen::ArrayXd survival = (-wavelength.medium.optical_depth[layer] / nodes.node).exp();
        const Tabulated polynomials = grid_->polynomials(exit.layer, nodes.node);
        double share = 0.0;
        for (std::size_t space = 0; space < grid_->spaces.size(); ++space) {
            const ArrivingLight light =
                wavelength.system.arriving({space, exit.layer, exit.heading}, nodes.node, polynomials);
            share += (nodes.weight * (light.completed * survival + light.turned)).sum();
        }
        shares.push_back((1.0 - entry_->reflectance) * share);
    }
    return shares;
}

}  // namespace skinfit
