#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "model/random.hpp"

namespace skinfit {

/// The logarithm of a density, up to a constant, and its gradient.
struct LogDensity {
    double value;
    Eigen::VectorXd gradient;
};
using DensityFunction = std::function<LogDensity(const Eigen::VectorXd& position)>;

/// Random numbers of one chain, a function of seed, chain and how many were drawn before.
class ChainRandom {
public:
    /// The numbers of chain `chain`.
    ChainRandom(std::uint64_t seed, std::uint64_t chain);
    [[nodiscard]] double uniform();  ///< in (0, 1)
    [[nodiscard]] double normal();   ///< standard normal

private:
    RandomRay numbers_;
    std::uint32_t drawn_ = 0;
};

/// A chain of the No-U-Turn sampler [HOFFMAN14] as Stan runs it: multinomial choice of the next point, generalised
/// criterion for turning back [BETANCOURT17], step size by dual averaging and a dense mass matrix, both learnt while
/// warming up. Positions are unconstrained.
class NutsChain {
public:
    /// `covariance`: a guess of the density's, positive definite.
    NutsChain(DensityFunction density, const Eigen::VectorXd& start, const Eigen::MatrixXd& covariance,
              const ChainRandom& random);

    /// Learns step size and mass matrix over `transitions`, which are lost.
    void warm_up(int transitions);

    /// The next `count` positions: dimensions x count.
    [[nodiscard]] Eigen::MatrixXd draw(int count);

    [[nodiscard]] int divergences() const { return divergences_; }  ///< since warm-up
    /// Of the density, so far.
    [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

private:
    /// A point of a trajectory.
    struct State {
        Eigen::VectorXd position;
        Eigen::VectorXd momentum;
        Eigen::VectorXd velocity;  // inverse mass times momentum
        LogDensity density;
    };
    /// A stretch of a trajectory, `first` to `last` in the order in which it was built.
    struct Stretch {
        State first;
        State last;
        Eigen::VectorXd momentum_sum;
        State chosen;
        double log_weight;
        bool complete;  // neither turned back nor diverged
    };
    struct Transition {
        double acceptance = 0.0;  // mean over the trajectory
        bool diverged = false;
    };

    void set_covariance(const Eigen::MatrixXd& covariance);
    void set_momentum(State& state);
    [[nodiscard]] double energy(const State& state) const;
    [[nodiscard]] State leap(const State& from, double step);
    [[nodiscard]] Stretch extend(const State& from, double step, int depth, double initial_energy);
    [[nodiscard]] bool joins(const Stretch& one, const Stretch& other) const;
    Transition transition();
    void find_step();

    DensityFunction density_;
    ChainRandom random_;
    State state_;
    Eigen::MatrixXd covariance_;  // the inverse mass matrix
    Eigen::MatrixXd covariance_root_;
    double step_ = 1.0;
    double acceptance_sum_ = 0.0;  // of the trajectory being built
    int leaps_ = 0;
    bool diverged_ = false;
    int divergences_ = 0;
    std::int64_t evaluations_ = 0;
};

}  // namespace skinfit
