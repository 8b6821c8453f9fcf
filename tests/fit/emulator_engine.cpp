#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>

#include "core/input_error.hpp"
#include "fit/bulk.hpp"
#include "fit/emulation.hpp"
#include "fit/fit.hpp"
#include "fit/fit_scale.hpp"
#include "fit/identifiability.hpp"
#include "fit/lean_model.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

Configuration emulator_configuration(const std::vector<Parameter>& free) {
    return tilted(default_configuration(), Engine::emulator, free);
}

const std::vector<Parameter> pigments = {Parameter::melanosome_fraction, Parameter::papillary_blood_fraction,
                                         Parameter::reticular_blood_fraction, Parameter::oxygen_saturation,
                                         Parameter::bilirubin_g_per_l};

/// What the solver reads for `truth`, with noise of `sigma`.
Spectrum noisy_spectrum(const Configuration& truth, double sigma, std::uint64_t seed) {
    Spectrum spectrum;
    spectrum.name = "synthetic";
    spectrum.source = "synthetic";
    spectrum.wavelength_nm = grid_nm(400, 700, 10);
    const std::vector<double> normal = normal_numbers(seed, spectrum.wavelength_nm.size());
    for (const Reading& reading : read_by_solver(make_experiment(truth), spectrum.wavelength_nm)) {
        spectrum.value.push_back(reading.reflectance + sigma * normal[spectrum.value.size()]);
    }
    return spectrum;
}

/// Specimen `number` of a low-discrepancy sequence over ranges of living skin.
Configuration specimen(Configuration configuration, int number) {
    Skin& skin = configuration.values.skin;
    const auto place = [&](int dimension) {
        const double turns = number * std::sqrt(dimension);
        return turns - std::floor(turns);
    };
    skin.melanosome_fraction = std::lerp(0.005, 0.25, std::pow(place(2), 2.0));
    skin.papillary_blood_fraction = std::lerp(0.002, 0.1, std::pow(place(3), 2.0));
    skin.reticular_blood_fraction = std::lerp(0.002, 0.1, std::pow(place(5), 2.0));
    skin.oxygen_saturation = place(7);
    skin.bilirubin_g_per_l = 2.0 * place(11);
    return configuration;
}

TEST(EmulatorEngine, ObjectiveJacobianEqualsDifferences) {
    std::vector<Parameter> free = pigments;
    for (const Parameter parameter : {Parameter::epidermis_thickness_cm, Parameter::stratum_corneum_carotene_g_per_l,
                                      Parameter::scale, Parameter::offset, Parameter::specular_fraction}) {
        free.push_back(parameter);
    }
    const Configuration configuration = emulator_configuration(free);
    const FitProblem problem = make_problem(configuration, noisy_spectrum(configuration, 0.0, 1));
    const Emulator emulator = Emulator::build(emulator_domain(problem));
    const Objective objective(problem, emulator);
    const std::vector<double> values = starts(problem);
    const auto reading = [&](const std::vector<double>& point) { return objective.model(point).reading; };
    const Objective::Modelled at = objective.model(values);
    const LeanModel::Modelled lean = LeanModel(problem, emulator).at(to_unit_box(problem, values));
    const std::vector<double> slopes = unit_box_slopes(problem, to_unit_box(problem, values));
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
        SCOPED_TRACE(info(problem.free[i].parameter).name);
        const auto column = static_cast<Eigen::Index>(i);
        const double step = 1e-3 * values[i];
        const Eigen::VectorXd fine = central_difference(reading, values, i, step);
        const Eigen::VectorXd coarse = central_difference(reading, values, i, 2.0 * step);
        // The truncation error of a central difference is a third of its change when the step doubles.
        const double error = (coarse - fine).cwiseAbs().maxCoeff() + 1e-13 / step;
        EXPECT_LE((fine - at.jacobian.col(column)).cwiseAbs().maxCoeff(), error);
        EXPECT_GT(at.jacobian.col(column).cwiseAbs().maxCoeff(), 100.0 * error);
        const double largest = lean.jacobian.col(column).cwiseAbs().maxCoeff();
        for (Eigen::Index row = 0; row < lean.reading.size(); ++row) {
            const double sigma = problem.only().sigma[static_cast<std::size_t>(row)];
            EXPECT_NEAR(lean.reading[row] * sigma, at.reading[row], 1e-14);
            EXPECT_NEAR(lean.jacobian(row, column), at.jacobian(row, column) * slopes[i] / sigma, 1e-12 * largest);
        }
    }
}

