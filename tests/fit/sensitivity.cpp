#include "fit/sensitivity.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/input_error.hpp"
#include "fit/problem.hpp"
#include "fit/wavelength_sets.hpp"

namespace skinfit {
namespace {

using Index = Eigen::Index;

/// Away from the values at which a factor is one or zero, and from the corners of the tables.
Configuration configuration_of(Quantity quantity) {
    Configuration configuration = default_configuration();
    configuration.quantity = quantity;
    configuration.incidence_deg = 30;
    configuration.specular = Specular::excluded;
    if (quantity == Quantity::transmittance) configuration.base = Base{.kind = Base::Kind::matched};
    configuration.wavelengths = "433.3,544.9,641.1";
    configuration.values.instrument = {.scale = 1.1, .offset = 0.01, .specular_fraction = 0.3};
    return configuration;
}

Eigen::VectorXd readings(const Configuration& configuration) {
    const std::vector<double> wavelengths_nm = parse_wavelengths(configuration.wavelengths, "test");
    const std::vector<Reading> spectrum = read_by_solver(make_experiment(configuration), wavelengths_nm);
    Eigen::VectorXd values(static_cast<Index>(spectrum.size()));
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
        const bool reflected = configuration.quantity == Quantity::reflectance;
        values[static_cast<Index>(i)] = reflected ? spectrum[i].reflectance : spectrum[i].transmittance;
    }
    return values;
}

Eigen::VectorXd central_difference(const Configuration& configuration, Parameter parameter, double step) {
    Configuration above = configuration;
    Configuration below = configuration;
    value_of(above.values, parameter) += step;
    value_of(below.values, parameter) -= step;
    return (readings(above) - readings(below)) / (2.0 * step);
}

Index column_of(const Sensitivity& table, Parameter parameter) {
    const auto found = std::ranges::find(table.parameters, parameter);
    EXPECT_NE(found, table.parameters.end()) << info(parameter).name;
    return found - table.parameters.begin();
}

void expect_differences(Quantity quantity, const std::vector<Parameter>& parameters) {
    const Configuration configuration = configuration_of(quantity);
    const Sensitivity table = sensitivity(configuration);
    for (const Parameter parameter : parameters) {
        SCOPED_TRACE(info(parameter).name);
        const double step = 1e-3 * value_of(configuration.values, parameter);
        const Eigen::VectorXd coarse = central_difference(configuration, parameter, step);
        const Eigen::VectorXd fine = central_difference(configuration, parameter, step / 2);
        const Eigen::VectorXd extrapolated = (4.0 * fine - coarse) / 3.0;
        // What the extrapolation changes bounds its error; rounding of a reading is far below 1e-13.
        const double error = (extrapolated - fine).cwiseAbs().maxCoeff() + 2e-13 / step;
        const Eigen::VectorXd exact = table.derivative.col(column_of(table, parameter));
        EXPECT_LE((extrapolated - exact).cwiseAbs().maxCoeff(), error);
        EXPECT_GT(exact.cwiseAbs().maxCoeff(), 100.0 * error) << "the differences are too coarse to judge";
    }
}

TEST(Sensitivity, EqualsDifferencesOfReflectance) {
    expect_differences(Quantity::reflectance, {Parameter::melanosome_fraction, Parameter::oxygen_saturation,
                                               Parameter::fibril_radius_nm, Parameter::stratum_corneum_refractive_index,
                                               Parameter::scale, Parameter::offset, Parameter::specular_fraction});
}

TEST(Sensitivity, EqualsDifferencesOfTransmittance) {
    expect_differences(Quantity::transmittance, {Parameter::melanosome_fraction, Parameter::papillary_blood_fraction,
                                                 Parameter::fibril_radius_nm, Parameter::scale, Parameter::offset});
}

TEST(Sensitivity, ReadingIsThatOfTheSolver) {
    for (const Quantity quantity : {Quantity::reflectance, Quantity::transmittance}) {
        const Sensitivity table = sensitivity(configuration_of(quantity));
        const Eigen::VectorXd expected = readings(configuration_of(quantity));
        for (std::size_t i = 0; i < table.reading.size(); ++i) {
            // The shares agree to their last bits; both add and scale fewer than ten numbers below one.
            EXPECT_NEAR(table.reading[i], expected[static_cast<Index>(i)], 1e-14);
        }
    }
}

TEST(Sensitivity, RelativeIsValueTimesDerivative) {
    const Sensitivity table = sensitivity(configuration_of(Quantity::reflectance));
    const Eigen::MatrixXd relative = relative_derivative(table);
    for (std::size_t i = 0; i < table.parameters.size(); ++i) {
        const double value = value_of(table.configuration.values, table.parameters[i]);
        for (Index row = 0; row < relative.rows(); ++row) {
            EXPECT_EQ(relative(row, static_cast<Index>(i)), value * table.derivative(row, static_cast<Index>(i)));
        }
    }
}

TEST(Sensitivity, EveryParameterIsListedOnceAndTheIneffectiveApart) {
    const auto is_ineffective = [](const Sensitivity& table, Parameter parameter) {
        return std::ranges::count(table.without_effect, parameter) == 1;
    };
    Configuration configuration = configuration_of(Quantity::reflectance);
    const Sensitivity excluded = sensitivity(configuration);
    EXPECT_EQ(excluded.without_effect, std::vector<Parameter>{Parameter::fold_aspect_ratio});
    EXPECT_EQ(excluded.parameters.size(), parameter_count - 1);
    EXPECT_EQ(excluded.derivative.cols(), static_cast<Index>(parameter_count - 1));

    configuration.specular = Specular::included;
    EXPECT_TRUE(is_ineffective(sensitivity(configuration), Parameter::specular_fraction));
    configuration.layers = 2;
    configuration.base.reset();
    const Sensitivity separated = sensitivity(configuration);
    for (const Parameter parameter : {Parameter::papillary_blood_fraction, Parameter::oxygen_saturation,
                                      Parameter::fibril_radius_nm, Parameter::reticular_dermis_thickness_cm}) {
        EXPECT_TRUE(is_ineffective(separated, parameter)) << info(parameter).name;
    }
}

TEST(Sensitivity, TheIneffectiveDoNotMoveTheReading) {
    Configuration configuration = configuration_of(Quantity::reflectance);
    configuration.specular = Specular::included;
    // Nothing that was absorbed in the reticular dermis comes back from a matched base.
    configuration.base = Base{.kind = Base::Kind::matched};
    const std::vector<Parameter> without_effect = sensitivity(configuration).without_effect;
    EXPECT_EQ(without_effect, (std::vector{Parameter::reticular_blood_fraction, Parameter::fold_aspect_ratio,
                                           Parameter::specular_fraction}));
    for (const Parameter parameter : without_effect) {
        Configuration changed = configuration;
        value_of(changed.values, parameter) *= 1.5;
        EXPECT_EQ(readings(changed), readings(configuration)) << info(parameter).name;
    }
}

TEST(Sensitivity, ReachesTheEndsOfTheTablesButNotBeyond) {
    Configuration configuration = configuration_of(Quantity::reflectance);
    const WavelengthRange range = modelled_wavelengths();
    configuration.wavelengths = std::to_string(range.lowest_nm) + "," + std::to_string(range.highest_nm);
    EXPECT_TRUE(sensitivity(configuration).derivative.allFinite());
    configuration.wavelengths = std::to_string(range.highest_nm + 1.0);
    EXPECT_THROW((void)sensitivity(configuration), InputError);
}

TEST(Sensitivity, PlotsTheFreeParametersThatHaveAnEffect) {
    Configuration configuration = configuration_of(Quantity::reflectance);
    const Plot plot = sensitivity_plot(sensitivity(configuration));
    ASSERT_EQ(plot.lines.size(), 5U);
    EXPECT_TRUE(plot.lines[0].label.starts_with("melanosome_fraction = ")) << plot.lines[0].label;
    configuration.free = {};
    configuration.free[static_cast<std::size_t>(Parameter::fold_aspect_ratio)] = true;
    EXPECT_THROW((void)sensitivity_plot(sensitivity(configuration)), InputError);
}

}  // namespace
}  // namespace skinfit
