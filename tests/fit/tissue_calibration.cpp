#include "fit/tissue_calibration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "core/file.hpp"
#include "core/text.hpp"
#include "fit/tissue.hpp"

/// The calibration is what its data say, and comes into estimates where it holds.
namespace skinfit::test {
namespace {

constexpr std::array predictors = {Parameter::papillary_blood_fraction, Parameter::reticular_blood_fraction,
                                   Parameter::lateral_loss_per_cm, Parameter::fibril_radius_nm};

/// A fit of a drawn skin: the four parameters with their intervals and correlations alone.
struct CalibrationFit {
    double true_umol_per_l = 0.0;
    FitResult result;
};

FittedParameter preset_parameter(Parameter parameter, double value, const Bounds& interval) {
    FittedParameter fitted{};
    fitted.parameter = parameter;
    fitted.name = info(parameter).name;
    fitted.value = value;
    fitted.bounds = {info(parameter).lower, info(parameter).upper};
    fitted.prior = LogNormalPrior{.median = value, .sigma_log = 1.0};
    fitted.uncertainty.status = Status::free;
    fitted.uncertainty.interval_95 = interval;
    return fitted;
}

/// instrument, truth, value and ends of each parameter, correlations of each with those before it.
CalibrationFit fit_in(std::string_view line) {
    const std::vector<std::string_view> cells = split(line, ',');
    const auto number = [&](std::size_t place) { return parse_number(cells.at(place)).value(); };
    CalibrationFit fit{.true_umol_per_l = number(1), .result = {}};
    FitResult& result = fit.result;
    result.configuration.preset = Preset::skin;
    result.spectra.resize(1);
    result.correlation = Eigen::MatrixXd::Identity(4, 4);
    std::size_t next = 14;
    for (std::size_t i = 0; i < predictors.size(); ++i) {
        result.free.push_back(
            preset_parameter(predictors[i], number(2 + 3 * i), {number(3 + 3 * i), number(4 + 3 * i)}));
        for (std::size_t k = 0; k < i; ++k) {
            const auto row = static_cast<Eigen::Index>(i);
            const auto column = static_cast<Eigen::Index>(k);
            result.correlation(row, column) = result.correlation(column, row) = number(next++);
        }
    }
    return fit;
}

std::vector<CalibrationFit> calibration_fits() {
    std::vector<CalibrationFit> fits;
    const std::string text = read_file(SKINFIT_SOURCE_DIR "/calibration/dermal_hemoglobin.csv");
    for (const std::string_view line : split_lines(text)) {
        if (line.starts_with("sphere,") || line.starts_with("port,")) fits.push_back(fit_in(line));
    }
    return fits;
}

Skin skin_of(const std::array<double, 4>& values) {
    ParameterValues all;
    for (std::size_t i = 0; i < values.size(); ++i) value_of(all, predictors[i]) = values[i];
    return all.skin;
}

/// Least squares of the logarithms, by other equations than those that made the numbers.
TEST(TissueCalibration, IsTheRegressionOfItsData) {
    const std::vector<CalibrationFit> fits = calibration_fits();
    ASSERT_EQ(fits.size(), 959U);
    Eigen::MatrixXd predicted(fits.size(), 5);
    Eigen::VectorXd truth(fits.size());
    for (std::size_t i = 0; i < fits.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        truth[row] = std::log(fits[i].true_umol_per_l);
        predicted(row, 0) = 1.0;
        for (Eigen::Index k = 0; k < 4; ++k) {
            predicted(row, k + 1) = std::log(fits[i].result.free[static_cast<std::size_t>(k)].value);
        }
    }
    const Eigen::VectorXd found = (predicted.transpose() * predicted).ldlt().solve(predicted.transpose() * truth);
    constexpr double as_printed = 0.0005;  // half the last digit of a coefficient
    const double at_one = std::log(calibrated_hemoglobin_umol_per_l(skin_of({1.0, 1.0, 1.0, 1.0})));
    EXPECT_NEAR(at_one, found[0], as_printed);
    for (std::size_t k = 0; k < 4; ++k) {
        std::array<double, 4> raised = {1.0, 1.0, 1.0, 1.0};
        raised[k] = std::exp(1.0);
        const double slope = std::log(calibrated_hemoglobin_umol_per_l(skin_of(raised))) - at_one;
        EXPECT_NEAR(slope, found[static_cast<Eigen::Index>(k) + 1], as_printed) << info(predictors[k]).name;
    }
}

/// The likelihood of the residuals, each normal with the half of its interval that lies on its side, is largest where
/// `hemoglobin_model_error` is what it is.
TEST(TissueCalibration, ModelErrorIsWhatIntervalsLeaveOfTheResiduals) {
    std::vector<std::pair<double, double>> squares;  // of the residual; of its sigma less the model's error
    std::size_t covered = 0;
    const std::vector<CalibrationFit> fits = calibration_fits();
    for (const CalibrationFit& fit : fits) {
        const std::vector<TissueEstimate> estimates = tissue_estimates(fit.result);
        const TissueEstimate& estimate = estimates.front();
        ASSERT_TRUE(estimate.is_calibrated);
        const Bounds& interval = estimate.interval_95.value();
        covered += interval.lower <= fit.true_umol_per_l && fit.true_umol_per_l <= interval.upper ? 1 : 0;
        const double residual = std::log(fit.true_umol_per_l / estimate.value);
        const double half = std::log((residual > 0.0 ? interval.upper : interval.lower) / estimate.value) / 1.96;
        squares.emplace_back(residual * residual, half * half - hemoglobin_model_error * hemoglobin_model_error);
    }
    const auto cost = [&](double error) {
        double sum = 0.0;
        for (const auto& [residual, own] : squares) {
            const double variance = own + error * error;
            sum += std::log(variance) + residual / variance;
        }
        return sum;
    };
    constexpr double last_digit = 0.001;
    EXPECT_LT(cost(hemoglobin_model_error), cost(hemoglobin_model_error - last_digit));
    EXPECT_LT(cost(hemoglobin_model_error), cost(hemoglobin_model_error + last_digit));
    EXPECT_GT(static_cast<double>(covered), 0.95 * static_cast<double>(fits.size()));
}

TEST(TissueCalibration, HoldsForThePresetThatItWasMadeWithAlone) {
    const FitResult result = calibration_fits().front().result;
    EXPECT_TRUE(has_calibrated_hemoglobin(result));
    FitResult other = result;
    other.configuration.preset = Preset::paper;
    EXPECT_FALSE(has_calibrated_hemoglobin(other));
    EXPECT_FALSE(tissue_estimates(other).front().is_calibrated);
    other = result;
    other.spectra.front().configuration.quantity = Quantity::transmittance;
    EXPECT_FALSE(has_calibrated_hemoglobin(other));
    other = result;
    other.free[2].prior.reset();
    EXPECT_FALSE(has_calibrated_hemoglobin(other)) << "a loss of 0 would give no amount";
    other = result;
    other.free.pop_back();
    EXPECT_FALSE(has_calibrated_hemoglobin(other));
}

/// Draws that say nothing leave the model's error: the quantiles of exp(s z).
TEST(TissueCalibration, DrawsHaveTheErrorOfTheModelToo) {
    FitResult result = calibration_fits().front().result;
    constexpr Eigen::Index count = 4000;
    Eigen::MatrixXd draws(4, count);
    for (Eigen::Index i = 0; i < 4; ++i) draws.row(i).setConstant(result.free[static_cast<std::size_t>(i)].value);
    result.posterior =
        Posterior{.marginals = {}, .correlation = {}, .draws = draws, .chains = 1, .divergences = 0, .evaluations = 0};
    const std::vector<TissueEstimate> estimates = tissue_estimates(result);
    const TissueEstimate& estimate = estimates.front();
    constexpr double evenness = 0.01;  // of 4000 multiples of the golden ratio, in sigmas of the quantile
    const double sigmas = 1.959963984540054;
    EXPECT_NEAR(std::log(estimate.interval_95->upper / estimate.value) / hemoglobin_model_error, sigmas, evenness);
    EXPECT_NEAR(std::log(estimate.interval_95->lower / estimate.value) / hemoglobin_model_error, -sigmas, evenness);
    EXPECT_EQ(estimate.draws.size(), count);
}

}  // namespace
}  // namespace skinfit::test
