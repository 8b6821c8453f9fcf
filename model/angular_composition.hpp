#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <memory>

#include "model/angular_grid.hpp"
#include "model/angular_system.hpp"

namespace skinfit {

/// The angular system of one wavelength, solved for many optical depths at little cost each. A row of the system depends
/// on the optical depth of its own layer alone and reaches no further than the neighbouring layers, so the layers are
/// eliminated one by one, each once per optical depth, and any combination of them is put together by a small system.
/// The shares are those of `AngularSystem`, to rounding. docs/model.md, section "Emulator".
class AngularComposition {
public:
    /// The coefficients of the unknowns of one layer; columns: upward starts of the layer above, own starts (downward
    /// ones first), downward starts of the layer beneath.
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
        Chances up;                 ///< of upward starts in the layer above
        Eigen::RowVectorXd entering;  ///< of the light that enters the topmost layer
    };
    /// Papillary with reticular dermis.
    struct Dermis {
        Eigen::MatrixXd matrix;  ///< identity minus the coefficients of the papillary dermis' own starts
        Eigen::MatrixX2d payoff;
    };

    AngularComposition(std::shared_ptr<const AngularGrid> grid, AngularMedium medium, Eigen::RowVectorXd first_scattered,
                       double entering_share);

    /// The rows of `layer` at its optical depth.
    [[nodiscard]] Layered layer(Layer layer, double optical_depth) const;

    [[nodiscard]] Above above_epidermis(double stratum_corneum_depth) const;
    [[nodiscard]] Above above_dermis(const Above& epidermis, double epidermis_depth) const;
    /// Downward starts of the reticular dermis in terms of upward starts of the papillary dermis.
    [[nodiscard]] Chances below_papillary(double reticular_depth) const;
    [[nodiscard]] Dermis dermis(const Layered& papillary, const Chances& reticular) const;

    /// The shares of the incident light that leave through the exits, given the papillary dermis' `above` times
    /// `Above::up`.
    [[nodiscard]] PerExit shares(const Above& above, const Chances& papillary_above, const Dermis& dermis) const;
    /// The same for two layers.
    [[nodiscard]] PerExit shares(const Above& above) const;

private:
    [[nodiscard]] Eigen::Index column(int layer, Heading heading, std::size_t space) const;
    [[nodiscard]] Eigen::Index count(int layer, Heading heading) const;
    void add_senders(std::size_t space, const AngularSide& side, Eigen::Index row, const Eigen::MatrixXd& senders,
                     Layered& rows) const;
    [[nodiscard]] Layered unscattered(int layer, double optical_depth) const;
    [[nodiscard]] Layered scattered(int layer, Layered rows) const;

    std::shared_ptr<const AngularGrid> grid_;
    AngularMedium medium_;
    Eigen::RowVectorXd first_scattered_;
    double entering_share_;
};

}  // namespace skinfit
