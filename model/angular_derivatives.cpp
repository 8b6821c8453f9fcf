#include "model/angular_system.hpp"

/// The derivatives of the angular solver: the light that arrives at each node times the change of its prospects there.
namespace skinfit {
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
    const Eigen::ArrayXd untouched = (-depth / cosine).exp();  // [KA04, Eq. 3]
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

void AngularSystem::add_derivatives(std::size_t space, std::size_t index, const ArrivingLight& light,
                                    AngularShares& shares) const {
    const AngularSide& side = grid_->sides[index];
    const InterfaceNodes& nodes = side.nodes;
    const auto layer = static_cast<std::size_t>(side.layer);
    const double depth = medium_->optical_depth[layer];
    const Eigen::ArrayXd surviving = (-depth / nodes.cosine).exp();  // [KA04, Eq. 5]
    const Eigen::ArrayXd completed = light.completed * surviving;
    const Eigen::ArrayXd arriving = completed + light.turned;
    const Eigen::ArrayXd arriving_by_cosine =
        light.completed_by_cosine * surviving + completed * depth / nodes.cosine.square() + light.turned_by_cosine;
    const Eigen::RowVectorXd share = (nodes.weight * arriving).matrix().transpose();

    const RayKind back = {grid_->space_after_reflection(space, side), side.layer, opposite(side.heading)};
    const Prospects reflected = prospects(back, nodes.cosine, side.own);
    Eigen::MatrixXd value = scaled(nodes.reflectance) * reflected.value;
    Eigen::MatrixXd value_by_ratio = scaled(nodes.reflectance_by_ratio) * reflected.value +
                                     scaled(nodes.reflectance * nodes.cosine_by_ratio) * reflected.by_cosine;
    shares.by_rayleigh_depth[layer] += share * scaled(nodes.reflectance) * reflected.by_rayleigh_depth;

    if (const Eigen::Index count = nodes.transmitting; count > 0) {
        const Eigen::ArrayXd transmittance = 1.0 - nodes.reflectance.tail(count);
        const Prospects beyond = prospects_beyond(space, side);
        value.bottomRows(count) += scaled(transmittance) * beyond.value;
        value_by_ratio.bottomRows(count) += scaled(transmittance * nodes.refracted_by_ratio) * beyond.by_cosine -
                                            scaled(nodes.reflectance_by_ratio.tail(count)) * beyond.value;
        if (!side.exit) {
            shares.by_rayleigh_depth[static_cast<std::size_t>(side.next)] +=
                share.tail(count) * scaled(transmittance) * beyond.by_rayleigh_depth;
        }
    }

    shares.by_optical_depth[layer] -= (nodes.weight * completed / nodes.cosine).matrix().transpose() * value;
    // The nodes move with the ratio, hence the change of weights and of the light at them.
    const Eigen::ArrayXd moved =
        nodes.weight_by_ratio * arriving + nodes.weight * arriving_by_cosine * nodes.cosine_by_ratio;
    shares.by_ratio[index] += moved.matrix().transpose() * value + share * value_by_ratio;
}

}  // namespace skinfit
