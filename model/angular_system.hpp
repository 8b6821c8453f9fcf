#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/angular_grid.hpp"
#include "model/skin.hpp"

/// The linear system of the angular solver at one wavelength. docs/model.md, section "Angular solver", states it.
namespace skinfit {

/// What one wavelength adds to the grid.
struct AngularMedium {
    PerLayer<double> optical_depth;
    PerLayer<double> rayleigh_depth;         ///< at normal passage; zero outside the dermis
    std::array<Eigen::MatrixXd, 2> forward;  ///< of stratum corneum and epidermis, from ForwardKernel
};

/// The light after its first scattering in the topmost layer, per polynomial of the grid's `entry`.
struct AngularEntry {
    Eigen::RowVectorXd scattered;
    Eigen::RowVectorXd by_cosine;  ///< derivative by the cosine of the ray that enters
};

/// One number for each way out: top, bottom and, where there is one, the viewing cone.
using PerExit = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 3>;

/// The shares of the light that enters the topmost layer, and the derivatives of those that escape.
struct AngularShares {
    PerExit escaped;
    PerLayer<double> absorbed{};
    PerExit by_entry_cosine;
    PerLayer<PerExit> by_optical_depth;
    PerLayer<PerExit> by_rayleigh_depth;
    std::vector<PerExit> by_ratio;  ///< per side of the grid, by its ratio of refractive indices

    explicit AngularShares(const AngularGrid& grid)
        : escaped(PerExit::Zero(grid.exits)), by_entry_cosine(escaped), by_ratio(grid.sides.size(), escaped) {
        by_optical_depth.fill(escaped);
        by_rayleigh_depth.fill(escaped);
    }
};

/// The light that arrives at an interface per unit of the cosine, at some cosines.
struct ArrivingLight {
    Eigen::ArrayXd completed;  ///< before the absorption of the run it has completed
    Eigen::ArrayXd turned;     ///< turned back by Rayleigh scattering on its way to the other interface, never absorbed
    Eigen::ArrayXd completed_by_cosine;
    Eigen::ArrayXd turned_by_cosine;
};

/// Which rays: those of one space of the grid, in one layer and direction.
struct RayKind {
    std::size_t space;
    int layer;
    Heading heading;
};

/// How the chances of rays of one kind that start a run at `cosine`, where the polynomials of their layer are
/// `polynomials`, are made up of the unknowns of their block: one row per cosine.
[[nodiscard]] Eigen::MatrixXd run_starts(const AngularGrid& grid, const AngularMedium& medium, const RayKind& kind,
                                         const Eigen::ArrayXd& cosine, const Tabulated& polynomials);

/// The system, solved for rays that enter the topmost layer. Refers to its arguments, which must outlive it.
class AngularSystem {
public:
    AngularSystem(const AngularGrid& grid, const AngularMedium& medium, const AngularEntry& entry);

    /// The shares; derivatives are left at zero unless asked for.
    [[nodiscard]] AngularShares shares(bool with_derivatives) const;

    /// The light of one kind at cosines where the polynomials of its layer are `polynomials`.
    [[nodiscard]] ArrivingLight arriving(const RayKind& kind, const Eigen::ArrayXd& cosine,
                                         const Tabulated& polynomials) const;

private:
    /// p = matrix p + payoff for the prospects p of a space, per exit.
    struct Assembled {
        Eigen::MatrixXd matrix;
        Eigen::MatrixXd payoff;
    };
    /// The chance of each exit for rays that start a run at given cosines: one row per cosine.
    struct Prospects {
        Eigen::MatrixXd value;
        Eigen::MatrixXd by_cosine;
        Eigen::MatrixXd by_rayleigh_depth;
    };
    [[nodiscard]] Prospects prospects(const RayKind& kind, const Eigen::ArrayXd& cosine,
                                      const Tabulated& polynomials) const;
    [[nodiscard]] Prospects prospects_beyond(std::size_t space, const AngularSide& side) const;
    [[nodiscard]] Assembled assemble(std::size_t space) const;
    void add_senders(std::size_t space, const AngularSide& side, Eigen::Index first, const Eigen::MatrixXd& senders,
                     Assembled& system) const;
    [[nodiscard]] Assembled entering() const;
    [[nodiscard]] ArrivingLight entering_light() const;
    [[nodiscard]] Eigen::VectorXd bouncing(std::size_t space) const;
    void add_light(std::size_t space, std::size_t index, const AngularSide& side, const ArrivingLight& light,
                   bool with_derivatives, AngularShares& shares) const;
    void add_derivatives(std::size_t space, std::size_t index, const AngularSide& side, const ArrivingLight& light,
                         AngularShares& shares) const;

    const AngularGrid* grid_;
    const AngularMedium* medium_;
    const AngularEntry* entry_;
    PerExit by_entry_cosine_;
    std::vector<Eigen::VectorXd> visits_;    // per space: how often each kind of start is expected
    std::vector<Eigen::MatrixXd> prospect_;  // per space: the chance of each exit after each kind of start
};

}  // namespace skinfit
