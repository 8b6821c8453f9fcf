#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/angular_basis.hpp"
#include "model/scattering.hpp"
#include "model/skin.hpp"

namespace skinfit {

/// Where a ray goes that is deflected once in stratum corneum or epidermis, as means of the polynomials of a panel
/// basis. The means do not depend on the wavelength: they are kept per segment of polar angle, a quarter of a row of
/// the measured table, in which the density of the polar angle is taken as constant with its exact share. At a measured
/// wavelength that is no approximation; between them the blended law has further knots.
class ForwardDeflection {
public:
    explicit ForwardDeflection(PanelBasis basis);

    /// The mean of each polynomial over the deflections of a ray of cosine `cosine` within one segment of the table,
    /// 0 beyond the horizon: one row per segment.
    [[nodiscard]] Eigen::MatrixXd segment_means(double cosine) const;
    /// The share of the light that is scattered within each segment.
    [[nodiscard]] Eigen::RowVectorXd segment_shares(const ForwardScattering& scattering) const;
    [[nodiscard]] const PanelBasis& basis() const { return basis_; }

private:
    PanelBasis basis_;
    std::vector<double> angle_;  // rad, the ends of the segments
};

/// Scattering in stratum corneum and epidermis on the polynomials of a panel basis:
///
///     forward(m, n) = integral over 0..1 of  p_m(x) / P(x)  integral over 0..1 of  K(x, y) p_n(y)  dy dx
///
/// K(x, y) is the density of the cosine y after a deflection whose polar angle follows the measured table and whose
/// azimuth is uniform, P(x) = integral of K(x, y) dy the chance that the direction has not turned back: turned-back
/// directions are drawn again.
class ForwardKernel {
public:
    /// The kernel on `basis`; computed at the first call for that basis, then kept. Safe from any thread.
    [[nodiscard]] static std::shared_ptr<const ForwardKernel> of(const PanelBasis& basis);

    /// The matrix at one wavelength. It keeps the coefficients of 1, to rounding: no ray is lost.
    [[nodiscard]] Eigen::MatrixXd matrix(const ForwardScattering& scattering) const;

private:
    explicit ForwardKernel(const PanelBasis& basis);

    ForwardDeflection deflection_;
    Eigen::VectorXd one_;                   // coefficients of 1
    std::vector<Eigen::MatrixXd> segment_;  // per segment: one row of its means per node
    Eigen::MatrixXd projection_;            // from nodes to polynomials
};

/// Rayleigh scattering between cosines x and y, -1 to 1, averaged over azimuth, as the coefficients c_j of
///
///     K(x, y) = sum over j of  c_j P_2j(x) P_2j(y)
///
/// `revised` has two, `printed` infinitely many, of which the first `most` are returned.
[[nodiscard]] Eigen::ArrayXd rayleigh_coefficients(Edition edition, int most);

}  // namespace skinfit
