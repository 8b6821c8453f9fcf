#include "fit/misfit_description.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "fit/measurement.hpp"
#include "fit/reading.hpp"
#include "fit/slow_residuals.hpp"
#include "model/angular_error.hpp"

namespace skinfit {
namespace {

/// What the fit takes of the whitened data, readings x free parameters: the data's rows of an orthonormal basis of what
/// the free parameters change.
Eigen::MatrixXd fitted_directions(const Objective& objective, const Minimum& minimum) {
    const auto free = static_cast<Eigen::Index>(objective.free_count());
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(objective.misfit(minimum.values).jacobian);
    const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), free);
    return basis.topRows(static_cast<Eigen::Index>(objective.reading_count()));
}

/// `FitResult::degrees_of_freedom`: the trace of one minus the matrix that maps the data to the fitted data.
double degrees_of_freedom(const Objective& objective, const Eigen::MatrixXd& fitted) {
    const auto readings = static_cast<double>(objective.reading_count());
    const bool has_priors = objective.residual_count() > objective.reading_count();
    return readings - (has_priors ? fitted.squaredNorm() : static_cast<double>(objective.free_count()));
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

/// `FitResult::slow_residuals_p_value` of whitened residuals of all spectra, one after the other.
std::optional<double> least_slow_p_value(const std::vector<FittedSpectrum>& spectra, const Eigen::VectorXd& residuals,
                                         const Eigen::MatrixXd& fitted) {
    std::optional<double> least;
    Eigen::Index first = 0;
    for (const FittedSpectrum& spectrum : spectra) {
        const auto count = static_cast<Eigen::Index>(spectrum.measured.size());
        const std::optional<double> p_value =
            slow_residuals_p_value(residuals.segment(first, count), fitted.middleRows(first, count));
        first += count;
        if (p_value) least = std::min(least.value_or(1.0), static_cast<double>(spectra.size()) * *p_value);
    }
    return least;
}

double root_mean_square(const Eigen::VectorXd& values) {
    return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
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
    const Eigen::VectorXd residuals = objective.residuals(modelled.reading);
    const Eigen::MatrixXd fitted = fitted_directions(objective, minimum);
    result.spectra = fitted_spectra(objective.problem(), modelled.reading, residuals);
    result.rmse = root_mean_square(result.spectra);
    result.chi2 = minimum.chi2;
    result.cost = minimum.cost;
    result.degrees_of_freedom = degrees_of_freedom(objective, fitted);
    result.p_value = chi2_p_value(result.chi2, result.degrees_of_freedom);
    if (result.degrees_of_freedom > 0) result.inflation = std::sqrt(result.chi2 / result.degrees_of_freedom);
    result.slow_residuals_p_value = least_slow_p_value(result.spectra, residuals, fitted);
    std::vector<double> sigmas;
    std::vector<double> differences;
    for (const FittedSpectrum& spectrum : result.spectra) {
        sigmas.insert(sigmas.end(), spectrum.sigma.begin(), spectrum.sigma.end());
        for (std::size_t i = 0; i < spectrum.measured.size(); ++i) {
            differences.push_back(spectrum.modelled[i] - spectrum.measured[i]);
        }
    }
    const auto readings = static_cast<Eigen::Index>(sigmas.size());
    const Eigen::VectorXd unexplained = objective.unexplained(modelled.reading)
                                            .cwiseProduct(Eigen::Map<const Eigen::VectorXd>(sigmas.data(), readings));
    result.unexplained_rmse = root_mean_square(unexplained);
    result.departure_rms =
        root_mean_square(Eigen::Map<const Eigen::VectorXd>(differences.data(), readings) - unexplained);
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