TEST(EmulatorEngine, FitsAsTheSolverDoes) {
    for (int number = 1; number <= 5; ++number) {
        Configuration configuration = emulator_configuration(pigments);
        const Spectrum spectrum =
            noisy_spectrum(specimen(configuration, number), default_noise, static_cast<std::uint64_t>(number));
        const FitResult emulated = fit_spectrum(configuration, spectrum, {.cache = no_cache()});
        configuration.engine = Engine::solver;
        const FitResult solved = fit_spectrum(configuration, spectrum, {.cache = no_cache()});
        ASSERT_TRUE(emulated.emulator_error.has_value());
        EXPECT_FALSE(solved.emulator_error.has_value());
        EXPECT_LE(largest_difference_in_sigmas(emulated, solved.answer.minimum).value_or(0.0), 0.01) << number;
    }
}

/// But the radius of the fibrils, which steers too: the answer is the solver's.
TEST(EmulatorEngine, AdjustsTheFibrilRadius) {
    Configuration configuration =
        emulator_configuration({Parameter::melanosome_fraction, Parameter::papillary_blood_fraction,
                                Parameter::reticular_blood_fraction, Parameter::fibril_radius_nm});
    configuration.bounds[static_cast<std::size_t>(Parameter::fibril_radius_nm)] = {15, 40};
    Configuration truth = configuration;
    truth.values.skin.fibril_radius_nm = 21;
    const Spectrum spectrum = noisy_spectrum(truth, 0.001, 1);
    configuration.noise = 0.001;
    const FitResult emulated = fit_spectrum(configuration, spectrum, {.cache = no_cache()});
    EXPECT_LE(emulated.emulator_error.value(), 0.0005);
    configuration.engine = Engine::solver;
    const FitResult solved = fit_spectrum(configuration, spectrum, {.cache = no_cache()});
    EXPECT_LE(largest_difference_in_sigmas(emulated, solved.answer.minimum).value_or(0.0), 0.1);
    const FittedParameter& radius = emulated.free.back();
    ASSERT_EQ(radius.parameter, Parameter::fibril_radius_nm);
    constexpr double sigmas = 4.9;  // a millionth of the normal law lies beyond
    EXPECT_NEAR(radius.value, 21, sigmas * radius.uncertainty.sigma.value());
}

TEST(EmulatorEngine, RefusesParametersThatSteer) {
    const Configuration configuration = emulator_configuration({Parameter::epidermis_refractive_index});
    try {
        (void)make_problem(configuration, noisy_spectrum(configuration, 0.0, 1));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("engine=solver"), std::string::npos) << error.what();
    }
}

/// Many noisy spectra of one problem.
struct Bulk {
    static constexpr int count = 200;
    Configuration configuration = emulator_configuration(pigments);
    FitProblem problem = make_problem(configuration, noisy_spectrum(configuration, 0.0, 1));
    Emulator emulator = Emulator::build(emulator_domain(problem));
    std::vector<Spectrum> spectra;
    Eigen::MatrixXd matrix{static_cast<Eigen::Index>(problem.only().wavelength_nm.size()), count};

    Bulk() {
        for (int number = 1; number <= count; ++number) {
            Spectrum spectrum;
            spectrum.name = spectrum.source = "synthetic";
            spectrum.wavelength_nm = problem.only().wavelength_nm;
            const std::vector<double> normal =
                normal_numbers(static_cast<std::uint64_t>(number), problem.only().wavelength_nm.size());
            const Experiment experiment = make_experiment(specimen(configuration, number));
            for (const Reading& reading :
                 read_by_emulator(experiment, problem.only().wavelength_nm, emulator, std::nullopt)) {
                spectrum.value.push_back(reading.reflectance + default_noise * normal[spectrum.value.size()]);
            }
            matrix.col(number - 1) =
                Eigen::Map<const Eigen::VectorXd>(spectrum.value.data(), static_cast<Eigen::Index>(normal.size()));
            spectra.push_back(spectrum);
        }
    }
};

