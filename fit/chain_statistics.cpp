#include "fit/chain_statistics.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

namespace skinfit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Each chain cut into two, so that a trend within a chain shows as a difference between chains.
MatrixXd split_chains(const MatrixXd& draws) {
    const Index half = draws.rows() / 2;
    MatrixXd split(half, 2 * draws.cols());
    split << draws.topRows(half), draws.bottomRows(half);
    return split;
}

double normal_quantile(double share) {
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * share);
}

/// Each draw replaced by the normal quantile of its rank among all, ties by their mean rank.
MatrixXd rank_normalised(const MatrixXd& draws) {
    const auto size = static_cast<std::size_t>(draws.size());
    std::vector<std::size_t> order(size);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto value = [&draws](std::size_t i) { return draws.data()[i]; };
    std::ranges::sort(order, {}, value);
    MatrixXd normalised(draws.rows(), draws.cols());
    for (std::size_t begin = 0; begin < size;) {
        std::size_t end = begin + 1;
        while (end < size && value(order[end]) == value(order[begin])) ++end;
        const double rank = 0.5 * static_cast<double>(begin + 1 + end);
        const double normal = normal_quantile((rank - 0.375) / (static_cast<double>(size) + 0.25));
        for (std::size_t k = begin; k < end; ++k) normalised.data()[order[k]] = normal;
        begin = end;
    }
    return normalised;
}

/// The mean variance within chains, and the estimate of the whole variance that also sees differences between them.
struct Variances {
    double within;
    double whole;
};

Variances variances(const MatrixXd& chains) {
    const auto draws = static_cast<double>(chains.rows());
    const VectorXd means = chains.colwise().mean();
    const double squares = (chains.rowwise() - means.transpose()).squaredNorm();
    const double within = squares / (draws - 1.0) / static_cast<double>(chains.cols());
    const double between =
        (means.array() - means.mean()).square().sum() / static_cast<double>(std::max<Index>(means.size() - 1, 1));
    return {.within = within, .whole = within * (draws - 1.0) / draws + between};
}

double plain_r_hat(const MatrixXd& chains) {
    const Variances found = variances(chains);
    return found.within > 0.0 ? std::sqrt(found.whole / found.within) : 1.0;
}

/// The mean over chains of the product of deviations `lag` draws apart, per draw.
double autocovariance(const MatrixXd& centred, Index lag) {
    const Index pairs = centred.rows() - lag;
    return centred.topRows(pairs).cwiseProduct(centred.bottomRows(pairs)).sum() /
           static_cast<double>(centred.rows() * centred.cols());
}

/// From chains that are split already: Geyer's initial monotone sequence of paired autocorrelations.
double effective_size(const MatrixXd& chains) {
    const auto total = static_cast<double>(chains.size());
    const Variances found = variances(chains);
    if (!(found.whole > 0.0)) return total;  // constant
    const MatrixXd centred = chains.rowwise() - chains.colwise().mean();
    const auto draws = static_cast<double>(chains.rows());
    const auto correlation = [&](Index lag) {
        return 1.0 - (found.within - autocovariance(centred, lag) * draws / (draws - 1.0)) / found.whole;
    };
    double sum = 0.0;  // of paired correlations
    double last = std::numeric_limits<double>::infinity();
    for (Index lag = 0; lag + 1 < chains.rows(); lag += 2) {
        const double pair = (lag == 0 ? 1.0 : correlation(lag)) + correlation(lag + 1);
        if (!(pair > 0.0)) break;
        last = std::min(last, pair);
        sum += last;
    }
    const double time = std::max(2.0 * sum - 1.0, 1.0 / std::log10(total));  // the limit of antithetic chains
    return total / time;
}

/// 1 where a draw does not exceed the quantile, else 0.
double quantile_effective_size(const MatrixXd& draws, double share) {
    const double limit = quantile(draws, share);
    return effective_size(split_chains((draws.array() <= limit).cast<double>().matrix()));
}

}  // namespace

double quantile(const MatrixXd& draws, double share) {
    std::vector<double> sorted(draws.data(), draws.data() + draws.size());
    std::ranges::sort(sorted);
    const double rank = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], rank - static_cast<double>(below));
}

double r_hat(const MatrixXd& draws) {
    const MatrixXd split = split_chains(draws);
    const MatrixXd distances = (split.array() - quantile(split, 0.5)).abs().matrix();
    return std::max(plain_r_hat(rank_normalised(split)), plain_r_hat(rank_normalised(distances)));
}

double bulk_effective_size(const MatrixXd& draws) {
    return effective_size(rank_normalised(split_chains(draws)));
}

double tail_effective_size(const MatrixXd& draws) {
    return std::min(quantile_effective_size(draws, 0.05), quantile_effective_size(draws, 0.95));
}

double mean_effective_size(const MatrixXd& draws) {
    return effective_size(split_chains(draws));
}

}  // namespace skinfit
