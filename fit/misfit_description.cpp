#include "fit/misfit_description.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "fit/measurement.hpp"
#include "fit/reading.hpp"
#include "fit/runs_test.hpp"
#include "model/angular_error.hpp"

namespace skinfit {
namespace {

/// `FitResult::degrees_of_freedom`: the trace of one minus the matrix that maps the data to the fitted data.
double degrees_of_freedom(const Objective& objective, const Minimum& minimum) {
    const auto readings = static_cast<Eigen::Index>(objective.reading_count());
    const auto free = static_cast<Eigen::Index>(objective.free_count());
    if (objective.residual_count() == objective.reading_count()) return static_cast<double>(readings - free);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(objective.misfit(minimum.values).jacobian);
    const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), free);
    return static_cast<double>(readings) - q.topRows(readings).squaredNorm();
}

double mean_square(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum / static_cast<double>(a.size());
}

/// Of all measurements, in their order; readings and residuals are those of the whole problem.
std::vector<FittedSpectrum> fitted_spectra(const FitProblem& problem, const Eigen::VectorXd& readings,
                                           const Eigen::VectorXd& residuals) {
    std::vector<FittedSpectrum> fitted;
    Eigen::Index first = 0;
    for (const Measurement& measurement : problem.measurements) {
        const auto count = static_cast<Eigen::Index>(measurement.measured.size());
        const Eigen::VectorXd modelled = readings.segment(first, count);
        FittedSpectrum row{.name = measurement.name,
                           .source = measurement.source,
                           .unit_rule = measurement.unit_rule,
                           .sigma_source = measurement.sigma_source,
                           .configuration = measurement.configuration,
                           .chi2 = residuals.segment(first, count).squaredNorm(),
                           .wavelength_nm = measurement.wavelength_nm,
                           .measured = measurement.measured,
                           .sigma = measurement.sigma,
                           .modelled = {modelled.begin(), modelled.end()}};
        row.rmse = std::sqrt(mean_square(row.modelled, row.measured));
        fitted.push_back(std::move(row));
        first += count;
    }
    return fitted;
}

double root_mean_square(const std::vector<FittedSpectrum>& spectra) {
    double sum = 0.0;
    double count = 0.0;
    for (const FittedSpectrum& spectrum : spectra) {
        const auto readings = static_cast<double>(spectrum.measured.size());
        sum += readings * spectrum.rmse * spectrum.rmse;
        count += readings;
    }
    return spectra.size() == 1 ? spectra.front().rmse : std::sqrt(sum / count);
}

/// `FitResult::runs_p_value` of residuals of all spectra, one after the other.
std::optional<double> least_runs_p_value(const std::vector<FittedSpectrum>& spectra, const Eigen::VectorXd& residuals) {
    std::optional<double> least;
    const double* first = residuals.data();
    for (const FittedSpectrum& spectrum : spectra) {
        const std::optional<double> p_value = runs_p_value({first, spectrum.measured.size()});
        first += spectrum.measured.size();
        if (p_value) least = std::min(least.value_or(1.0), static_cast<double>(spectra.size()) * *p_value);
    }
    return least;
}

std::optional<double> chi2_p_value(double chi2, double degrees_of_freedom) {
    if (!(degrees_of_freedom > 0.0)) return std::nullopt;
    const boost::math::chi_squared_distribution<double> law(degrees_of_freedom);
    return boost::math::cdf(boost::math::complement(law, chi2));
}

/// The largest error that the solver of `model` states of the share that leaves.
double solver_error(const MeasurementModel& model, std::span<const double> values) {
    constexpr std::size_t most_wavelengths = 16;  // chosen: errors change slowly with the wavelength
    const Experiment experiment = model.at(values);
    const std::vector<double> true_nm = true_wavelengths_nm(experiment, model.measurement().bands.wavelength_nm);
    const bool reflected = measured_side(model.measurement().quantity) == Side::top;
    const SolverErrorEstimate errors(std::get<AngularSolver>(model.forward_model()).with(experiment.values.skin));
    double largest = 0.0;
    for (std::size_t i = 0; i < true_nm.size(); i += 1 + true_nm.size() / most_wavelengths) {
        const SolverErrors error = errors.at(true_nm[i]);
        largest = std::max(largest, reflected ? error.viewed : error.transmitted);
    }
    return largest;
}

}  // namespace

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

void describe_misfit(const Objective& objective, const Minimum& minimum, FitResult& result) {
    const Objective::Modelled modelled = objective.model(minimum.values);
    result.spectra = fitted_spectra(objective.problem(), modelled.reading, objective.residuals(modelled.reading));
    result.rmse = root_mean_square(result.spectra);
    result.chi2 = minimum.chi2;
    result.cost = minimum.cost;
    result.degrees_of_freedom = degrees_of_freedom(objective, minimum);
    result.p_value = chi2_p_value(result.chi2, result.degrees_of_freedom);
    if (result.degrees_of_freedom > 0) result.inflation = std::sqrt(result.chi2 / result.degrees_of_freedom);
    const Eigen::VectorXd unexplained = objective.unexplained(modelled.reading);
    result.runs_p_value = least_runs_p_value(result.spectra, unexplained);
    result.unexplained = std::sqrt(unexplained.squaredNorm() / static_cast<double>(unexplained.size()));
    std::vector<double> sigmas;
    for (const FittedSpectrum& spectrum : result.spectra) {
        sigmas.insert(sigmas.end(), spectrum.sigma.begin(), spectrum.sigma.end());
    }
    result.median_sigma = median(sigmas);
    for (const MeasurementModel& model : objective.models()) {
        if (const std::optional<double> certified = certified_error(model.forward_model())) {
            result.emulator_error = std::max(result.emulator_error.value_or(0.0), *certified);
        } else if (std::holds_alternative<AngularSolver>(model.forward_model())) {
            result.solver_error = std::max(result.solver_error.value_or(0.0), solver_error(model, minimum.values));
        }
    }
    if (!result.emulator_error) {
        result.monte_carlo_error = median({modelled.standard_error.begin(), modelled.standard_error.end()});
    }
}

}  // namespace skinfit
