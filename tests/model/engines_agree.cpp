#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "model/angular_error.hpp"
#include "model/chromophores.hpp"
#include "model/constants.hpp"
#include "model/emulator.hpp"
#include "model/parameters.hpp"
#include "model/viewing_cone.hpp"
#include "tests/support/statistics.hpp"

/// The angular solver and its emulator against the analog walk, over all that the parameter table, the incidence, the
/// bases, the editions and the wavelengths allow: they agree within the errors that they state.
namespace skinfit {
namespace {

constexpr int specimen_count = 300;
constexpr std::uint64_t rays = 300'000;

struct Specimen {
    Sample sample;
    double incidence_rad;
    double wavelength_nm;
    std::vector<ParameterRange> ranges;  // of an emulator that stands for the specimen among others

    [[nodiscard]] std::string words() const {
        const PerLayer<double> index = refractive_index(sample.skin);
        return fmt::format(
            "{} layers, {}, base {} of {:.3f}, indices {:.3f} {:.3f} {:.3f} {:.3f}, {:.2f} degrees, {:.1f} nm",
            sample.layers, edition_names[static_cast<std::size_t>(sample.edition)], static_cast<int>(sample.base.kind),
            sample.base.refractive_index, index[0], index[1], index[2], index[3], incidence_rad / rad_per_deg,
            wavelength_nm);
    }
};

class Draw {
public:
    explicit Draw(std::uint64_t seed) : engine_(seed) {}

    Specimen specimen() {
        ParameterValues values;
        Specimen drawn{};
        for (const ParameterInfo& row : parameter_table()) {
            if (belongs_to_instrument(row.parameter)) continue;
            value_of(values, row.parameter) = within(row.lowest, row.highest);
            if (!row.steers) drawn.ranges.push_back({row.parameter, row.lowest, value_of(values, row.parameter)});
        }
        drawn.sample = {.skin = values.skin,
                        .edition = uniform() < 0.5 ? Edition::printed : Edition::revised,
                        .layers = uniform() < 0.5 ? 2 : 4,
                        .base = base()};
        // Light that grazes is met as often as all other.
        const double most = incidence_range_deg.highest;
        drawn.incidence_rad = (uniform() < 0.5 ? most * uniform() : most - 15.0 * std::pow(uniform(), 2)) * rad_per_deg;
        drawn.wavelength_nm = std::lerp(modelled_wavelengths().lowest_nm, modelled_wavelengths().highest_nm, uniform());
        return drawn;
    }

private:
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

    /// A fifth lies on a limit; where the limits span decades, or begin at 0, half lies evenly over the decades.
    double within(double lowest, double highest) {
        const double place = uniform();
        const double at = uniform();
        if (place < 0.2) return place < 0.1 ? lowest : highest;
        const double least = lowest > 0.0 ? lowest : 1e-4 * highest;
        if (highest > 10.0 * least && at < 0.5) return least * std::pow(highest / least, uniform());
        return std::lerp(lowest, highest, uniform());
    }

    Base base() {
        const double kind = uniform();
        if (kind < 1.0 / 3.0) return {};
        if (kind < 2.0 / 3.0) return {.kind = Base::Kind::matched};
        return {.kind = Base::Kind::index, .refractive_index = within(1.0, 2.0)};
    }

    std::mt19937_64 engine_;
};

/// A share as an engine states it.
struct Stated {
    double share;
    double error;
};

/// The chance of a count as far from `rays` times the share as `count`, for the nearest share that the error allows:
/// exact binomial tails, so that rare kinds of light are judged as they scatter.
double p_value(std::uint64_t count, const Stated& stated) {
    const auto k = static_cast<double>(count);
    const double n = rays;
    const double highest = std::clamp(stated.share + stated.error, 0.0, 1.0);
    const double lowest = std::clamp(stated.share - stated.error, 0.0, 1.0);
    const double as_many = count == 0 ? 1.0 : boost::math::ibeta(k, n - k + 1.0, highest);
    const double as_few = count == rays ? 1.0 : boost::math::ibetac(k + 1.0, n - k, lowest);
    return std::min(1.0, 2.0 * std::min(as_many, as_few));
}

struct Compared {
    Specimen specimen;
    WalkCounts walk;
    Stated reflected;
    Stated transmitted;
};

std::vector<Compared> compared(const AngularResolution& resolution, bool states_errors) {
    Draw draw(20);
    std::vector<Compared> all;
    for (int i = 0; i < specimen_count; ++i)
        all.push_back({.specimen = draw.specimen(), .walk = {}, .reflected = {}, .transmitted = {}});
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
        Compared& one = all[i];
        const Specimen& specimen = one.specimen;
        one.walk = random_walk(specimen.sample, {specimen.wavelength_nm},
                               {.incidence_rad = specimen.incidence_rad, .rays = rays, .seed = 1000 + i})
                       .front();
        const AngularSolver solver(specimen.sample,
                                   {.incidence_rad = specimen.incidence_rad, .resolution = resolution});
        const AngularResponse response = solver.shares(specimen.wavelength_nm);
        const SolverErrors errors =
            states_errors ? SolverErrorEstimate(solver).at(specimen.wavelength_nm) : SolverErrors{};
        one.reflected = {response.reflected.share, errors.reflected};
        one.transmitted = {response.transmitted.share, errors.transmitted};
    });
    return all;
}

