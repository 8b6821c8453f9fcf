#include "fit/posterior.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "fit/chain_statistics.hpp"

namespace skinfit {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd logistic(const VectorXd& logits) {
    return (1.0 / (1.0 + (-logits.array()).exp())).matrix();
}

/// A normal approximation in logits.
struct Laplace {
    VectorXd centre;
    MatrixXd covariance;
};

/// Minus the Hessian of the log density in logits, without the second derivatives of the model: positive definite.
MatrixXd information(const BoxMisfit& misfit, const VectorXd& logits) {
    const ArrayXd position = logistic(logits).array();
    const VectorXd by_logit = (position * (1.0 - position)).matrix();
    const MatrixXd jacobian = misfit(position.matrix()).jacobian * by_logit.asDiagonal();
    MatrixXd information = jacobian.transpose() * jacobian;
    information.diagonal() += 2.0 * by_logit;
    return information;
}

/// By Newton's method on the density of the logits, halving steps that lead down.
Laplace laplace(const BoxMisfit& misfit, const VectorXd& minimum) {
    constexpr int most_steps = 50;
    constexpr double close_enough = 1e-3;  // of the log density
    const DensityFunction density = logit_density(misfit);
    const ArrayXd inside = minimum.array().max(1e-3).min(1.0 - 1e-3);
    VectorXd logits = (inside / (1.0 - inside)).log().matrix();
    LogDensity here = density(logits);
    for (int k = 0; k < most_steps; ++k) {
        VectorXd step = information(misfit, logits).ldlt().solve(here.gradient);
        if (here.gradient.dot(step) < close_enough) break;
        LogDensity there = density(logits + step);
        for (int halvings = 0; halvings < 20 && !(there.value > here.value); ++halvings) {
            step *= 0.5;
            there = density(logits + step);
        }
        if (!(there.value > here.value)) break;
        logits += step;
        here = there;
    }
    const Index size = logits.size();
    return {.centre = logits, .covariance = information(misfit, logits).ldlt().solve(MatrixXd::Identity(size, size))};
}

/// One quantity out of the chains' draws: draws x chains.
MatrixXd of_parameter(const std::vector<MatrixXd>& chains, Index parameter) {
    MatrixXd draws(chains.front().cols(), static_cast<Index>(chains.size()));
    for (std::size_t chain = 0; chain < chains.size(); ++chain) {
        draws.col(static_cast<Index>(chain)) = chains[chain].row(parameter).transpose();
    }
    return draws;
}

bool has_enough(const std::vector<MatrixXd>& chains, double wanted) {
    for (Index parameter = 0; parameter < chains.front().rows(); ++parameter) {
        const MatrixXd draws = of_parameter(chains, parameter);
        if (std::min(bulk_effective_size(draws), tail_effective_size(draws)) < wanted) return false;
    }
    return true;
}

Marginal marginal(const MatrixXd& draws) {
    const double mean = draws.mean();
    return {.median = quantile(draws, 0.5),
            .mean = mean,
            .sigma = std::sqrt((draws.array() - mean).square().sum() / static_cast<double>(draws.size() - 1)),
            .lower = quantile(draws, 0.025),
            .upper = quantile(draws, 0.975),
            .r_hat = r_hat(draws),
            .bulk_effective_size = bulk_effective_size(draws),
            .tail_effective_size = tail_effective_size(draws)};
}

/// Chains around the Laplace approximation, farther apart than it says so that R-hat can tell whether they meet.
std::vector<NutsChain> started_chains(const BoxMisfit& misfit, const VectorXd& minimum,
                                      const SamplingOptions& options) {
    constexpr double dispersion = 2.0;
    constexpr std::uint64_t first_stream = std::uint64_t{1} << 40U;  // apart from those of recorded walks
    const Laplace normal = laplace(misfit, minimum);
    const MatrixXd root = normal.covariance.llt().matrixL();
    std::vector<NutsChain> chains;
    for (int chain = 0; chain < options.chains; ++chain) {
        ChainRandom random(options.seed, first_stream + static_cast<std::uint64_t>(chain));
        VectorXd away(minimum.size());
        for (double& number : away) number = random.normal();
        chains.emplace_back(logit_density(misfit), normal.centre + dispersion * (root * away), normal.covariance,
                            random);
    }
    return chains;
}

}  // namespace

MatrixXd correlation_of(const MatrixXd& draws) {
    const MatrixXd centred = draws.colwise() - VectorXd(draws.rowwise().mean());
    const VectorXd inverse = centred.rowwise().norm().cwiseInverse();
    return inverse.asDiagonal() * (centred * centred.transpose()) * inverse.asDiagonal();
}

DensityFunction logit_density(const BoxMisfit& misfit) {
    return [misfit](const VectorXd& logits) -> LogDensity {
        const VectorXd position = logistic(logits);
        const VectorXd rest = logistic(-logits);  // 1 - position, without its rounding
        const Misfit here = misfit(position);
        VectorXd slope = -here.jacobian.transpose() * here.residual;
        if (here.log_volume_slope.size() > 0) slope += here.log_volume_slope;
        return {.value = -0.5 * here.residual.squaredNorm() + here.log_volume + position.array().log().sum() +
                         rest.array().log().sum(),
                .gradient = rest - position + slope.cwiseProduct(position).cwiseProduct(rest)};
    };
}

Posterior sample_posterior(const BoxMisfit& misfit, const VectorXd& minimum, const SamplingOptions& options) {
    constexpr int block = 250;
    std::vector<NutsChain> chains = started_chains(misfit, minimum, options);
    std::vector<MatrixXd> positions(chains.size(), MatrixXd(minimum.size(), 0));
    const auto run = [&](std::size_t chain) {
        if (positions[chain].cols() == 0) chains[chain].warm_up(options.warm_up);
        const MatrixXd more = chains[chain].draw(block);
        MatrixXd longer(minimum.size(), positions[chain].cols() + block);
        longer << positions[chain], logistic(more.reshaped()).reshaped(more.rows(), more.cols());
        positions[chain] = std::move(longer);
    };
    do {
        tbb::parallel_for(std::size_t{0}, chains.size(), run);
    } while (positions.front().cols() < options.most_draws && !has_enough(positions, options.effective_samples));

    Posterior posterior{.marginals = {},
                        .correlation = {},
                        .draws = MatrixXd(minimum.size(), 0),
                        .chains = options.chains,
                        .divergences = 0,
                        .evaluations = 0};
    for (Index parameter = 0; parameter < minimum.size(); ++parameter) {
        posterior.marginals.push_back(marginal(of_parameter(positions, parameter)));
    }
    posterior.draws.resize(minimum.size(), positions.front().cols() * static_cast<Index>(positions.size()));
    for (std::size_t chain = 0; chain < chains.size(); ++chain) {
        posterior.draws.middleCols(static_cast<Index>(chain) * positions.front().cols(), positions.front().cols()) =
            positions[chain];
        posterior.divergences += chains[chain].divergences();
        posterior.evaluations += chains[chain].evaluations();
    }
    posterior.correlation = correlation_of(posterior.draws);
    return posterior;
}

}  // namespace skinfit
