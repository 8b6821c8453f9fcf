#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/angular_basis.hpp"
#include "model/scattering.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// Scattering in stratum corneum and epidermis on the polynomials of a panel basis:
///
///     forward(m, n) = integral over 0..1 of  p_m(x) / P(x)  integral over 0..1 of  K(x, y) p_n(y)  dy dx
///
/// K(x, y) is the density of the cosine y after a deflection whose polar angle follows the measured table and whose
/// azimuth is uniform, P(x) = integral of K(x, y) dy the chance that the direction has not turned back: turned-back
/// directions are drawn again. The integrals over K do not depend on the wavelength: they are kept per segment of polar
/// angle, a quarter of a row of the table, in which the density of the polar angle is taken as constant with its exact
/// share. At a measured wavelength that is no approximation; between them the blended law has further knots.
class ForwardKernel {
public:
    /// The kernel on `basis`; computed at the first call for that basis, then kept. Safe from any thread.
    [[nodiscard]] static std::shared_ptr<const ForwardKernel> of(const PanelBasis& basis);

    /// The mean of each polynomial over the deflections of a ray of cosine `cosine` within one segment of the table,
    /// 0 beyond the horizon: one row per segment.
    [[nodiscard]] Eigen::MatrixXd segment_means(double cosine) const;

    /// The mean of each polynomial over all deflections, from `segment_means`; not yet divided by P(x).
    [[nodiscard]] Eigen::RowVectorXd mean(const ForwardScattering& scattering, const Eigen::MatrixXd& means) const;

    /// The matrix at one wavelength. It keeps the coefficients of 1, to rounding: no ray is lost.
    [[nodiscard]] Eigen::MatrixXd matrix(const ForwardScattering& scattering) const;

private:
    explicit ForwardKernel(const PanelBasis& basis);
    [[nodiscard]] Eigen::RowVectorXd segment_shares(const ForwardScattering& scattering) const;

    static constexpr int pieces_per_row = 4;

    PanelBasis basis_;
    Eigen::VectorXd one_;                   // coefficients of 1
    std::vector<double> angle_;             // rad, the ends of the segments
    std::vector<Eigen::MatrixXd> segment_;  // per segment: one row of `segment_means` per node
    Eigen::MatrixXd projection_;            // from nodes to polynomials
};

/// Rayleigh scattering between cosines x and y, -1 to 1, averaged over azimuth, as the coefficients c_j of
///
///     K(x, y) = sum over j of  c_j P_2j(x) P_2j(y)
///
/// `revised` has two, `printed` infinitely many, of which the first `most` are returned.
[[nodiscard]] Eigen::ArrayXd rayleigh_coefficients(Edition edition, int most);

}  // namespace skinfit