/// The p-value of all by the worst of them (Bonferroni) and by their product (Fisher), of which the lesser counts
/// twice.
double family_p_value(const std::vector<double>& p_values) {
    const auto count = static_cast<double>(p_values.size());
    double logarithms = 0.0;
    double least = 1.0;
    for (const double p : p_values) {
        logarithms += std::log(std::max(p, 1e-300));
        least = std::min(least, p);
    }
    const double product = test::chi_square_p_value(-2.0 * logarithms, 2.0 * count);
    return std::min(1.0, 2.0 * std::min(count * least, product));
}

std::vector<double> p_values(const std::vector<Compared>& all) {
    std::vector<double> values;
    for (const Compared& one : all) {
        values.push_back(p_value(one.walk.subsurface_reflected, one.reflected));
        values.push_back(p_value(one.walk.transmitted, one.transmitted));
        if (std::min(values.back(), values[values.size() - 2]) < 1e-4) {
            std::printf("p %.1e: R %.5f by the walk, %.5f +/- %.5f; T %.5f, %.5f +/- %.5f; %s\n",
                        std::min(values.back(), values[values.size() - 2]),
                        static_cast<double>(one.walk.subsurface_reflected) / rays, one.reflected.share,
                        one.reflected.error, static_cast<double>(one.walk.transmitted) / rays, one.transmitted.share,
                        one.transmitted.error, one.specimen.words().c_str());
        }
    }
    return values;
}

double median_error(const std::vector<Compared>& all) {
    std::vector<double> errors;
    for (const Compared& one : all) errors.push_back(one.reflected.error);
    std::ranges::nth_element(errors, errors.begin() + specimen_count / 2);
    return errors[specimen_count / 2];
}

TEST(EnginesAgree, SolverAndWalkWithinWhatTheSolverStatesOverAllLimits) {
    const std::vector<Compared> all = compared(AngularResolution::for_accuracy(solver_accuracy), true);
    EXPECT_GT(family_p_value(p_values(all)), test::passing_p_value);
    // An error so large that nothing could contradict it would not do.
    EXPECT_LT(median_error(all), 2.0 * solver_accuracy);
}

TEST(EnginesAgree, LightThatEntersOnThePanelsOfTheLayersWithoutStatedErrorIsNoticed) {
    AngularResolution resolution = AngularResolution::for_accuracy(solver_accuracy);
    resolution.entry_panels = resolution.panels;
    EXPECT_LT(family_p_value(p_values(compared(resolution, false))), test::passing_p_value);
}

TEST(EnginesAgree, EmulatorAndWalkWithinTheCertificate) {
    Draw draw(21);
    constexpr int count = 24;
    std::vector<double> values;
    for (int i = 0; i < count; ++i) {
        const Specimen specimen = draw.specimen();
        const WalkCounts walk =
            random_walk(
                specimen.sample, {specimen.wavelength_nm},
                {.incidence_rad = specimen.incidence_rad, .rays = rays, .seed = 2000U + static_cast<unsigned>(i)})
                .front();
        for (const Side side : {Side::top, Side::bottom}) {
            const Emulator emulator = Emulator::build({.sample = specimen.sample,
                                                       .incidence_rad = specimen.incidence_rad,
                                                       .side = side,
                                                       .wavelengths_nm = {specimen.wavelength_nm},
                                                       .ranges = specimen.ranges});
            const PerLayer<double> depth =
                optical_depth(specimen.sample.skin, Extinction::at(specimen.wavelength_nm, specimen.sample.edition));
            const Stated stated{emulator.respond(std::vector{depth}).front().share, emulator.certified_error(0)};
            values.push_back(p_value(side == Side::top ? walk.subsurface_reflected : walk.transmitted, stated));
            if (values.back() < 1e-4) std::printf("p %.1e: %s\n", values.back(), specimen.words().c_str());
        }
    }
    EXPECT_GT(family_p_value(values), test::passing_p_value);
}

}  // namespace
}  // namespace skinfit
