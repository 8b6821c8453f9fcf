#include "model/angular_basis.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "model/constants.hpp"

namespace skinfit {
namespace {

/// Legendre polynomials of degree 0 to `degree` at `x`, by Bonnet's recurrence.
Tabulated legendre(const Eigen::ArrayXd& x, int degree) {
    Tabulated p{.value = Eigen::MatrixXd::Ones(x.size(), degree + 1),
                .derivative = Eigen::MatrixXd::Zero(x.size(), degree + 1)};
    for (int n = 1; n <= degree; ++n) {
        const auto last = p.value.col(n - 1).array();
        if (n == 1) {
            p.value.col(1) = x;
            p.derivative.col(1).setOnes();
            continue;
        }
        p.value.col(n) = ((2.0 * n - 1.0) * x * last - (n - 1.0) * p.value.col(n - 2).array()) / n;
        p.derivative.col(n) = (2.0 * n - 1.0) * last + p.derivative.col(n - 2).array();
    }
    return p;
}

}  // namespace

Quadrature gauss_legendre(int points) {
    assert(points > 0);
    Quadrature rule{.node = Eigen::ArrayXd(points), .weight = Eigen::ArrayXd(points)};
    Eigen::ArrayXd x(1);
    for (int i = 0; i < points; ++i) {
        x(0) = -std::cos(pi * (i + 0.75) / (points + 0.5));
        constexpr int newton_steps = 6;  // from a start that is good to 1/points^2
        double slope = 0.0;
        for (int step = 0; step <= newton_steps; ++step) {
            const Tabulated p = legendre(x, points);
            slope = p.derivative(0, points);
            if (step < newton_steps) x(0) -= p.value(0, points) / slope;
        }
        rule.node(i) = 0.5 * (1.0 + x(0));
        rule.weight(i) = 1.0 / ((1.0 - x(0) * x(0)) * slope * slope);
    }
    return rule;
}

Tabulated PanelBasis::on_panel(Eigen::Index panel, const Eigen::ArrayXd& cosine) const {
    const double low = edges[static_cast<std::size_t>(panel)];
    const double width = edges[static_cast<std::size_t>(panel) + 1] - low;
    Tabulated p = legendre(2.0 / width * (cosine - low) - 1.0, order - 1);
    for (int n = 0; n < order; ++n) {
        const double norm = std::sqrt((2.0 * n + 1.0) / width);
        p.value.col(n) *= norm;
        p.derivative.col(n) *= 2.0 / width * norm;
    }
    return p;
}

std::vector<PanelRun> PanelBasis::runs(const Eigen::ArrayXd& cosine) const {
    std::vector<PanelRun> runs;
    for (Eigen::Index i = 0; i < cosine.size(); ++i) {
        const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, cosine(i));
        const Eigen::Index panel = above - edges.begin() - 1;
        if (runs.empty() || runs.back().panel != panel) runs.push_back({.panel = panel, .first = i, .count = 0});
        ++runs.back().count;
    }
    return runs;
}

Tabulated PanelBasis::at(const Eigen::ArrayXd& cosine) const {
    Tabulated all{.value = Eigen::MatrixXd::Zero(cosine.size(), size()),
                  .derivative = Eigen::MatrixXd::Zero(cosine.size(), size())};
    for (const PanelRun& run : runs(cosine)) {
        const Tabulated p = on_panel(run.panel, cosine.segment(run.first, run.count));
        all.value.block(run.first, run.panel * order, run.count, order) = p.value;
        all.derivative.block(run.first, run.panel * order, run.count, order) = p.derivative;
    }
    return all;
}

SparselyTabulated PanelBasis::sparsely_at(const Eigen::ArrayXd& cosine) const {
    SparselyTabulated all{.value{cosine.size(), size()}, .derivative{cosine.size(), size()}};
    all.value.reserve(Eigen::VectorXi::Constant(cosine.size(), order));
    all.derivative.reserve(Eigen::VectorXi::Constant(cosine.size(), order));
    for (const PanelRun& run : runs(cosine)) {
        const Tabulated p = on_panel(run.panel, cosine.segment(run.first, run.count));
        for (Eigen::Index i = 0; i < run.count; ++i) {
            for (Eigen::Index n = 0; n < order; ++n) {
                all.value.insert(run.first + i, run.panel * order + n) = p.value(i, n);
                all.derivative.insert(run.first + i, run.panel * order + n) = p.derivative(i, n);
            }
        }
    }
    return all;
}

Eigen::ArrayXd PanelBasis::norms() const {
    Eigen::ArrayXd norms(size());
    for (Eigen::Index i = 0; i < size(); ++i) {
        const auto panel = static_cast<std::size_t>(i / order);
        norms(i) = std::sqrt((2.0 * static_cast<double>(i % order) + 1.0) / (edges[panel + 1] - edges[panel]));
    }
    return norms;
}

Eigen::VectorXd PanelBasis::one() const {
    Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(size());
    for (Eigen::Index i = 0; i < panels(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        coefficients(i * order) = std::sqrt(edges[k + 1] - edges[k]);
    }
    return coefficients;
}

Tabulated even_legendre(const Eigen::ArrayXd& cosine, int count) {
    const Tabulated p = legendre(cosine, 2 * count - 2);
    Tabulated even{.value = Eigen::MatrixXd(cosine.size(), count), .derivative = Eigen::MatrixXd(cosine.size(), count)};
    for (Eigen::Index n = 0; n < count; ++n) {
        even.value.col(n) = p.value.col(2 * n);
        even.derivative.col(n) = p.derivative.col(2 * n);
    }
    return even;
}

}  // namespace skinfit
