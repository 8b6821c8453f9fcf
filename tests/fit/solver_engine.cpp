#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>

#include "fit/fit.hpp"
#include "model/constants.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

Configuration solver_configuration(const std::vector<Parameter>& free) {
    return tilted(quick_configuration(), Engine::solver, free);
}

Spectrum spectrum_of(const std::vector<Reading>& readings) {
    Spectrum spectrum;
    spectrum.name = "synthetic";
    spectrum.source = "synthetic";
    for (const Reading& reading : readings) {
        spectrum.wavelength_nm.push_back(reading.wavelength_nm);
        spectrum.value.push_back(reading.reflectance);
    }
    return spectrum;
}

TEST(SolverEngine, JacobianEqualsDifferencesForParametersThatSteer) {
    const std::vector<Parameter> free = {Parameter::epidermis_thickness_cm,
                                         Parameter::papillary_dermis_thickness_cm,
                                         Parameter::reticular_dermis_thickness_cm,
                                         Parameter::stratum_corneum_refractive_index,
                                         Parameter::fibre_refractive_index,
                                         Parameter::fibril_radius_nm,
                                         Parameter::scale,
                                         Parameter::specular_fraction};
    const Configuration configuration = solver_configuration(free);
    // Within the linear pieces of the tables, not at their corners.
    const std::vector<double> wavelengths_nm = {411.1, 433.3, 455.5, 477.7, 511.1, 544.9, 577.7, 611.1, 641.1};
    const Spectrum spectrum = spectrum_of(read_by_solver(make_experiment(configuration), wavelengths_nm));
    const FitProblem problem = make_problem(configuration, spectrum);
    const Objective objective(problem, AngularSolver(problem.only().experiment.sample(),
                                                     {.incidence_rad = problem.only().experiment.incidence_rad}));
    const std::vector<double> values = starts(problem);
    const auto reading = [&](const std::vector<double>& point) { return objective.model(point).reading; };
    const Eigen::MatrixXd jacobian = objective.model(values).jacobian;
    for (std::size_t i = 0; i < free.size(); ++i) {
        SCOPED_TRACE(info(free[i]).name);
        const double step = 1e-3 * values[i];
        const Eigen::VectorXd coarse = central_difference(reading, values, i, step);
        const Eigen::VectorXd fine = central_difference(reading, values, i, step / 2);
        const Eigen::VectorXd extrapolated = (4.0 * fine - coarse) / 3.0;
        // What the extrapolation changes bounds its error; rounding of a reading is far below 1e-13.
        const double error = (extrapolated - fine).cwiseAbs().maxCoeff() + 2e-13 / step;
        EXPECT_LE((extrapolated - jacobian.col(static_cast<Eigen::Index>(i))).cwiseAbs().maxCoeff(), error);
        EXPECT_GT(jacobian.col(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff(), 100.0 * error);
    }
}

TEST(SolverEngine, RecoversGeometryWithPigments) {
    Configuration truth = solver_configuration({});
    truth.values.skin.fibril_radius_nm = 28;
    truth.values.skin.papillary_dermis_thickness_cm = 0.025;
    truth.values.skin.melanosome_fraction = 0.03;
    const Spectrum spectrum = spectrum_of(read_by_solver(make_experiment(truth), grid_nm(400, 700, 10)));
    const Configuration start = solver_configuration(
        {Parameter::melanosome_fraction, Parameter::fibril_radius_nm, Parameter::papillary_dermis_thickness_cm});
    const FitResult result = fit_spectrum(start, spectrum, {.cross_check = false, .cache = no_cache()});
    // Ceres stops at a relative step of 1e-9 of the box; the noise of 0.006 makes sigmas a million times that.
    for (const FittedParameter& fitted : result.free) {
        ASSERT_TRUE(fitted.uncertainty.sigma.has_value()) << fitted.name;
        EXPECT_LT(std::abs(fitted.value - value_of(truth.values, fitted.parameter)), 1e-3 * *fitted.uncertainty.sigma)
            << fitted.name;
        EXPECT_EQ(*fitted.uncertainty.monte_carlo_sigma, 0.0);
    }
}

TEST(SolverEngine, ExplainsTheWalkToWithinItsNoise) {
    Configuration truth = solver_configuration({});
    truth.values.skin.melanosome_fraction = 0.02;
    std::vector<Reading> walked;
    std::vector<double> sigma;
    // Each wavelength has random numbers of its own: the errors are independent, as chi2 supposes.
    for (const double wavelength_nm : grid_nm(400, 700, 20)) {
        const auto seed = static_cast<std::uint64_t>(wavelength_nm);
        walked.push_back(read_by_walk(make_experiment(truth), {wavelength_nm}, 200'000, seed).front());
        sigma.push_back(walked.back().reflectance_se);
    }
    Spectrum spectrum = spectrum_of(walked);
    spectrum.sigma = sigma;
    const Configuration start = solver_configuration(
        {Parameter::melanosome_fraction, Parameter::papillary_blood_fraction, Parameter::reticular_blood_fraction});
    const FitResult result = fit_spectrum(start, spectrum, {.cross_check = false, .cache = no_cache()});
    ASSERT_TRUE(result.p_value.has_value());
    EXPECT_GT(*result.p_value, 1e-6);
    for (double& value : spectrum.value) value *= 1.02;  // an error of 2 % is seen, since the scale is fixed
    const FitResult wrong = fit_spectrum(start, spectrum, {.cross_check = false, .cache = no_cache()});
    const auto off = [&](Parameter parameter) {
        const FittedParameter& fitted = *std::ranges::find(wrong.free, parameter, &FittedParameter::parameter);
        return std::abs(fitted.value - value_of(truth.values, parameter)) >
               5.0 * fitted.uncertainty.sigma.value_or(0.0);
    };
    EXPECT_TRUE(*wrong.p_value < 1e-6 || off(Parameter::melanosome_fraction));
}

}  // namespace
}  // namespace skinfit::test
