#include "model/angular_system.hpp"

#include <Eigen/LU>

namespace skinfit {
namespace {

/// The share that passes a layer at the given cosines: of absorption [KA04, Eq. 5] or of Rayleigh's test [KA04, Eq. 3].
Eigen::ArrayXd passing(const Eigen::ArrayXd& cosine, double depth) {
    return (-depth / cosine).exp();
}

}  // namespace

Eigen::MatrixXd run_starts(const AngularGrid& grid, const AngularMedium& medium, const RayKind& kind,
                           const Eigen::ArrayXd& cosine, const Tabulated& polynomials) {
    if (!in_dermis(kind.layer)) return polynomials.value;
    const StateBlock& block = grid.spaces[kind.space].block(kind.layer, kind.heading);
    if (!block.rayleigh) return Eigen::MatrixXd::Ones(cosine.size(), 1);
    const Eigen::ArrayXd diffuse = passing(cosine, medium.rayleigh_depth[static_cast<std::size_t>(kind.layer)]);
    Eigen::MatrixXd result(cosine.size(), block.size);
    result.col(0) = diffuse;
    result.rightCols(block.size - 1) = scaled(1.0 - diffuse) * polynomials.value * scaled(grid.rayleigh);
    return result;
}

AngularSystem::AngularSystem(const AngularGrid& grid, const AngularMedium& medium, const AngularEntry& entry)
    : grid_(&grid), medium_(&medium), entry_(&entry), prospect_(grid.spaces.size()) {
    std::vector<Eigen::PartialPivLU<Eigen::MatrixXd>> inverse(grid.spaces.size());
    Eigen::VectorXd entering;
    for (std::size_t s = grid.spaces.size(); s-- > 0;) {
        Assembled system = assemble(s);
        for (int layer = 0; layer < static_cast<int>(Layer::papillary_dermis); ++layer) {
            const Eigen::MatrixXd& forward = medium.forward[static_cast<std::size_t>(layer)];
            for (const Heading heading : {Heading::down, Heading::up}) {
                const StateBlock& block = grid.spaces[s].block(layer, heading);
                auto rows = system.matrix.middleRows(block.first, block.size);
                auto payoff = system.payoff.middleRows(block.first, block.size);
                rows = forward * rows;  // Eigen evaluates a product before it assigns
                payoff = forward * payoff;
            }
        }
        system.matrix = Eigen::MatrixXd::Identity(grid.spaces[s].size, grid.spaces[s].size) - system.matrix;
        inverse[s].compute(system.matrix);
        prospect_[s] = inverse[s].solve(system.payoff);
    }
    const Assembled first = this->entering();
    entering = first.matrix.row(0).transpose();
    by_entry_cosine_ = first.matrix.row(1) * prospect_[0] + first.payoff.row(1);
    for (std::size_t s = 0; s < grid.spaces.size(); ++s) {
        visits_.emplace_back(inverse[s].transpose().solve(s == 0 ? entering : bouncing(s - 1)));
    }
}

/// The light that has entered as a sender, and its derivative by the cosine at which it has entered as another.
AngularSystem::Assembled AngularSystem::entering() const {
    const AngularSide& side = grid_->entry.side;
    Assembled rows{.matrix = Eigen::MatrixXd::Zero(2, grid_->spaces[0].size),
                   .payoff = Eigen::MatrixXd::Zero(2, grid_->exits)};
    Eigen::MatrixXd senders(side.nodes.cosine.size(), 2);
    senders.col(0) = grid_->entry.polynomials.value * entry_->scattered.transpose();
    senders.col(1) = grid_->entry.polynomials.value * entry_->by_cosine.transpose();
    const Eigen::ArrayXd surviving = side.nodes.weight * passing(side.nodes.cosine, medium_->optical_depth[0]);
    add_senders(0, side, 0, scaled(surviving) * senders, rows);
    return rows;
}

ArrivingLight AngularSystem::entering_light() const {
    const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(grid_->entry.side.nodes.cosine.size());
    return {.completed = grid_->entry.polynomials.value * entry_->scattered.transpose(),
            .turned = none,
            .completed_by_cosine = grid_->entry.polynomials.derivative * entry_->scattered.transpose(),
            .turned_by_cosine = none};
}

Eigen::VectorXd AngularSystem::bouncing(std::size_t space) const {
    Eigen::VectorXd entering = Eigen::VectorXd::Zero(grid_->spaces[space + 1].size);
    for (const AngularSide& side : grid_->sides) {
        if (grid_->space_after_reflection(space, side) == space) continue;
        const InterfaceNodes& nodes = side.nodes;
        const ArrivingLight light = arriving({space, side.layer, side.heading}, nodes.cosine, side.own);
        const double depth = medium_->optical_depth[static_cast<std::size_t>(side.layer)];
        const Eigen::ArrayXd reflected =
            nodes.weight * nodes.reflectance * (light.completed * passing(nodes.cosine, depth) + light.turned);
        const RayKind kind = {space + 1, side.layer, opposite(side.heading)};
        const StateBlock& block = grid_->spaces[space + 1].block(kind.layer, kind.heading);
        entering.segment(block.first, block.size) +=
            run_starts(*grid_, *medium_, kind, nodes.cosine, side.own).transpose() * reflected.matrix();
    }
    return entering;
}

AngularSystem::Prospects AngularSystem::prospects(const RayKind& kind, const Eigen::ArrayXd& cosine,
                                                  const Tabulated& polynomials) const {
    const StateBlock& block = grid_->spaces[kind.space].block(kind.layer, kind.heading);
    const auto prospect = prospect_[kind.space].middleRows(block.first, block.size);
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(cosine.size(), grid_->exits);
    if (!in_dermis(kind.layer)) return {polynomials.value * prospect, polynomials.derivative * prospect, none};
    const Eigen::MatrixXd diffuse = Eigen::VectorXd::Ones(cosine.size()) * prospect.row(0);
    if (!block.rayleigh) return {diffuse, none, none};
    const Eigen::MatrixXd weighted = scaled(grid_->rayleigh) * prospect.bottomRows(block.size - 1);
    const Eigen::MatrixXd gain = polynomials.value * weighted - diffuse;
    const double depth = medium_->rayleigh_depth[static_cast<std::size_t>(kind.layer)];
    const Eigen::ArrayXd untouched = passing(cosine, depth);
    const Eigen::ArrayXd by_depth = untouched / cosine;
    return {diffuse + scaled(1.0 - untouched) * gain,
            scaled(1.0 - untouched) * (polynomials.derivative * weighted) - scaled(depth * by_depth / cosine) * gain,
            scaled(by_depth) * gain};
}

AngularSystem::Prospects AngularSystem::prospects_beyond(std::size_t space, const AngularSide& side) const {
    if (!side.exit) return prospects({space, side.next, side.heading}, side.nodes.refracted, side.beyond);
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(side.nodes.transmitting, grid_->exits);
    return {side.leaving, none, none};
}

AngularSystem::Assembled AngularSystem::assemble(std::size_t space) const {
    const StateSpace& states = grid_->spaces[space];
    Assembled system{.matrix = Eigen::MatrixXd::Zero(states.size, states.size),
                     .payoff = Eigen::MatrixXd::Zero(states.size, grid_->exits)};
    for (const AngularSide& side : grid_->sides) {
        const Eigen::ArrayXd& weight = side.nodes.weight;
        const Eigen::ArrayXd surviving =
            weight * passing(side.nodes.cosine, medium_->optical_depth[static_cast<std::size_t>(side.layer)]);
        const StateBlock& own = states.block(side.layer, side.heading);
        const StateBlock& other = states.block(side.layer, opposite(side.heading));
        if (!in_dermis(side.layer)) {
            add_senders(space, side, own.first, scaled(surviving) * side.own.value, system);
            continue;
        }
        add_senders(space, side, own.first, 2.0 * surviving * side.nodes.cosine, system);  // [KA04, Eq. 4]
        if (own.rayleigh) add_senders(space, side, own.first + 1, scaled(surviving) * side.own.value, system);
        if (other.rayleigh) add_senders(space, side, other.first + 1, scaled(weight) * side.own.value, system);
    }
    return system;
}

/// Adds what becomes, at `side`, of the light that the unknowns from `first` on send to its nodes; one column of
/// `senders` per unknown, times the nodes' weights.
void AngularSystem::add_senders(std::size_t space, const AngularSide& side, Eigen::Index first,
                                const Eigen::MatrixXd& senders, Assembled& system) const {
    const InterfaceNodes& nodes = side.nodes;
    const StateSpace& states = grid_->spaces[space];
    auto rows = system.matrix.middleRows(first, senders.cols());
    auto payoff = system.payoff.middleRows(first, senders.cols());

    const RayKind back = {grid_->space_after_reflection(space, side), side.layer, opposite(side.heading)};
    const Eigen::MatrixXd reflected = senders.transpose() * scaled(nodes.reflectance);
    if (back.space == space) {
        const StateBlock& block = states.block(back.layer, back.heading);
        rows.middleCols(block.first, block.size) +=
            reflected * run_starts(*grid_, *medium_, back, nodes.cosine, side.own);
    } else {
        payoff += reflected * prospects(back, nodes.cosine, side.own).value;
    }

    if (nodes.transmitting == 0) return;
    const Eigen::MatrixXd transmitted =
        senders.bottomRows(nodes.transmitting).transpose() * scaled(1.0 - nodes.reflectance.tail(nodes.transmitting));
    if (side.exit) {
        payoff += transmitted * side.leaving;
        return;
    }
    const StateBlock& block = states.block(side.next, side.heading);
    rows.middleCols(block.first, block.size) +=
        transmitted * run_starts(*grid_, *medium_, {space, side.next, side.heading}, nodes.refracted, side.beyond);
}

ArrivingLight AngularSystem::arriving(const RayKind& kind, const Eigen::ArrayXd& cosine,
                                      const Tabulated& polynomials) const {
    const StateBlock& own = grid_->spaces[kind.space].block(kind.layer, kind.heading);
    const StateBlock& other = grid_->spaces[kind.space].block(kind.layer, opposite(kind.heading));
    const Eigen::VectorXd& visits = visits_[kind.space];
    const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(cosine.size());
    ArrivingLight light{.completed = none, .turned = none, .completed_by_cosine = none, .turned_by_cosine = none};
    if (!in_dermis(kind.layer)) {
        const Eigen::MatrixXd& forward = medium_->forward[static_cast<std::size_t>(kind.layer)];
        const Eigen::VectorXd sent = forward.transpose() * visits.segment(own.first, own.size);
        light.completed = polynomials.value * sent;
        light.completed_by_cosine = polynomials.derivative * sent;
        return light;
    }
    light.completed = 2.0 * visits(own.first) * cosine;  // [KA04, Eq. 4]
    light.completed_by_cosine += 2.0 * visits(own.first);
    if (own.rayleigh) {
        const auto sent = visits.segment(own.first + 1, own.size - 1);
        light.completed += (polynomials.value * sent).array();
        light.completed_by_cosine += (polynomials.derivative * sent).array();
    }
    if (other.rayleigh) {
        const auto sent = visits.segment(other.first + 1, other.size - 1);
        light.turned = polynomials.value * sent;
        light.turned_by_cosine = polynomials.derivative * sent;
    }
    return light;
}

void AngularSystem::add_light(std::size_t space, std::size_t index, const AngularSide& side, const ArrivingLight& light,
                              bool with_derivatives, AngularShares& shares) const {
    const InterfaceNodes& nodes = side.nodes;
    const auto layer = static_cast<std::size_t>(side.layer);
    const Eigen::ArrayXd surviving = passing(nodes.cosine, medium_->optical_depth[layer]);
    shares.absorbed[layer] += (nodes.weight * light.completed * (1.0 - surviving)).sum();
    if (side.exit) {
        const Eigen::ArrayXd arriving = light.completed * surviving + light.turned;
        const Eigen::ArrayXd leaving = nodes.weight * (1.0 - nodes.reflectance) * arriving;
        shares.escaped += leaving.tail(nodes.transmitting).matrix().transpose() * side.leaving;
    }
    if (with_derivatives) add_derivatives(space, index, side, light, shares);
}

AngularShares AngularSystem::shares(bool with_derivatives) const {
    AngularShares shares(*grid_);
    shares.by_entry_cosine = by_entry_cosine_;
    add_light(0, 0, grid_->entry.side, entering_light(), with_derivatives, shares);
    for (std::size_t space = 0; space < grid_->spaces.size(); ++space) {
        for (std::size_t i = 0; i < grid_->sides.size(); ++i) {
            const AngularSide& side = grid_->sides[i];
            const ArrivingLight light = arriving({space, side.layer, side.heading}, side.nodes.cosine, side.own);
            add_light(space, i, side, light, with_derivatives, shares);
        }
    }
    return shares;
}

}  // namespace skinfit
