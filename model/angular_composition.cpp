#include "model/angular_composition.hpp"

#include <Eigen/LU>
#include <cassert>
#include <map>
#include <utility>
#include <vector>

namespace skinfit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int stratum_corneum = static_cast<int>(Layer::stratum_corneum);
constexpr int epidermis = static_cast<int>(Layer::epidermis);
constexpr int papillary = static_cast<int>(Layer::papillary_dermis);
constexpr int reticular = static_cast<int>(Layer::reticular_dermis);
constexpr Index exits = 2;

/// The starts x that satisfy x = own x + right, for each column of `right`.
MatrixXd solved(const MatrixXd& own, const MatrixXd& right) {
    return (MatrixXd::Identity(own.rows(), own.cols()) - own).partialPivLu().solve(right);
}

MatrixXd side_by_side(const MatrixXd& left, const MatrixXd& right) {
    MatrixXd both(left.rows(), left.cols() + right.cols());
    both << left, right;
    return both;
}

}  // namespace

AngularComposition::AngularComposition(std::shared_ptr<const AngularGrid> grid, AngularMedium medium,
                                       Eigen::RowVectorXd first_scattered, double entering_share)
    : grid_(std::move(grid)),
      medium_(std::move(medium)),
      first_scattered_(std::move(first_scattered)),
      entering_share_(entering_share) {}

/// How many unknowns belong to the runs of one layer and direction, over all spaces.
Index AngularComposition::count(int layer, Heading heading) const {
    if (layer < 0 || 2 * static_cast<std::size_t>(layer) >= grid_->sides.size()) return 0;
    Index size = 0;
    for (const StateSpace& space : grid_->spaces) size += space.block(layer, heading).size;
    return size;
}

/// Where the unknowns of one block begin among those of their layer and direction.
Index AngularComposition::column(int layer, Heading heading, std::size_t space) const {
    Index first = 0;
    for (std::size_t s = 0; s < space; ++s) first += grid_->spaces[s].block(layer, heading).size;
    return first;
}

/// As `AngularSystem::add_senders`, but for the spaces, which are solved together.
void AngularComposition::add_senders(std::size_t space, const AngularSide& side, Index row, const MatrixXd& senders,
                                     Layered& rows) const {
    const InterfaceNodes& nodes = side.nodes;
    const RayKind back = {grid_->space_after_reflection(space, side), side.layer, opposite(side.heading)};
    const MatrixXd back_starts = run_starts(*grid_, medium_, back, nodes.cosine, side.own);
    const Index up_first = back.heading == Heading::up ? count(side.layer, Heading::down) : 0;
    rows.own.block(row, up_first + column(back.layer, back.heading, back.space), senders.cols(), back_starts.cols()) +=
        senders.transpose() * scaled(nodes.reflectance) * back_starts;
    if (nodes.transmitting == 0) return;
    const MatrixXd transmitted =
        senders.bottomRows(nodes.transmitting).transpose() * scaled(1.0 - nodes.reflectance.tail(nodes.transmitting));
    if (side.exit) {
        rows.payoff.col(side.heading == Heading::up ? 0 : 1).segment(row, senders.cols()) +=
            transmitted.rowwise().sum();
        return;
    }
    const MatrixXd onward =
        transmitted * run_starts(*grid_, medium_, {space, side.next, side.heading}, nodes.refracted, side.beyond);
    MatrixXd& target = side.heading == Heading::up ? rows.above : rows.beneath;
    target.block(row, column(side.next, side.heading, space), onward.rows(), onward.cols()) += onward;
}

AngularComposition::Layered AngularComposition::no_rows(int layer, Index rows) const {
    return {.above = MatrixXd::Zero(rows, count(layer - 1, Heading::up)),
            .own = MatrixXd::Zero(rows, count(layer, Heading::down) + count(layer, Heading::up)),
            .beneath = MatrixXd::Zero(rows, count(layer + 1, Heading::down)),
            .payoff = Eigen::MatrixX2d::Zero(rows, exits)};
}

