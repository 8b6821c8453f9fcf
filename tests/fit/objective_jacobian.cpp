#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

struct Case {
    Edition edition;
    Quantity quantity;
    Specular specular;
};

/// Everything that may be free in `c`.
std::vector<Parameter> adjustable(const Case& c) {
    std::vector<Parameter> result;
    for (const ParameterInfo& row : parameter_table()) {
        const bool seen = c.quantity == Quantity::reflectance && c.specular == Specular::excluded;
        if (!row.steers && (row.parameter != Parameter::specular_fraction || seen)) result.push_back(row.parameter);
    }
    return result;
}

Configuration configuration_of(const Case& c) {
    Configuration configuration = with_free(quick_configuration(), adjustable(c));
    configuration.edition = c.edition;
    configuration.quantity = c.quantity;
    configuration.specular = c.specular;
    configuration.incidence_deg = 45;
    if (c.quantity == Quantity::transmittance) configuration.base = Base{.kind = Base::Kind::matched};
    // Away from the values at which a factor is one or zero and a wrong derivative could hide.
    configuration.values.instrument = {.scale = 1.1, .offset = 0.01, .specular_fraction = 0.3};
    configuration.values.skin.stratum_corneum_thickness_cm = 0.0015;
    configuration.values.skin.bilirubin_g_per_l = 0.5;
    configuration.values.skin.melanin_slope = 0.4;
    configuration.values.skin.whole_blood_share = 0.3;
    configuration.values.skin.dermal_bilirubin_g_per_l = 0.1;
    configuration.values.skin.lateral_loss_per_cm = 0.2;
    configuration.values.skin.dermis_carotene_g_per_l = 7e-4;  // so that its steps are above rounding
    return configuration;
}

/// Derivative of the reading by one parameter from differences at steps h, h/2 and h/4, extrapolated twice as Romberg
/// did, and a bound of its error.
struct Differences {
    Eigen::VectorXd derivative;
    double error;
};

Differences differences(const Task& task, const std::vector<double>& values, std::size_t i) {
    const Bounds& bounds = task.problem.free[i].bounds;
    const double step = 1e-2 * std::min(bounds.upper - bounds.lower, std::abs(values[i]));
    const auto reading = [&](const std::vector<double>& point) { return task.objective.model(point).reading; };
    const auto central = [&](double h) { return central_difference(reading, values, i, h); };
    const Eigen::VectorXd d1 = central(step);
    const Eigen::VectorXd d2 = central(step / 2);
    const Eigen::VectorXd d4 = central(step / 4);
    const Eigen::VectorXd once = (4.0 * d4 - d2) / 3.0;
    const Eigen::VectorXd twice = (16.0 * once - (4.0 * d2 - d1) / 3.0) / 15.0;
    // Truncation: the last extrapolation changes more than what is left. Rounding: a reading is a mean of positive
    // weights, each right to a few ulps (8 here), summed in batches, and the smallest step divides the error of two.
    const double truncation = (twice - once).cwiseAbs().maxCoeff();
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() *
                            task.objective.model(values).reading.cwiseAbs().maxCoeff() / (step / 4);
    return {twice, truncation + 2.0 * rounding};
}

void expect_exact(const Case& c) {
    const Configuration configuration = configuration_of(c);
    const std::vector<double> wavelengths_nm = grid_nm(400, 700, 15);
    const Task task(configuration, modelled_spectrum(configuration, wavelengths_nm));
    std::vector<double> values;
    for (const FreeParameter& free : task.problem.free) values.push_back(free.start);
    const Eigen::MatrixXd jacobian = task.objective.model(values).jacobian;
    constexpr double required = 1e-6;  // relative to the largest entry of the column
    for (std::size_t i = 0; i < values.size(); ++i) {
        SCOPED_TRACE(info(task.problem.free[i].parameter).name);
        const Eigen::VectorXd exact = jacobian.col(static_cast<Eigen::Index>(i));
        const auto [derivative, error] = differences(task, values, i);
        const double largest = exact.cwiseAbs().maxCoeff();
        ASSERT_GT(largest, 0.0);
        EXPECT_LT(error, required * largest) << "the differences are too coarse to judge";
        EXPECT_LE((derivative - exact).cwiseAbs().maxCoeff(), error);
    }
}

