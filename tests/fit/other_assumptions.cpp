#include "fit/other_assumptions.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fit/fit.hpp"
#include "fit/left_out_bands.hpp"
#include "fit/noise_model.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

constexpr double noise = 0.002;

Configuration pigments() {
    return with_free(inner_truth(noise), {Parameter::melanosome_fraction, Parameter::papillary_blood_fraction,
                                          Parameter::oxygen_saturation});
}

/// What the model of `truth` reads, with noise of `sigma`.
Spectrum noisy(const Configuration& truth, double sigma) {
    Spectrum spectrum = modelled_spectrum(truth, grid_nm(400, 690, 10));
    const std::vector<double> normal = normal_numbers(5, spectrum.value.size());
    for (std::size_t i = 0; i < spectrum.value.size(); ++i) spectrum.value[i] += sigma * normal[i];
    return spectrum;
}

/// The predictions of each band of 30 nm from fits that have not seen it.
double refitted_left_out_rmse(const Configuration& configuration, const Spectrum& spectrum) {
    const Task whole(configuration, spectrum);
    double squares = 0.0;
    for (double first = 400; first < 700; first += 30) {
        Configuration without = configuration;
        without.exclude_nm.push_back({first, first + 25});
        const Task task(without, spectrum);
        const Minimum minimum = minimise_by_ceres(task.objective, starts(task.problem));
        const Eigen::VectorXd reading = whole.objective.readings(minimum.values);
        const Measurement& measured = whole.problem.only();
        std::vector<Eigen::Index> seen;
        std::vector<Eigen::Index> unseen;
        Eigen::VectorXd difference(reading.size());
        for (Eigen::Index i = 0; i < reading.size(); ++i) {
            const auto place = static_cast<std::size_t>(i);
            difference[i] = reading[i] - measured.measured[place];
            const double nm = measured.wavelength_nm[place];
            (nm >= first && nm < first + 30 ? unseen : seen).push_back(i);
        }
        const Eigen::MatrixXd covariance =
            covariance_of(measured.wavelength_nm, measured.sigma, whole.problem.discrepancy);
        const Eigen::MatrixXd weights = covariance(unseen, seen) * Eigen::MatrixXd(covariance(seen, seen)).inverse();
        squares += (difference(unseen) - weights * difference(seen)).squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(spectrum.value.size()));
}

/// How far the linearised prediction lies from that of fits that have not seen the band, where noise and departure are
/// `size` times theirs.
double linearisation_error(bool departs, double size) {
    Configuration configuration = pigments();
    configuration.noise = size * noise;
    if (departs) configuration.discrepancy = Discrepancy{.sigma = 2.0 * size * noise, .length_nm = 40};
    const Spectrum spectrum = noisy(configuration, size * noise);
    const Task task(configuration, spectrum);
    const Minimum minimum = minimise_by_ceres(task.objective, starts(task.problem));
    const double refitted = refitted_left_out_rmse(configuration, spectrum);
    EXPECT_GT(refitted, 0.5 * size * noise);
    return std::abs(left_out_rmse(task.objective, minimum.values) / refitted - 1.0);
}

TEST(LeftOutBands, AreThoseOfFitsThatHaveNotSeenThemButForTheSquareOfWhatTheyMove) {
    for (const bool departs : {false, true}) {
        // Relative to the error, which grows as the noise does, the square of the noise is left: a tenth is a tenth.
        const double whole = linearisation_error(departs, 1.0);
        EXPECT_LT(linearisation_error(departs, 0.1), 0.2 * whole) << departs;
        EXPECT_GT(whole, 0.0);
    }
}

const OtherAssumptions::Alternative& called(const OtherAssumptions& others, std::string_view assumption) {
    return *std::ranges::find(others.alternatives, assumption, &OtherAssumptions::Alternative::assumption);
}

TEST(OtherAssumptions, AScaleThatIsThereIsFoundAndMakesTheFitSuspect) {
    Configuration truth = pigments();
    truth.values.instrument.scale = 1.1;
    Configuration configuration = pigments();
    const FitResult wrong = fit_spectrum(configuration, noisy(truth, noise), {.cache = no_cache()});
    ASSERT_TRUE(wrong.other_assumptions);
    const OtherAssumptions::Alternative& scaled = called(*wrong.other_assumptions, "scale free");
    EXPECT_LT(scaled.left_out_rmse, wrong.other_assumptions->left_out_rmse);
    EXPECT_FALSE(answers_moved(*wrong.other_assumptions, scaled).empty());
    EXPECT_EQ(wrong.verdict, Verdict::suspect);
    const bool said = std::ranges::any_of(wrong.reasons, [](const std::string& reason) {
        return reason.starts_with("DEPENDS ON AN ASSUMPTION: with scale free");
    });
    EXPECT_TRUE(said);
    const FitResult right = fit_spectrum(truth, noisy(truth, noise), {.cache = no_cache()});
    EXPECT_TRUE(answers_moved(*right.other_assumptions, called(*right.other_assumptions, "scale free")).empty());
}

TEST(OtherAssumptions, AreThoseThatTheFitDoesNotMakeItself) {
    const auto names = [](const Configuration& configuration) {
        const FitResult result = fit_spectrum(configuration, noisy(pigments(), noise), {.cache = no_cache()});
        std::vector<std::string> words;
        for (const OtherAssumptions::Alternative& each : result.other_assumptions->alternatives) {
            words.push_back(each.assumption);
        }
        return words;
    };
    Configuration configuration = pigments();
    configuration.specular.reset();
    EXPECT_EQ(names(configuration), (std::vector<std::string>{"scale free", "offset free", "specular excluded",
                                                              "hemoglobin of [BOSSCHAART14]", "melanin_slope free",
                                                              "lateral_loss_per_cm free"}));
    configuration = with_free(configuration, {Parameter::melanosome_fraction, Parameter::oxygen_saturation,
                                              Parameter::scale, Parameter::melanin_slope});
    configuration.specular = Specular::included;
    configuration.values.skin.whole_blood_share = 1.0;
    EXPECT_EQ(names(configuration), (std::vector<std::string>{"offset free", "hemoglobin of [PRAHL98]",
                                                              "melanin_slope 0", "lateral_loss_per_cm free"}));
}

}  // namespace
}  // namespace skinfit::test