/// The rows of `layer` before the scattering of stratum corneum and epidermis acts on them.
AngularComposition::Layered AngularComposition::unscattered(int layer, double optical_depth) const {
    const Index down = count(layer, Heading::down);
    Layered rows = no_rows(layer, down + count(layer, Heading::up));
    const auto first_row = [&](Heading heading, std::size_t space) {
        return (heading == Heading::up ? down : 0) + column(layer, heading, space);
    };
    for (const Heading heading : {Heading::down, Heading::up}) {
        const AngularSide& side = grid_->sides[2 * static_cast<std::size_t>(layer) + static_cast<std::size_t>(heading)];
        assert(side.layer == layer && side.heading == heading);
        const Eigen::ArrayXd& weight = side.nodes.weight;
        const Eigen::ArrayXd surviving = weight * (-optical_depth / side.nodes.cosine).exp();  // [KA04, Eq. 5]
        for (std::size_t s = 0; s < grid_->spaces.size(); ++s) {
            const Index own = first_row(heading, s);
            if (!in_dermis(layer)) {
                add_senders(s, side, own, scaled(surviving) * side.own.value, rows);
                continue;
            }
            add_senders(s, side, own, 2.0 * surviving * side.nodes.cosine, rows);  // [KA04, Eq. 4]
            const Index other = first_row(opposite(heading), s);
            const StateSpace& states = grid_->spaces[s];
            if (states.block(layer, heading).rayleigh) {
                add_senders(s, side, own + 1, scaled(surviving) * side.own.value, rows);
            }
            if (states.block(layer, opposite(heading)).rayleigh) {
                add_senders(s, side, other + 1, scaled(weight) * side.own.value, rows);
            }
        }
    }
    return rows;
}

AngularComposition::Layered AngularComposition::scattered(int layer, Layered rows) const {
    if (in_dermis(layer)) return rows;
    const MatrixXd& forward = medium_.forward[static_cast<std::size_t>(layer)];
    const auto scatter = [&](auto& block) {
        for (Index row = 0; row < block.rows(); row += forward.rows()) {
            block.middleRows(row, forward.rows()) = forward * block.middleRows(row, forward.rows());
        }
    };
    scatter(rows.above);
    scatter(rows.own);
    scatter(rows.beneath);
    scatter(rows.payoff);
    return rows;
}

AngularComposition::Layered AngularComposition::layer(Layer layer, double optical_depth) const {
    const int index = static_cast<int>(layer);
    return scattered(index, unscattered(index, optical_depth));
}

AngularComposition::Above AngularComposition::above_epidermis(double stratum_corneum_depth) const {
    const Layered rows = layer(Layer::stratum_corneum, stratum_corneum_depth);
    const MatrixXd starts = solved(rows.own, side_by_side(rows.beneath, rows.payoff));
    Layered first = no_rows(stratum_corneum, 1);
    const EntryGrid& entry = grid_->entry;
    const Eigen::ArrayXd surviving =
        entry.side.nodes.weight * (-stratum_corneum_depth / entry.side.nodes.cosine).exp();  // [KA04, Eq. 5]
    add_senders(0, entry.side, 0,
                surviving.matrix().cwiseProduct(entry.polynomials.value * first_scattered_.transpose()), first);
    return {.up = starts.bottomRows(count(stratum_corneum, Heading::up)),
            .entering = side_by_side(first.beneath, first.payoff) + first.own * starts};
}

AngularComposition::Above AngularComposition::above_dermis(const Above& above, double epidermis_depth) const {
    Layered rows = layer(Layer::epidermis, epidermis_depth);
    const Index down = count(epidermis, Heading::down);
    const MatrixXd through = rows.above * above.up;
    rows.own.leftCols(down) += through.leftCols(down);
    rows.payoff += through.rightCols(exits);
    const MatrixXd starts = solved(rows.own, side_by_side(rows.beneath, rows.payoff));
    Eigen::RowVectorXd entering = above.entering.head(down) * starts.topRows(down);
    entering.tail(exits) += above.entering.tail(exits);
    return {.up = starts.bottomRows(count(epidermis, Heading::up)), .entering = entering};
}

