#include "fit/viewing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/input_error.hpp"
#include "fit/fit.hpp"
#include "fit/sensitivity.hpp"
#include "model/constants.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit::test {
namespace {

Configuration cone_configuration() {
    Configuration configuration = default_configuration();
    configuration.engine = Engine::solver;
    configuration.viewing_cone_deg = 5;
    return as_stated(resolved(configuration));
}

TEST(ViewingCone, DefaultsToTheGeometryOf45_0) {
    const Configuration configuration = cone_configuration();
    EXPECT_NO_THROW(check_viewing_cone(resolved(configuration)));
    EXPECT_EQ(configuration.incidence_deg, 45.0);
    EXPECT_EQ(configuration.specular, Specular::excluded);
    const Experiment experiment = make_experiment(configuration);
    EXPECT_DOUBLE_EQ(experiment.viewing_cone_rad.value(), 5 * rad_per_deg);
    EXPECT_EQ(reading_law(experiment, Quantity::reflectance).surface_weight, 0.0);
}

TEST(ViewingCone, IsTakenFromTheFileUnlessSet) {
    Spectrum spectrum;
    spectrum.geometry = {.incidence_deg = 40, .specular = Specular::excluded, .viewing_cone_deg = 7};
    EXPECT_EQ(resolved(default_configuration(), spectrum).viewing_cone_deg, 7.0);
    EXPECT_EQ(resolved(default_configuration(), spectrum).incidence_deg, 40.0);
    Configuration set = default_configuration();
    set.viewing_cone_deg = 3;
    EXPECT_EQ(resolved(set, spectrum).viewing_cone_deg, 3.0);
    EXPECT_EQ(resolved(default_configuration(), Spectrum{}).viewing_cone_deg, std::nullopt);
}

TEST(ViewingCone, IsRefusedWhereItMeansNothing) {
    const auto with = [](auto change) {
        Configuration configuration = cone_configuration();
        change(configuration);
        return configuration;
    };
    const std::vector<Configuration> bad = {
        with([](Configuration& c) { c.engine = Engine::paths; }),
        with([](Configuration& c) { c.engine = Engine::emulator; }),
        with([](Configuration& c) { c.quantity = Quantity::transmittance; }),
        with([](Configuration& c) { c.specular = Specular::included; }),
        with([](Configuration& c) { c.values.instrument.specular_fraction = 0.1; }),
        with([](Configuration& c) { c.free[static_cast<std::size_t>(Parameter::specular_fraction)] = true; }),
    };
    for (const Configuration& configuration : bad)
        EXPECT_THROW(check_viewing_cone(resolved(configuration)), InputError);
    EXPECT_NO_THROW(check_viewing_cone(resolved(with([](Configuration& c) { c.engine = Engine::walk; }))));
    EXPECT_NO_THROW(check_viewing_cone(resolved(default_configuration())));
}

TEST(ViewingCone, SurfaceParametersHaveNoEffect) {
    Configuration configuration = cone_configuration();
    configuration.wavelengths = "450,650";
    const Sensitivity result = sensitivity(configuration);
    EXPECT_EQ(std::ranges::count(result.without_effect, Parameter::specular_fraction), 1);
    EXPECT_EQ(std::ranges::count(result.parameters, Parameter::stratum_corneum_refractive_index), 1);
    EXPECT_NE(sensitivity_csv(result, Derivative::per_unit).find("# viewing_cone_deg: 5\n"), std::string::npos);
}

TEST(ViewingCone, TheFitFindsWhatWasSeenThroughIt) {
    Configuration truth = cone_configuration();
    truth.values.skin.melanosome_fraction = 0.03;
    truth.values.skin.fibril_radius_nm = 28;
    Spectrum spectrum{.name = "seen",
                      .source = "seen.csv",
                      .wavelength_nm = grid_nm(400, 700, 10),
                      .value = {},
                      .sigma = {},
                      .quantity = Quantity::reflectance,
                      .geometry = {},
                      .unit_rule = "as computed"};
    for (const Reading& reading : read_by_solver(make_experiment(truth), spectrum.wavelength_nm)) {
        spectrum.value.push_back(reading.reflectance);
    }
    const Configuration start =
        with_free(cone_configuration(), {Parameter::melanosome_fraction, Parameter::fibril_radius_nm});
    const FitResult result = fit_spectrum(start, spectrum, {.cross_check = false, .cache = no_cache()});
    for (const FittedParameter& fitted : result.free) {
        // Ceres stops at a relative step of 1e-9 of the box; the noise of 0.006 makes sigmas a million times that.
        EXPECT_LT(std::abs(fitted.value - value_of(truth.values, fitted.parameter)),
                  1e-3 * fitted.uncertainty.sigma.value())
            << fitted.name;
    }
    Configuration hemisphere = start;
    hemisphere.viewing_cone_deg = 90;
    const FitResult other = fit_spectrum(hemisphere, spectrum, {.cross_check = false, .cache = no_cache()});
    EXPECT_GT(other.rmse, 1000.0 * result.rmse);
}

}  // namespace
}  // namespace skinfit::test
