#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/problem.hpp"

namespace skinfit {

/// The work on which all rungs of the ladder are measured: Table 1 at 45 degrees, every 10 nm from 400 to 700 nm, five
/// free pigments, and spectra with noise of 0.003.
struct BenchWork {
    Configuration configuration;
    FitProblem problem;       ///< of any of the spectra, without its measured values
    Eigen::MatrixXd spectra;  ///< wavelengths x spectra, fractions
};

/// `count` spectra of skins spread over the bounds, evenly on the scale of `to_unit_box`, as the angular solver reads
/// them; `rays` are those of a recording and of the analog walk.
[[nodiscard]] BenchWork bench_work(std::size_t count, std::uint64_t rays);

/// The problem of fitting spectrum `number`.
[[nodiscard]] FitProblem problem_of(const BenchWork& work, Eigen::Index number);

}  // namespace skinfit
