#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "model/angular_basis.hpp"
#include "model/angular_interface.hpp"
#include "model/angular_kernels.hpp"
#include "model/skin.hpp"

/// What the angular solver knows before it knows the wavelength: directions, interfaces and kinds of unknowns. It
/// depends on the sample's edition, layers, base and refractive indices alone. docs/model.md, section "Angular solver".
namespace skinfit {

/// How far a share of the angular solver may be from the converged one, unless another accuracy is asked for; what was
/// measured: docs/model.md.
inline constexpr double solver_accuracy = 1e-4;

/// How finely directions are resolved.
struct AngularResolution {
    int panels;          ///< of stratum corneum and epidermis, of equal width in polar angle; cubic polynomials on each
    int rayleigh_terms;  ///< of the expansion of the `printed` Rayleigh kernel; `revised` needs two and has no more
    int points;          ///< quadrature nodes per piece
    int crowded_points;  ///< the same where the integrands are steep
    int entry_panels;    ///< of the light that enters, before and after its first scattering

    /// The coarsest resolution whose shares were found within `accuracy` (1e-3, 1e-4 or 2e-5) of those of 24 panels:
    /// see docs/model.md, "Accuracy and cost", and tests/model/angular_convergence.cpp. Throws InputError below 2e-5.
    [[nodiscard]] static AngularResolution for_accuracy(double accuracy);
    /// `factor` times as many panels and terms, with which the error of this resolution is estimated.
    [[nodiscard]] AngularResolution refined(double factor) const;
};

/// Directions of travel.
enum class Heading : std::size_t { down, up };

[[nodiscard]] constexpr Heading opposite(Heading heading) {
    return heading == Heading::down ? Heading::up : Heading::down;
}

/// Columns of what is kept per way out. What leaves through the top into the viewing cone is a part of what leaves
/// through the top; it has a column where there is a cone.
inline constexpr Eigen::Index top_exit = 0;
inline constexpr Eigen::Index bottom_exit = 1;
inline constexpr Eigen::Index cone_exit = 2;

/// The rays of one layer that travel in one direction, as they arrive at the interface ahead.
struct AngularSide {
    int layer;
    Heading heading;
    int next;             ///< layer beyond; -1 is the air and the number of layers the base
    bool exit;            ///< whether air or base lies beyond
    double index_beyond;  ///< 1 where the base has none
    InterfaceNodes nodes;
    Tabulated own;            ///< the layer's polynomials at `nodes.cosine`
    Tabulated beyond;         ///< the next layer's at `nodes.refracted`
    Eigen::MatrixXd leaving;  ///< at an exit, 1 for each way out that the light of a transmitting node takes, else 0
};

/// The unknowns that belong to the starts of runs in one layer and direction: polynomials in stratum corneum and
/// epidermis; in the dermis one for diffuse scattering and, where the Rayleigh test is asked for, one per Rayleigh
/// term.
struct StateBlock {
    Eigen::Index first;
    Eigen::Index size;
    bool rayleigh;
};

/// All unknowns of rays that have bounced, or that have not, or of all rays where the edition does not ask.
struct StateSpace {
    std::array<std::array<StateBlock, 2>, layer_count> blocks;
    Eigen::Index size;

    [[nodiscard]] const StateBlock& block(int layer, Heading heading) const {
        return blocks[static_cast<std::size_t>(layer)][static_cast<std::size_t>(heading)];
    }
};

/// The light that has entered, as it arrives at the first interface inside after its first scattering. It may be peaked
/// where that interface's reflectance bends, so it has panels, finer by far, and nodes of its own.
struct EntryGrid {
    std::shared_ptr<const ForwardDeflection> deflection;
    AngularSide side;               ///< the first side once more
    SparselyTabulated polynomials;  ///< of `deflection` at the nodes of `side`
};

/// The rays of one layer that travel in one direction.
struct LayerHeading {
    int layer;
    Heading heading;
};

struct AngularGrid {
    Eigen::Index exits;  ///< columns per way out
    PanelBasis basis;
    std::shared_ptr<const ForwardKernel> kernel;
    Eigen::ArrayXd rayleigh;         ///< coefficients of the Rayleigh kernel
    std::vector<AngularSide> sides;  ///< two per layer: down, up
    std::vector<StateSpace> spaces;  ///< rays of the first enter the second where they bounce, never the other way
    EntryGrid entry;

    /// `viewing_cone_rad` is the half angle about the normal above the sample, up to pi/2, where there is a cone.
    AngularGrid(const Sample& sample, const AngularResolution& resolution, std::optional<double> viewing_cone_rad);

    /// The side of `rays`, with pieces that end at `edges_here` in stratum corneum and epidermis.
    [[nodiscard]] AngularSide side(const Sample& sample, const AngularResolution& resolution,
                                   std::optional<double> viewing_cone_rad, const LayerHeading& rays,
                                   const std::vector<double>& edges_here) const;
    /// The polynomials in which the light of `layer` is expressed, at `cosine`.
    [[nodiscard]] Tabulated polynomials(int layer, const Eigen::ArrayXd& cosine) const;
    /// The space in which a ray of `space` goes on after reflection at `side`.
    [[nodiscard]] std::size_t space_after_reflection(std::size_t space, const AngularSide& side) const;
};

}  // namespace skinfit