TEST(FitInBulk, EndsWhereTheSingleFitEnds) {
    const Bulk bulk;
    const std::vector<BulkFit> fits = fit_in_bulk(bulk.problem, bulk.emulator, bulk.matrix);
    int same = 0;
    int higher = 0;
    int not_converged = 0;
    int unknown = 0;
    for (std::size_t i = 0; i < fits.size(); ++i) {
        SCOPED_TRACE(i);
        FitProblem problem = bulk.problem;
        problem.only().measured = bulk.spectra[i].value;
        const Objective objective(problem, bulk.emulator);
        const Minimum minimum = minimise_by_ceres(objective, starts(problem));
        const Uncertainty uncertainty = estimate_uncertainty(objective, minimum);
        not_converged += fits[i].converged ? 0 : 1;
        // A difference of 1e-5 of chi2 is another minimum: steps below 1e-3 sigma change chi2 by 1e-6.
        const double difference = fits[i].chi2 - minimum.chi2;
        higher += difference > 1e-5 * minimum.chi2 ? 1 : 0;
        if (std::abs(difference) > 1e-5 * minimum.chi2) continue;
        ++same;
        for (std::size_t j = 0; j < problem.free.size(); ++j) {
            const ParameterUncertainty& single = uncertainty.parameters[j];
            const auto column = static_cast<Eigen::Index>(j);
            const bool at_bound = fits[i].covariance(column, column) == 0.0;
            const double in_priors =
                std::sqrt(fits[i].covariance(column, column)) / prior_step(problem.free[j], fits[i].values[j]);
            // Both are called so where the bounds say as much; the sigmas agree within a part in a hundred.
            if (!at_bound && std::abs(in_priors - 1.0) > 0.01) {
                unknown += single.status == Status::not_identifiable ? 1 : 0;
                EXPECT_EQ(fits[i].statuses[j] == Status::not_identifiable, single.status == Status::not_identifiable);
            }
            if (!single.sigma) continue;
            EXPECT_EQ(fits[i].statuses[j], Status::free);
            EXPECT_NEAR(fits[i].values[j], minimum.values[j], 0.01 * *single.sigma);
            EXPECT_NEAR(std::sqrt(fits[i].covariance(column, column)), *single.sigma, 0.01 * *single.sigma);
        }
    }
    // A tenth of the single fits end in a higher minimum than the lowest; few of those in bulk do.
    EXPECT_GE(same, Bulk::count * 8 / 10);
    EXPECT_LE(higher, Bulk::count / 20);
    EXPECT_LE(not_converged, Bulk::count / 20);
    EXPECT_GT(unknown, 0);
    std::printf("same minimum %d, bulk higher %d, not converged %d of %d\n", same, higher, not_converged, Bulk::count);
}

TEST(FitInBulk, GivesTheSameBitsOnAnyNumberOfThreads) {
    const Bulk bulk;
    const std::vector<BulkFit> many = fit_in_bulk(bulk.problem, bulk.emulator, bulk.matrix);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const std::vector<BulkFit> single = fit_in_bulk(bulk.problem, bulk.emulator, bulk.matrix);
    for (std::size_t i = 0; i < many.size(); ++i) {
        EXPECT_EQ(many[i].values, single[i].values);
        EXPECT_EQ(many[i].covariance, single[i].covariance);
    }
}

TEST(FitInBulk, HoldsParametersAtTheirBounds) {
    const Bulk bulk;
    // Brighter than any skin without melanosomes and blood can be: everything that absorbs is pressed to zero.
    const Eigen::MatrixXd bright = Eigen::MatrixXd::Constant(bulk.matrix.rows(), 1, 0.9);
    const BulkFit fit = fit_in_bulk(bulk.problem, bulk.emulator, bright).front();
    EXPECT_TRUE(fit.converged);
    EXPECT_EQ(fit.statuses[0], Status::at_lower_bound);
    EXPECT_EQ(fit.values[0], 0.0);
    EXPECT_EQ(fit.covariance(0, 0), 0.0);
}

TEST(FitInBulk, SpectraThatAreNoNumbersEndWithoutAFitAndLeaveTheOthersAlone) {
    const Bulk bulk;
    Eigen::MatrixXd spectra = bulk.matrix.leftCols(4);
    spectra(0, 1) = std::numeric_limits<double>::quiet_NaN();
    spectra(5, 2) = std::numeric_limits<double>::infinity();
    spectra.col(3).setConstant(1e200);  // chi2 overflows
    const std::vector<BulkFit> fits = fit_in_bulk(bulk.problem, bulk.emulator, spectra);
    EXPECT_EQ(fits[0].values, fit_in_bulk(bulk.problem, bulk.emulator, spectra.leftCols(1)).front().values);
    for (const std::size_t i : {1U, 2U, 3U}) {
        EXPECT_FALSE(fits[i].converged);
        EXPECT_FALSE(std::isfinite(fits[i].chi2));
    }
}

TEST(FitInBulk, RefusesWhatIsNoPlainSumOfSquares) {
    const Bulk bulk;
    const auto expect_refusal = [&](const std::string& where, const auto& change) {
        FitProblem problem = bulk.problem;
        change(problem);
        try {
            (void)fit_in_bulk(problem, bulk.emulator, bulk.matrix);
            FAIL() << where;
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find(where), 0U) << error.what();
        }
    };
    expect_refusal("loss", [](FitProblem& problem) { problem.loss = Loss::huber; });
    expect_refusal("weights",
                   [](FitProblem& problem) { problem.only().weight.assign(problem.only().sigma.size(), 2.0); });
    expect_refusal("discrepancy", [](FitProblem& problem) { problem.discrepancy = Discrepancy{}; });
    expect_refusal("priors", [](FitProblem& problem) { problem.free[0].prior = Prior{}; });
    expect_refusal("priors", [](FitProblem& problem) { problem.derived_priors.emplace_back(); });
}

}  // namespace
}  // namespace skinfit::test
