#include "fit/nuts.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace skinfit {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double target_acceptance = 0.9;  // above 0.8, the usual, logits at a bound diverge less

double log_of_sum(double log_a, double log_b) {
    const double larger = std::max(log_a, log_b);
    return larger + std::log1p(std::exp(std::min(log_a, log_b) - larger));
}

/// The step size that gives the wanted acceptance [HOFFMAN14, Sec. 3.2].
class DualAveraging {
public:
    explicit DualAveraging(double step) : centre_(std::log(10.0 * step)) {}

    /// Takes the acceptance of one transition; the step of the next.
    double learn(double acceptance) {
        constexpr double shrinkage = 0.05;
        constexpr double early_weight = 10.0;
        constexpr double forgetting = 0.75;
        ++count_;
        const double weight = 1.0 / (count_ + early_weight);
        error_ += weight * (target_acceptance - acceptance - error_);
        const double log_step = centre_ - std::sqrt(count_) / shrinkage * error_;
        const double share = std::pow(count_, -forgetting);
        log_average_ += share * (log_step - log_average_);
        return std::exp(log_step);
    }

    [[nodiscard]] double average() const { return std::exp(log_average_); }

private:
    double centre_;
    double count_ = 0.0;
    double error_ = 0.0;
    double log_average_ = 0.0;
};

/// The covariance of `positions`, pulled a little towards a small multiple of the identity as in Stan.
MatrixXd learnt_covariance(const MatrixXd& positions) {
    const auto count = static_cast<double>(positions.cols());
    const MatrixXd centred = positions.colwise() - VectorXd(positions.rowwise().mean());
    const MatrixXd covariance = centred * centred.transpose() / (count - 1.0);
    const MatrixXd small = 1e-3 * MatrixXd::Identity(positions.rows(), positions.rows());
    return (count * covariance + 5.0 * small) / (count + 5.0);
}

}  // namespace

ChainRandom::ChainRandom(std::uint64_t seed, std::uint64_t chain)
    // Apart from the rays of walks, which are numbered from 0. Recorded walks take the lowest 2^36 of these numbers,
    // see `RankedNumbers`: what must not depend on one begins further up.
    : numbers_(seed, chain | (std::uint64_t{1} << 63U)) {}

double ChainRandom::uniform() {
    const std::uint32_t number = drawn_++;
    return numbers_.uniforms(number / 4, 0)[number % 4];
}

