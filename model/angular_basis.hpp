#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

/// Quadrature and polynomials on the range of the cosine, 0 to 1, for the angular solver.
namespace skinfit {

/// Nodes and weights on [0, 1].
struct Quadrature {
    Eigen::ArrayXd node;
    Eigen::ArrayXd weight;
};

/// Gauss's rule on [0, 1], exact for polynomials of degree 2 `points` - 1.
[[nodiscard]] Quadrature gauss_legendre(int points);

/// `factor` as a diagonal matrix, for use within one expression.
[[nodiscard]] inline auto scaled(const Eigen::ArrayXd& factor) {
    return factor.matrix().asDiagonal();
}

/// Functions of the cosine and their derivatives: one row per cosine, one column per function.
struct Tabulated {
    Eigen::MatrixXd value;
    Eigen::MatrixXd derivative;
};

/// The same, of which most are zero.
struct SparselyTabulated {
    Eigen::SparseMatrix<double, Eigen::RowMajor> value;
    Eigen::SparseMatrix<double, Eigen::RowMajor> derivative;
};

/// Neighbouring cosines of a list that lie in one panel.
struct PanelRun {
    Eigen::Index panel;
    Eigen::Index first;
    Eigen::Index count;
};

/// Polynomials of degree below `order` on each panel between neighbouring `edges`, 0 outside it, orthonormal on [0, 1].
/// Panel after panel, by ascending degree.
struct PanelBasis {
    std::vector<double> edges;  ///< ascending, from 0 to 1
    int order;

    [[nodiscard]] Eigen::Index panels() const { return static_cast<Eigen::Index>(edges.size()) - 1; }
    [[nodiscard]] Eigen::Index size() const { return panels() * order; }
    /// All functions at `cosine`.
    [[nodiscard]] Tabulated at(const Eigen::ArrayXd& cosine) const;
    [[nodiscard]] SparselyTabulated sparsely_at(const Eigen::ArrayXd& cosine) const;
    /// `cosine` cut where one and the next lie in different panels.
    [[nodiscard]] std::vector<PanelRun> runs(const Eigen::ArrayXd& cosine) const;
    /// The functions of one panel at cosines inside it.
    [[nodiscard]] Tabulated on_panel(Eigen::Index panel, const Eigen::ArrayXd& cosine) const;
    /// What makes Legendre's polynomials orthonormal on their panels.
    [[nodiscard]] Eigen::ArrayXd norms() const;
    /// The coefficients of the function that is 1 everywhere.
    [[nodiscard]] Eigen::VectorXd one() const;
};

/// The first `count` Legendre polynomials of even degree: P_0, P_2, P_4 ...
[[nodiscard]] Tabulated even_legendre(const Eigen::ArrayXd& cosine, int count);

}  // namespace skinfit
