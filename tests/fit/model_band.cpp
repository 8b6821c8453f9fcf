#include "fit/model_band.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

/// The limit of a 95 % interval in standard deviations.
const double sigmas = boost::math::quantile(boost::math::normal(), 0.975);

/// A fit that ended where it began, at the truth, and its band.
struct Fitted {
    Configuration configuration;
    Task task;
    Inference inference;

    explicit Fitted(const Configuration& truth)
        : configuration(truth),
          task(truth, modelled_spectrum(truth, grid_nm(400, 700, 20))),
          inference(infer(task.objective, {.values = starts(task.problem), .termination = {}},
                          UncertaintyMethod::covariance, truth.seed)) {}

    [[nodiscard]] std::vector<Bounds> band() const { return model_band(task.objective, inference); }
    [[nodiscard]] const std::vector<double>& sigma() const { return task.problem.only().sigma; }
};

double half_width(const Bounds& interval) {
    return (interval.upper - interval.lower) / 2;
}

/// The number of directions in which the readings can vary: the sum of their variances over those of the noise.
double trace(const Fitted& fitted) {
    const std::vector<Bounds> band = fitted.band();
    double sum = 0.0;
    for (std::size_t i = 0; i < band.size(); ++i) {
        sum += std::pow(half_width(band[i]) / sigmas / fitted.sigma()[i], 2);
    }
    return sum;
}

constexpr double rounding = 1e-8;

TEST(ModelBand, OfAnOffsetIsThatOfAMean) {
    const Fitted fitted(with_free(quick_configuration(), {Parameter::offset}));
    const std::vector<Bounds> band = fitted.band();
    const double root_of_count = std::sqrt(static_cast<double>(band.size()));
    for (std::size_t i = 0; i < band.size(); ++i) {
        EXPECT_NEAR(half_width(band[i]), sigmas * fitted.sigma()[i] / root_of_count, rounding);
    }
}

TEST(ModelBand, HasATraceOfTheNumberOfFreeParameters) {
    EXPECT_NEAR(trace(Fitted(quick_configuration())), 5.0, rounding);
}

TEST(ModelBand, IgnoresAParameterThatIsHeldAtItsBound) {
    for (const Status status : {Status::at_lower_bound, Status::at_upper_bound}) {
        Fitted fitted(quick_configuration());
        fitted.inference.uncertainty.parameters.front().status = status;
        EXPECT_NEAR(trace(fitted), 4.0, rounding);
    }
}

TEST(ModelBand, IsNotWidenedByWhatTheReadingsDoNotKnow) {
    Configuration configuration =
        with_free(quick_configuration(), {Parameter::melanosome_fraction, Parameter::oxygen_saturation});
    EXPECT_NEAR(trace(Fitted(configuration)), 2.0, rounding);
    configuration.values.skin.papillary_blood_fraction = 0.0;  // without blood nothing tells its saturation
    configuration.values.skin.reticular_blood_fraction = 0.0;
    EXPECT_NEAR(trace(Fitted(configuration)), 1.0, rounding);
}

TEST(ModelBand, OfAPosteriorIsThatOfItsDraws) {
    constexpr int draws = 4000;
    Fitted fitted(with_free(quick_configuration(), {Parameter::offset}));
    Posterior posterior{};
    posterior.draws = Eigen::RowVectorXd::LinSpaced(draws, 0.0, 0.01);
    fitted.inference.posterior = posterior;
    const Eigen::VectorXd reading = fitted.task.objective.readings(std::vector<double>{0.0});
    const double step = 0.01 / (draws - 1);
    // Every tenth draw is taken: 0, 10, ... 3990.
    const std::vector<Bounds> band = fitted.band();
    for (std::size_t i = 0; i < band.size(); ++i) {
        const double base = reading[static_cast<Eigen::Index>(i)];
        EXPECT_NEAR(band[i].lower, base + 0.025 * 3990 * step, rounding);
        EXPECT_NEAR(band[i].upper, base + 0.975 * 3990 * step, rounding);
    }
}

}  // namespace
}  // namespace skinfit::test
