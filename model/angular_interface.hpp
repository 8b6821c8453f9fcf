#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/interface_rules.hpp"

namespace skinfit {

/// Quadrature over the cosines of the rays that arrive at one side of an interface, with what becomes of them.
/// Nodes crowd at grazing incidence, where absorption changes fast, and at the critical angle, where Fresnel's
/// reflectance leaves 1 with infinite slope.
///
/// `..._by_ratio` are the derivatives by ratio = index here / index beyond, with the nodes that move.
struct InterfaceNodes {
    Eigen::ArrayXd cosine;
    Eigen::ArrayXd weight;
    Eigen::ArrayXd reflectance;
    Eigen::ArrayXd refracted;  ///< cosine beyond, of the last `transmitting` nodes only
    Eigen::ArrayXd cosine_by_ratio;
    Eigen::ArrayXd weight_by_ratio;
    Eigen::ArrayXd reflectance_by_ratio;
    Eigen::ArrayXd refracted_by_ratio;  ///< as `refracted`
    Eigen::Index transmitting;          ///< number of nodes that are not totally reflected; they come last
};

/// One side of an interface and the cosines at which the integrands may jump.
struct InterfaceSide {
    InterfaceKind kind;
    double ratio;                      ///< index here / index beyond
    std::vector<double> edges_here;    ///< cosines on this side
    std::vector<double> edges_beyond;  ///< cosines on the other side
};

/// How finely the range of the cosine is cut.
struct NodeCounts {
    int degree;   ///< polynomials up to this degree are integrated exactly on each piece
    int regular;  ///< nodes per piece, at least
    int crowded;  ///< the same where the piece begins at grazing incidence or at the critical angle
};

/// The nodes of one side, piece by piece between edges, images of edges beyond and the critical angle.
[[nodiscard]] InterfaceNodes interface_nodes(const InterfaceSide& side, const NodeCounts& counts);

}  // namespace skinfit
