#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "model/angular_grid.hpp"
#include "model/angular_system.hpp"

namespace skinfit {

/// Optical depths of stratum corneum and epidermis.
struct UpperDepths {
    double stratum_corneum;
    double epidermis;
};

/// Optical depths of the two layers of the dermis; without meaning where the sample has none.
struct LowerDepths {
    double papillary;
    double reticular;
};

/// One row per upper, one column per lower depths.
using ShareTable = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The angular system of one wavelength, solved for many optical depths at little cost each. A row of the system
/// depends on the optical depth of its own layer alone and reaches no further than the neighbouring layers, so the
/// layers are eliminated one by one, each once per optical depth, and any combination of them is put together by a
/// small system. The shares are those of `AngularSystem`, to rounding. docs/model.md, section "Emulator".
class AngularComposition {
public:
    /// `medium`: its optical depths are not used. `first_scattered`: the light after its first scattering.
    AngularComposition(std::shared_ptr<const AngularGrid> grid, AngularMedium medium,
                       Eigen::RowVectorXd first_scattered, double entering_share);

    /// The share of the incident light that leaves in the direction `exit`, after having entered, for every pair of
    /// upper and lower depths.
    [[nodiscard]] ShareTable shares(std::span<const UpperDepths> upper, std::span<const LowerDepths> lower,
                                    Heading exit) const;

private:
    /// The coefficients of the unknowns of one layer. Columns: upward starts of the layer above, own starts (downward
    /// ones first), downward starts of the layer beneath; the exits.
    struct Layered {
        Eigen::MatrixXd above;
        Eigen::MatrixXd own;
        Eigen::MatrixXd beneath;
        Eigen::MatrixX2d payoff;
    };
    /// Chances in terms of the starts of runs in a neighbouring layer, one column each, and of the exits, the last two
    /// columns.
    using Chances = Eigen::MatrixXd;
    /// What is needed of all that lies above some layer, in terms of its downward starts.
    struct Above {
        Chances up;                   // of upward starts in the layer above
        Eigen::RowVectorXd entering;  // of the light that enters the topmost layer
    };
    /// The starts in the papillary dermis x, matrix x = payoff, with the reticular dermis eliminated.
    struct Dermis {
        Eigen::MatrixXd matrix;
        Eigen::MatrixX2d payoff;
    };

    [[nodiscard]] bool has_dermis() const;
    [[nodiscard]] Eigen::Index column(int layer, Heading heading, std::size_t space) const;
    [[nodiscard]] Eigen::Index count(int layer, Heading heading) const;
    void add_senders(std::size_t space, const AngularSide& side, Eigen::Index row, const Eigen::MatrixXd& senders,
                     Layered& rows) const;
    [[nodiscard]] Layered no_rows(int layer, Eigen::Index rows) const;
    [[nodiscard]] Layered unscattered(int layer, double optical_depth) const;
    [[nodiscard]] Layered scattered(int layer, Layered rows) const;
    [[nodiscard]] Layered layer(Layer layer, double optical_depth) const;
    [[nodiscard]] Above above_epidermis(double stratum_corneum_depth) const;
    [[nodiscard]] Above above_dermis(const Above& above, double epidermis_depth) const;
    [[nodiscard]] Chances below_papillary(double reticular_depth) const;
    [[nodiscard]] Dermis dermis(const Layered& papillary, const Chances& below) const;
    [[nodiscard]] PerExit combined(const Above& above, const Chances& papillary_above, const Dermis& dermis) const;

    std::shared_ptr<const AngularGrid> grid_;
    AngularMedium medium_;
    Eigen::RowVectorXd first_scattered_;
    double entering_share_;
};

}  // namespace skinfit
