#include "model/angular_system.hpp"

/// The derivatives of the angular solver: the light that arrives at each node times the change of its prospects there.
namespace skinfit {

void AngularSystem::add_derivatives(std::size_t space, std::size_t index, const AngularSide& side,
                                    const ArrivingLight& light, AngularShares& shares) const {
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
