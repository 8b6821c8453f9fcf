#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/lean_model.hpp"
#include "fit/problem.hpp"
#include "fit/synthetic_starts.hpp"
#include "fit/uncertainty.hpp"
#include "model/emulator.hpp"

namespace skinfit {

/// One of many fits.
struct BulkFit {
    bool converged = false;
    std::vector<double> values;    ///< of the free parameters
    std::vector<Status> statuses;  ///< of the free parameters: free, at a bound or not identifiable
    Eigen::MatrixXd covariance;    ///< of the free parameters, from the noise; zero for those at a bound
    double chi2 = 0.0;
    double rmse = 0.0;    ///< of reading minus measurement, fraction
    int evaluations = 0;  ///< of the model
};

/// How hard each spectrum is searched.
struct BulkOptions {
    /// From so many of the closest synthetic spectra, far from each other in the box: a spectrum may have several
    /// minima, of which the lowest that is found counts.
    int starts = 2;
};

/// Fits spectra that share everything but the measured values: `problem` with other values in place of
/// `Measurement::measured`. `emulator` must have been built for `emulator_domain(problem)`. Starts where the closest of
/// some synthetic spectra lie, whatever the starts of the problem. Minimum and covariance are those of `fit_spectrum`
/// with engine emulator. Refers to the problem, which must outlive it.
class BulkFitter {
public:
    /// Computes the synthetic spectra. Throws InputError as `LeanModel` does.
    BulkFitter(const FitProblem& problem, const Emulator& emulator, const BulkOptions& options = {});

    /// The fit of `spectrum`, fractions at the wavelengths of the problem. One that ends badly has `converged` false; a
    /// spectrum with values that are not finite has none: values, chi2 and rmse are NaN.
    [[nodiscard]] BulkFit fit(const Eigen::VectorXd& spectrum) const;

private:
    const FitProblem* problem_;
    BulkOptions options_;
    LeanModel model_;
    SyntheticStarts starts_;
};

/// The fits of a `BulkFitter` of each column of `spectra`, wavelengths x spectra; the same bits for any number of
/// threads.
[[nodiscard]] std::vector<BulkFit> fit_in_bulk(const FitProblem& problem, const Emulator& emulator,
                                               const Eigen::MatrixXd& spectra, const BulkOptions& options = {});

}  // namespace skinfit
