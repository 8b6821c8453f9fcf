#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fit/resolution.hpp"
#include "fit/settings.hpp"
#include "model/disk_cache.hpp"

namespace skinfit {

/// What is planned: which parameter is to be measured, and with how many wavelengths.
struct DesignRequest {
    Parameter parameter;
    std::size_t best = 0;  ///< so many wavelengths are chosen; 0: none
    DiskCache cache;
};

/// How small a change of one parameter a spectrum of given noise can show.
///
/// A change is detected by a one-sided test at the 5 % level; the detection limit is the change that this test finds in
/// 80 % of repetitions: (1.645 + 0.842) sigma [CURRIE68, with beta = 0.2]. Sigma comes from the Fisher information at
/// the configured values, for one spectrum compared with known skin.
struct DetectionLimit {
    double sigma;  ///< 1 standard deviation of the parameter; infinite where the others can imitate it
    double limit;  ///< smallest change detected with 80 % power
};

/// A planned measurement.
struct Design {
    ResolvedConfiguration configuration;
    Parameter parameter;
    double value;                       ///< around which the limits hold
    std::vector<double> wavelength_nm;  ///< the candidates
    DetectionLimit others_free;
    DetectionLimit others_fixed;
    std::vector<double> best_nm;            ///< the chosen wavelengths, ascending; empty where none were asked for
    std::optional<DetectionLimit> by_best;  ///< with the chosen wavelengths alone, the others free
};

/// 2.486: quantiles of the normal distribution at 95 % and 80 %, added.
[[nodiscard]] double detection_factor();

/// The variance of parameter `column` when all others are free, each known beforehand to its `prior_step` (the one in
/// question counts as unknown), from readings whose derivatives are `rows` of `jacobian` over their noise.
[[nodiscard]] double variance_of(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& prior_sigma,
                                 const std::vector<Eigen::Index>& rows, Eigen::Index column);

/// The `count` rows that make `variance_of` small (c-optimality): from each of up to 32 first rows, one after the
/// other the row that helps most, then exchanges of one for another as long as any helps [FEDOROV72].
[[nodiscard]] std::vector<Eigen::Index> best_rows(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& prior_sigma,
                                                  std::size_t count, Eigen::Index column);

/// Plans as `configuration` says: its values, noise, free parameters, engine and wavelengths of a simulation. The
/// parameter in question counts as free. Throws InputError where the parameter has no effect, more wavelengths are to
/// be chosen than there are, or the problem makes no sense (`make_problem`).
[[nodiscard]] Design design(const Configuration& configuration, const DesignRequest& request);

/// As text, a table of wavelengths, and JSON.
[[nodiscard]] std::string design_text(const Design& design);
[[nodiscard]] std::string design_csv(const Design& design);
[[nodiscard]] Json design_json(const Design& design);

}  // namespace skinfit
