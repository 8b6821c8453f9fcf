#include "model/angular_kernels.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>

#include "model/angular_basis.hpp"
#include "model/constants.hpp"
#include "model/table.hpp"

namespace skinfit {
namespace {

/// Adds `factor` times Legendre's polynomials of degree below `count`, 4 at most, at `x` to `sums`.
void add_legendre(double x, double factor, int count, double* sums) {
    constexpr std::array<double, 3> of_last = {1.0, 3.0 / 2.0, 5.0 / 3.0};  // Bonnet
    constexpr std::array<double, 3> of_before = {0.0, 1.0 / 2.0, 2.0 / 3.0};
    assert(count <= 4);
    sums[0] += factor;
    double before = 0.0;
    double last = factor;
    for (int n = 1; n < count; ++n) {
        const auto i = static_cast<std::size_t>(n) - 1;
        const double next = of_last[i] * x * last - of_before[i] * before;
        sums[n] += next;
        before = last;
        last = next;
    }
}

/// Adds to `sum`, for each function of the basis without its norm, `weight` times the mean over all azimuths at the
/// cosine of a ray of cosine `x` deflected by `angle`; the functions are 0 in the other hemisphere.
void add_azimuth_mean(double x, double angle, double weight, const PanelBasis& basis, Eigen::RowVectorXd& sum) {
    // Cubic polynomials in the cosine of the azimuth, so of degree 6 and little more in the azimuth where that is
    // short: 4 nodes are exact to degree 7.
    static const Quadrature fine = gauss_legendre(14);
    static const Quadrature middle = gauss_legendre(6);
    static const Quadrature coarse = gauss_legendre(4);
    const double along = x * std::cos(angle);
    const double across = std::sqrt(std::max(0.0, 1.0 - x * x)) * std::sin(angle);
    const auto azimuth = [&](double cosine) { return std::acos(std::clamp((cosine - along) / across, -1.0, 1.0)); };
    const auto above = std::upper_bound(basis.edges.begin() + 1, basis.edges.end() - 1, along - across);
    Eigen::Index panel = above - basis.edges.begin() - 1;
    for (double last = azimuth(basis.edges[static_cast<std::size_t>(panel)]); panel < basis.panels(); ++panel) {
        const double first = azimuth(basis.edges[static_cast<std::size_t>(panel) + 1]);
        const double width = last - first;
        if (width <= 0.0) break;
        const Quadrature& rule = width > 1.0 ? fine : width > 0.3 ? middle : coarse;
        const double low = basis.edges[static_cast<std::size_t>(panel)];
        const double scale = 2.0 / (basis.edges[static_cast<std::size_t>(panel) + 1] - low);
        double* const sums = &sum(panel * basis.order);
        for (Eigen::Index q = 0; q < rule.node.size(); ++q) {
            const double cosine = along + across * std::cos(first + width * rule.node(q));
            add_legendre(scale * (cosine - low) - 1.0, weight * width / pi * rule.weight(q), basis.order, sums);
        }
        last = first;
    }
}

/// The mean of each function of the basis, without its norm, over all azimuths and the polar angles from `first` to
/// `last`.
Eigen::RowVectorXd deflection_mean(double x, double first, double last, const PanelBasis& basis) {
    static const Quadrature rule = gauss_legendre(6);
    // Where the cone of deflected rays touches a panel's edge, the azimuths in the panel change with a square root.
    std::vector<double> ends = {first, last};
    const double polar = std::acos(std::min(x, 1.0));
    for (const double edge : basis.edges) {
        const double edge_polar = std::acos(edge);
        for (const double touch : {std::abs(polar - edge_polar), polar + edge_polar}) {
            if (touch > first && touch < last) ends.push_back(touch);
        }
    }
    std::ranges::sort(ends);
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(basis.size());
    double from = first;
    for (const double end : ends) {
        const double width = end - from;
        if (width < 1e-12) continue;  // ends that differ by rounding
        for (Eigen::Index q = 0; q < rule.node.size(); ++q) {
            const double t = rule.node(q);
            const double angle = from + width * t * t * (3.0 - 2.0 * t);  // quadratic at both ends
            add_azimuth_mean(x, angle, width * 6.0 * t * (1.0 - t) * rule.weight(q), basis, sum);
        }
        from = end;
    }
    return sum / (last - first);
}

}  // namespace

std::shared_ptr<const ForwardKernel> ForwardKernel::of(const PanelBasis& basis) {
    static std::mutex mutex;
    static std::map<std::pair<std::vector<double>, int>, std::shared_ptr<const ForwardKernel>> kernels;
    const std::lock_guard lock(mutex);
    std::shared_ptr<const ForwardKernel>& kernel = kernels[{basis.edges, basis.order}];
    if (!kernel) kernel.reset(new ForwardKernel(basis));
    return kernel;
}

ForwardDeflection::ForwardDeflection(PanelBasis basis) : basis_(std::move(basis)), angle_{0.0} {
    constexpr int pieces_per_row = 4;
    const std::vector<double>& table_deg = embedded_table("forward_scattering").column("polar_angle_deg");
    for (std::size_t row = 1; row < table_deg.size(); ++row) {
        for (int piece = 1; piece <= pieces_per_row; ++piece) {
            const double share = static_cast<double>(piece) / pieces_per_row;
            angle_.push_back(std::lerp(table_deg[row - 1], table_deg[row], share) * rad_per_deg);
        }
    }
}

ForwardKernel::ForwardKernel(const PanelBasis& basis) : deflection_(basis), one_(basis.one()) {
    const Quadrature rule = gauss_legendre(basis.order + 2);
    const Eigen::Index points = rule.node.size();
    const Eigen::Index nodes = points * basis.panels();
    projection_ = Eigen::MatrixXd::Zero(basis.size(), nodes);
    for (Eigen::Index panel = 0; panel < basis.panels(); ++panel) {
        const double low = basis.edges[static_cast<std::size_t>(panel)];
        const double width = basis.edges[static_cast<std::size_t>(panel) + 1] - low;
        const Eigen::ArrayXd cosine = low + width * rule.node;
        projection_.block(panel * basis.order, panel * points, basis.order, points) =
            basis.on_panel(panel, cosine).value.transpose() * (width * rule.weight).matrix().asDiagonal();
        for (Eigen::Index q = 0; q < points; ++q) {
            const Eigen::MatrixXd means = deflection_.segment_means(cosine(q));
            segment_.resize(static_cast<std::size_t>(means.rows()), Eigen::MatrixXd(nodes, basis.size()));
            for (std::size_t i = 0; i < segment_.size(); ++i) {
                segment_[i].row(panel * points + q) = means.row(static_cast<Eigen::Index>(i));
            }
        }
    }
}

Eigen::MatrixXd ForwardDeflection::segment_means(double cosine) const {
    const auto segments = static_cast<Eigen::Index>(angle_.size()) - 1;
    Eigen::MatrixXd means(segments, basis_.size());
    for (Eigen::Index i = 0; i < segments; ++i) {
        const double first = angle_[static_cast<std::size_t>(i)];
        const double last = angle_[static_cast<std::size_t>(i) + 1];
        means.row(i) = deflection_mean(cosine, first, last, basis_);
    }
    return means * scaled(basis_.norms());
}

Eigen::RowVectorXd ForwardDeflection::segment_shares(const ForwardScattering& scattering) const {
    Eigen::RowVectorXd shares(static_cast<Eigen::Index>(angle_.size()) - 1);
    for (std::size_t i = 0; i + 1 < angle_.size(); ++i) {
        shares(static_cast<Eigen::Index>(i)) =
            scattering.share_within(angle_[i + 1]) - scattering.share_within(angle_[i]);
    }
    return shares;
}

Eigen::MatrixXd ForwardKernel::matrix(const ForwardScattering& scattering) const {
    const Eigen::RowVectorXd shares = deflection_.segment_shares(scattering);
    Eigen::MatrixXd kernel = Eigen::MatrixXd::Zero(projection_.cols(), projection_.rows());
    for (std::size_t i = 0; i < segment_.size(); ++i) kernel += shares(static_cast<Eigen::Index>(i)) * segment_[i];
    return projection_ * (kernel * one_).cwiseInverse().asDiagonal() * kernel;
}

Eigen::ArrayXd rayleigh_coefficients(Edition edition, int most) {
    // The addition theorem of the Legendre polynomials: c_j = (4j + 1) / 2 times the mean of P_2j(deflection cosine).
    if (edition == Edition::revised) return Eigen::ArrayXd{{0.5, 0.25}};
    // Polar angles uniform but for the weight 1 + cos^2: Gauss-Chebyshev, exact for these polynomials.
    const int points = 2 * most + 2;
    const Eigen::ArrayXd cosine = (pi / points * Eigen::ArrayXd::LinSpaced(points, 0.5, points - 0.5)).cos();
    const Eigen::ArrayXd weight = (1.0 + cosine.square()) / (1.5 * points);
    const Eigen::ArrayXd mean = even_legendre(cosine, most).value.transpose() * weight.matrix();
    return mean * (2.0 * Eigen::ArrayXd::LinSpaced(most, 0.0, most - 1.0) + 0.5);
}

}  // namespace skinfit
