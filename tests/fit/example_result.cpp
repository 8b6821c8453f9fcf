#include "tests/fit/example_result.hpp"

#include <algorithm>
#include <cmath>

#include "core/erase_repeated.hpp"
#include "fit/critical_values.hpp"
#include "fit/diagnosis.hpp"

namespace skinfit::test {
namespace {

ParameterUncertainty plain(double sigma, double monte_carlo_sigma, const Bounds& interval) {
    return {.status = Status::free, .sigma = sigma, .monte_carlo_sigma = monte_carlo_sigma, .interval_95 = interval};
}

ParameterUncertainty without_sigma(Status status, const Bounds& interval) {
    return {.status = status, .sigma = std::nullopt, .monte_carlo_sigma = std::nullopt, .interval_95 = interval};
}

/// A result in which every parameter is fixed at its default.
FitResult all_fixed() {
    FitResult result;
    result.configuration = default_configuration();
    result.configuration.free.fill(false);
    result.configuration.base = Base{};
    result.configuration.incidence_deg = 45;
    result.configuration.specular = Specular::excluded;
    result.configuration.quantity = Quantity::reflectance;
    for (const ParameterInfo& row : parameter_table()) {
        const double value = value_of(result.configuration.values, row.parameter);
        result.fixed.push_back({.parameter = row.parameter,
                                .name = std::string(row.name),
                                .value = value,
                                .start = value,
                                .bounds = {row.lower, row.upper},
                                .uncertainty = without_sigma(Status::fixed, {value, value})});
    }
    result.rmse = 0.00512;
    result.chi2 = 30.25;
    result.cost = 30.25;
    result.degrees_of_freedom = 26;
    result.p_value = 0.26;
    result.inflation = 1.0786;
    result.slow_residuals_p_value = 0.4;
    result.unexplained_rmse = 0.00512;
    result.median_sigma = 0.006;
    result.monte_carlo_error = 0.00042;
    result.spectra.push_back({.name = "Forearm 7",
                              .source = "forearm.csv",
                              .unit_rule = "percent: most values exceed 1.5",
                              .sigma_source = "0.006 at every wavelength (default)",
                              .configuration = resolved(result.configuration),
                              .rmse = 0.00512,
                              .chi2 = 30.25,
                              .wavelength_nm = {400, 550, 700},
                              .measured = {0.1, 0.25, 0.5},
                              .sigma = {0.006, 0.006, 0.006},
                              .modelled = {0.105, 0.2475, 0.5}});
    return result;
}

void make_free(FitResult& result, Parameter parameter, double value, const ParameterUncertainty& uncertainty) {
    const auto found = std::ranges::find(result.fixed, parameter, &FittedParameter::parameter);
    FittedParameter row = *found;
    result.fixed.erase(found);
    row.value = value;
    row.uncertainty = uncertainty;
    result.free.push_back(row);
    result.configuration.free[static_cast<std::size_t>(parameter)] = true;
    result.answer.minimum.values.push_back(value);
}

std::vector<std::string> names_of(const std::vector<FittedParameter>& rows) {
    std::vector<std::string> names;
    for (const FittedParameter& row : rows) names.push_back(row.name);
    return names;
}

/// Of five parameters: the first two trade against each other, nothing is known of the last.
Identifiability example_identifiability(const FitResult& result) {
    Identifiability found{
        .names = names_of(result.free), .directions = {}, .shrinkage = {0.9999, 0.997, 0.93, 0.99, 0.02}};
    const std::vector<std::vector<double>> components = {
        {0.9, 0.43, 0.05, 0, 0}, {0, 0, 0, 1, 0}, {0, 0, 1, 0, 0.02}, {-0.43, 0.9, 0, 0, 0.01}, {0, 0, 0, 0, -1}};
    const std::vector<double> singular_values = {212.3, 10.5, 3.6, 2.2, 0.14};
    for (std::size_t k = 0; k < components.size(); ++k) {
        found.directions.push_back({.singular_value = singular_values[k],
                                    .components = Eigen::Map<const Eigen::VectorXd>(components[k].data(), 5)});
    }
    return found;
}

void judge(FitResult& result) {
    const Diagnosis diagnosis = diagnose(result);
    result.verdict = diagnosis.verdict;
    result.reasons = diagnosis.reasons;
}

}  // namespace

FitResult example_result() {
    FitResult result = all_fixed();
    make_free(result, Parameter::melanosome_fraction, 0.0234567, plain(0.00123, 0.000045, {0.02104, 0.02587}));
    make_free(result, Parameter::papillary_blood_fraction, 0.0123, plain(0.0045, 0.0003, {0.0035, 0.0211}));
    make_free(result, Parameter::oxygen_saturation, 1.0, without_sigma(Status::at_upper_bound, {0.873, 1.0}));
    make_free(result, Parameter::bilirubin_g_per_l, 0.0, without_sigma(Status::at_lower_bound, {0.0, 0.214}));
    make_free(result, Parameter::dermis_carotene_g_per_l, 0.004, without_sigma(Status::not_identifiable, {0, 0.01}));
    result.cost = 31.5;
    result.configuration.loss = Loss::huber;
    result.configuration.discrepancy = Discrepancy{};
    result.priors = {"oxygen_saturation: beta, a 2, b 2"};
    result.correlation = Eigen::MatrixXd::Identity(5, 5);
    result.correlation(0, 1) = result.correlation(1, 0) = -0.934;
    result.identifiability = example_identifiability(result);
    result.answer.solver = Solver::ceres;
    result.answer.minimum.chi2 = 30.25;
    result.answer.minimum.cost = 31.5;
    result.answer.minimum.evaluations = 12;
    result.answer.minimum.converged = true;
    result.answer.minimum.termination = "Function tolerance reached.";
    result.answer.seconds = 0.012;
    result.searches = {.minima = {{.minimum = result.answer.minimum, .searches = 7},
                                  {.minimum = result.answer.minimum, .searches = 1}},
                       .starts = 8,
                       .rough_minima = 2,
                       .finished = 2};
    result.searches.minima[1].minimum.cost = 60.25;
    result.searches.minima[1].minimum.values[0] = 0.1;
    SolverAnswer other = result.answer;
    other.solver = Solver::bobyqa;
    other.seconds = 0.47;
    other.minimum.chi2 = 30.1;
    other.minimum.cost = 31.4;
    other.minimum.evaluations = 345;
    other.minimum.values[0] += 0.000246;
    other.minimum.termination = "steps below the tolerance";
    result.cross_check.push_back(other);
    judge(result);
    return result;
}

FitResult good_result() {
    FitResult result = all_fixed();
    make_free(result, Parameter::melanosome_fraction, 0.0234567, plain(0.00123, 0.000045, {0.02104, 0.02587}));
    result.correlation = Eigen::MatrixXd::Identity(1, 1);
    result.identifiability = {.names = names_of(result.free),
                              .directions = {{.singular_value = 117.4, .components = Eigen::VectorXd::Ones(1)}},
                              .shrinkage = {0.99993}};
    result.answer.solver = Solver::ceres;
    result.answer.minimum.cost = result.cost;
    result.answer.minimum.converged = true;
    result.searches = {
        .minima = {{.minimum = result.answer.minimum, .searches = 8}}, .starts = 8, .rough_minima = 1, .finished = 1};
    judge(result);
    return result;
}

FitResult split_result() {
    FitResult result = good_result();
    result.fixed.push_back(result.free.front());
    result.fixed.back().uncertainty = without_sigma(Status::fixed, {0.0234567, 0.0234567});
    result.free.clear();
    result.answer.minimum.values.clear();
    make_free(result, Parameter::papillary_blood_fraction, 0.0123, plain(0.0045, 0.0003, {0.0035, 0.0211}));
    make_free(result, Parameter::reticular_blood_fraction, 0.009, plain(0.002, 0.0003, {0.005, 0.013}));
    result.correlation = Eigen::MatrixXd::Identity(2, 2);
    result.correlation(0, 1) = result.correlation(1, 0) = -0.72;
    result.identifiability = {.names = names_of(result.free),
                              .directions = {{.singular_value = 117.4, .components = Eigen::VectorXd::Unit(2, 0)},
                                             {.singular_value = 7.4, .components = Eigen::VectorXd::Unit(2, 1)}},
                              .shrinkage = {0.99993, 0.98}};
    result.searches.minima.front().minimum = result.answer.minimum;
    judge(result);
    return result;
}

FitResult profiled_result() {
    FitResult result = example_result();
    result.configuration.uncertainty = UncertaintyMethod::profile;
    result.profile = Profile{.intervals = {}, .minimum = {}, .cost = 31.5, .better_minimum = false, .evaluations = 53};
    for (const FittedParameter& free : result.free) {
        const auto& [lower, upper] = free.uncertainty.interval_95;
        const double sigma = (upper - lower) / 4.0;
        ProfileCurve curve;
        for (const double at : {lower, free.value, upper}) {
            const double distance = (at - free.value) / sigma;
            curve.push_back({.at = at,
                             .cost_rise = std::pow(distance, 2),
                             .cost_slope = 2.0 * distance / sigma,
                             .cost_rise_95 = normal_95 * normal_95});
        }
        erase_repeated(curve, &ProfilePoint::at);
        result.profile->intervals.push_back({.lower = lower,
                                             .upper = upper,
                                             .open_below = lower == free.bounds.lower,
                                             .open_above = upper == free.bounds.upper,
                                             .curve = curve});
    }
    judge(result);
    return result;
}

FitResult sampled_result() {
    FitResult result = good_result();
    result.configuration.uncertainty = UncertaintyMethod::posterior;
    result.posterior = {.marginals = {{.median = 0.023501,
                                       .mean = 0.02352,
                                       .sigma = 0.00124,
                                       .lower = 0.02105,
                                       .upper = 0.02599,
                                       .r_hat = 1.0012,
                                       .bulk_effective_size = 1834.2,
                                       .tail_effective_size = 1402.7}},
                        .correlation = Eigen::MatrixXd::Identity(1, 1),
                        .draws = Eigen::MatrixXd::Constant(1, 4, 0.0235),
                        .chains = 2,
                        .divergences = 1,
                        .evaluations = 14321};
    judge(result);
    return result;
}

}  // namespace skinfit::test