double ChainRandom::normal() {
    // Box and Muller's cosine.
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

NutsChain::NutsChain(DensityFunction density, const VectorXd& start, const MatrixXd& covariance,
                     const ChainRandom& random)
    : density_(std::move(density)), random_(random) {
    state_.position = start;
    state_.density = density_(start);
    ++evaluations_;
    set_covariance(covariance);
}

void NutsChain::set_covariance(const MatrixXd& covariance) {
    covariance_ = covariance;
    covariance_root_ = covariance.llt().matrixL();
}

void NutsChain::set_momentum(State& state) {
    VectorXd normal(state.position.size());
    for (double& number : normal) number = random_.normal();
    state.momentum = covariance_root_.transpose().triangularView<Eigen::Upper>().solve(normal);
    state.velocity = covariance_ * state.momentum;
}

double NutsChain::energy(const State& state) const {
    const double sum = 0.5 * state.momentum.dot(state.velocity) - state.density.value;
    return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
}

NutsChain::State NutsChain::leap(const State& from, double step) {
    State to;
    to.momentum = from.momentum + 0.5 * step * from.density.gradient;
    to.position = from.position + step * (covariance_ * to.momentum);
    to.density = density_(to.position);
    to.momentum += 0.5 * step * to.density.gradient;
    to.velocity = covariance_ * to.momentum;
    ++evaluations_;
    return to;
}

/// Whether `one` followed by `other` has not turned back, nor has either with the nearest point of its neighbour.
bool NutsChain::joins(const Stretch& one, const Stretch& other) const {
    const auto goes_on = [](const State& begin, const State& end, const VectorXd& momentum_sum) {
        return begin.velocity.dot(momentum_sum) > 0.0 && end.velocity.dot(momentum_sum) > 0.0;
    };
    return goes_on(one.first, other.last, one.momentum_sum + other.momentum_sum) &&
           goes_on(one.first, other.first, one.momentum_sum + other.first.momentum) &&
           goes_on(one.last, other.last, one.last.momentum + other.momentum_sum);
}

NutsChain::Stretch NutsChain::extend(const State& from, double step, int depth, double initial_energy) {
    constexpr double divergence = 1000.0;  // of the energy
    if (depth == 0) {
        const State to = leap(from, step);
        const double change = energy(to) - initial_energy;
        acceptance_sum_ += std::exp(std::min(0.0, -change));
        ++leaps_;
        const bool diverges = !(change < divergence);
        diverged_ = diverged_ || diverges;
        return {.first = to,
                .last = to,
                .momentum_sum = to.momentum,
                .chosen = to,
                .log_weight = -change,
                .complete = !diverges};
    }
    Stretch near = extend(from, step, depth - 1, initial_energy);
    if (!near.complete) return near;
    Stretch far = extend(near.last, step, depth - 1, initial_energy);
    if (!far.complete) return far;
    const double log_weight = log_of_sum(near.log_weight, far.log_weight);
    const bool complete = joins(near, far);
    const bool choose_far = std::log(random_.uniform()) < far.log_weight - log_weight;
    return {.first = std::move(near.first),
            .last = std::move(far.last),
            .momentum_sum = near.momentum_sum + far.momentum_sum,
            .chosen = choose_far ? std::move(far.chosen) : std::move(near.chosen),
            .log_weight = log_weight,
            .complete = complete};
}

NutsChain::Transition NutsChain::transition() {
    constexpr int greatest_depth = 10;
    set_momentum(state_);
    acceptance_sum_ = 0.0;
    leaps_ = 0;
    diverged_ = false;
    const double initial_energy = energy(state_);
    Stretch trajectory{.first = state_,
                       .last = state_,
                       .momentum_sum = state_.momentum,
                       .chosen = state_,
                       .log_weight = 0.0,
                       .complete = true};
    bool forward = true;  // the direction in which `last` lies
    for (int depth = 0; depth < greatest_depth && trajectory.complete; ++depth) {
        const bool go_forward = random_.uniform() < 0.5;
        if (go_forward != forward) std::swap(trajectory.first, trajectory.last);
        forward = go_forward;
        Stretch more = extend(trajectory.last, forward ? step_ : -step_, depth, initial_energy);
        if (!more.complete) break;
        // Biased towards the new half, away from where the chain stands [BETANCOURT17, App. A.3.2].
        if (std::log(random_.uniform()) < more.log_weight - trajectory.log_weight) {
            trajectory.chosen = std::move(more.chosen);
        }
        trajectory.complete = joins(trajectory, more);
        trajectory.log_weight = log_of_sum(trajectory.log_weight, more.log_weight);
        trajectory.momentum_sum += more.momentum_sum;
        trajectory.last = std::move(more.last);
    }
    state_ = std::move(trajectory.chosen);
    return {.acceptance = acceptance_sum_ / std::max(leaps_, 1), .diverged = diverged_};
}

/// Doubles or halves the step until the acceptance of one leap crosses the target [HOFFMAN14, Alg. 4].
void NutsChain::find_step() {
    constexpr int most_tries = 50;
    double direction = 0.0;
    for (int k = 0; k < most_tries; ++k) {
        set_momentum(state_);
        const double before = energy(state_);
        const double change = energy(leap(state_, step_)) - before;
        const double wanted = -change > std::log(target_acceptance) ? 1.0 : -1.0;
        if (direction != 0.0 && wanted != direction) return;
        direction = wanted;
        step_ *= direction > 0.0 ? 2.0 : 0.5;
    }
}

void NutsChain::warm_up(int transitions) {
    // Shares of the warm-up: towards the bulk with the given mass matrix, two windows that each learn the next matrix,
    // and the step size for the last one.
    const int approach = transitions * 15 / 100;
    const int first_window = transitions * 25 / 100;
    const int second_window = transitions * 45 / 100;
    const int settling = transitions - approach - first_window - second_window;
    for (const int window : {approach, first_window, second_window, settling}) {
        find_step();
        DualAveraging averaging(step_);
        MatrixXd positions(state_.position.size(), window);
        for (int k = 0; k < window; ++k) {
            step_ = averaging.learn(transition().acceptance);
            positions.col(k) = state_.position;
        }
        if (window == first_window || window == second_window) set_covariance(learnt_covariance(positions));
        if (window > 0) step_ = averaging.average();
    }
    divergences_ = 0;
}

MatrixXd NutsChain::draw(int count) {
    MatrixXd positions(state_.position.size(), count);
    for (int k = 0; k < count; ++k) {
        if (transition().diverged) ++divergences_;
        positions.col(k) = state_.position;
    }
    return positions;
}

}  // namespace skinfit