AngularComposition::Chances AngularComposition::below_papillary(double reticular_depth) const {
    const Layered rows = layer(Layer::reticular_dermis, reticular_depth);
    return solved(rows.own, side_by_side(rows.above, rows.payoff)).topRows(count(reticular, Heading::down));
}

AngularComposition::Dermis AngularComposition::dermis(const Layered& papillary_rows, const Chances& below) const {
    const Index up = count(papillary, Heading::up);
    const MatrixXd through = papillary_rows.beneath * below;
    Dermis result{
        .matrix = MatrixXd::Identity(papillary_rows.own.rows(), papillary_rows.own.cols()) - papillary_rows.own,
        .payoff = papillary_rows.payoff + through.rightCols(exits)};
    result.matrix.rightCols(up) -= through.leftCols(up);
    return result;
}

PerExit AngularComposition::combined(const Above& above, const Chances& papillary_above, const Dermis& dermis) const {
    const Index down = count(papillary, Heading::down);
    MatrixXd matrix = dermis.matrix;
    matrix.leftCols(down) -= papillary_above.leftCols(down);
    const Eigen::MatrixX2d payoff = dermis.payoff + papillary_above.rightCols(exits);
    const Eigen::MatrixX2d starts = matrix.partialPivLu().solve(payoff);
    return above.entering.head(down) * starts.topRows(down) + above.entering.tail(exits);
}

bool AngularComposition::has_dermis() const {
    return count(papillary, Heading::down) > 0;
}

ShareTable AngularComposition::shares(std::span<const UpperDepths> upper, std::span<const LowerDepths> lower,
                                      Heading exit) const {
    const Index column = exit == Heading::up ? 0 : 1;
    ShareTable table(static_cast<Index>(upper.size()), static_cast<Index>(lower.size()));
    std::map<double, Above> stratum_corneums;
    std::map<double, Layered> papillaries;
    std::map<double, Chances> reticulars;
    std::vector<Dermis> dermises;
    for (const LowerDepths& depths : lower) {
        if (!has_dermis()) break;
        if (!papillaries.contains(depths.papillary)) {
            papillaries.emplace(depths.papillary, layer(Layer::papillary_dermis, depths.papillary));
        }
        if (!reticulars.contains(depths.reticular)) {
            reticulars.emplace(depths.reticular, below_papillary(depths.reticular));
        }
        dermises.push_back(dermis(papillaries.at(depths.papillary), reticulars.at(depths.reticular)));
    }
    for (std::size_t i = 0; i < upper.size(); ++i) {
        const auto row = static_cast<Index>(i);
        if (!stratum_corneums.contains(upper[i].stratum_corneum)) {
            stratum_corneums.emplace(upper[i].stratum_corneum, above_epidermis(upper[i].stratum_corneum));
        }
        const Above above = above_dermis(stratum_corneums.at(upper[i].stratum_corneum), upper[i].epidermis);
        if (!has_dermis()) {
            table.row(row).setConstant(entering_share_ * above.entering(above.entering.size() - exits + column));
            continue;
        }
        std::map<double, Chances> papillary_aboves;
        for (const auto& [depth, papillary_rows] : papillaries) {
            papillary_aboves.emplace(depth, papillary_rows.above * above.up);
        }
        for (std::size_t j = 0; j < lower.size(); ++j) {
            table(row, static_cast<Index>(j)) =
                entering_share_ * combined(above, papillary_aboves.at(lower[j].papillary), dermises[j])(column);
        }
    }
    return table;
}

}  // namespace skinfit