TEST(ObjectiveJacobian, EqualsDifferencesOfReflectance) {
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        expect_exact({edition, Quantity::reflectance, Specular::included});
        expect_exact({edition, Quantity::reflectance, Specular::excluded});
    }
}

TEST(ObjectiveJacobian, EqualsDifferencesOfTransmittance) {
    for (const Edition edition : {Edition::printed, Edition::revised}) {
        expect_exact({edition, Quantity::transmittance, Specular::included});
        expect_exact({edition, Quantity::transmittance, Specular::excluded});
    }
}

TEST(ObjectiveJacobian, IsZeroWhereAParameterHasNoEffect) {
    Configuration configuration =
        with_free(quick_configuration(), {Parameter::melanosome_fraction, Parameter::reticular_blood_fraction});
    configuration.layers = 2;
    const Task task(configuration, modelled_spectrum(configuration, grid_nm(400, 700, 50)));
    const Eigen::MatrixXd jacobian = task.objective.model(std::vector{0.05, 0.01}).jacobian;
    EXPECT_GT(jacobian.col(0).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(jacobian.col(1).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Objective, MisfitIsTheReadingAgainstTheMeasurementInSigmas) {
    Configuration configuration = with_free(quick_configuration(), {Parameter::melanosome_fraction, Parameter::scale});
    configuration.noise = 0.25;  // a power of two: division by it is exact
    const Task task(configuration, modelled_spectrum(configuration, grid_nm(400, 700, 50)));
    const std::vector<double> values = {0.1, 1.1};
    const Misfit misfit = task.objective.misfit(values);
    const Objective::Modelled modelled = task.objective.model(values);
    EXPECT_EQ(misfit.residual, task.objective.residuals(modelled.reading));
    EXPECT_EQ(misfit.jacobian, 4.0 * modelled.jacobian);
    EXPECT_EQ(misfit.residual.squaredNorm(), task.objective.chi2(values));
}

TEST(Objective, BatchesAverageToTheReading) {
    Configuration configuration = with_free(quick_configuration(), {Parameter::melanosome_fraction});
    configuration.rays = 3200;  // batches of equal size: the plain mean
    const Task task(configuration, modelled_spectrum(configuration, grid_nm(400, 700, 50)));
    const std::vector<double> values = {0.05};
    const Eigen::VectorXd mean = task.objective.batch_readings(values).rowwise().mean();
    const Eigen::VectorXd reading = task.objective.model(values).reading;
    // Two orders of summing 3200 positive terms differ by no more than 3200 ulps.
    EXPECT_LE((mean - reading).cwiseAbs().maxCoeff(), 3200 * std::numeric_limits<double>::epsilon());
}

TEST(Objective, StandardErrorsOfReadingsAreTheScatterOfTheirBatches) {
    Configuration configuration = with_free(quick_configuration(), {Parameter::melanosome_fraction, Parameter::scale});
    configuration.rays = 3200;  // batches of equal size: the plain scatter
    const Task task(configuration, modelled_spectrum(configuration, grid_nm(400, 700, 50)));
    const std::vector<double> values = {0.05, 1.5};
    const Eigen::MatrixXd batches = task.objective.batch_readings(values);
    const auto count = static_cast<double>(batches.cols());
    const Eigen::MatrixXd deviations = batches.colwise() - Eigen::VectorXd(batches.rowwise().mean());
    const Eigen::VectorXd scatter = (deviations.rowwise().squaredNorm() / (count * (count - 1.0))).cwiseSqrt();
    const Eigen::VectorXd error = task.objective.model(values).standard_error;
    EXPECT_GT(scatter.minCoeff(), 0.0);
    // As above, of readings of about 1.
    EXPECT_LE((error - scatter).cwiseAbs().maxCoeff(), 3200 * std::numeric_limits<double>::epsilon());
}

}  // namespace
}  // namespace skinfit::test
