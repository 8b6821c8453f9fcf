#include "fit/sensitivity.hpp"

#include "fit/problem.hpp"
#include "fit/reading.hpp"
#include "fit/viewing.hpp"
#include "fit/wavelength_sets.hpp"

namespace skinfit {
namespace {

using Index = Eigen::Index;

std::vector<Parameter> all_parameters() {
    std::vector<Parameter> parameters;
    for (const ParameterInfo& row : parameter_table()) parameters.push_back(row.parameter);
    return parameters;
}

}  // namespace

Sensitivity sensitivity(const Configuration& configuration) {
    Sensitivity result{.configuration = resolved(configuration),
                       .wavelength_nm = parse_wavelengths(configuration.wavelengths, "wavelengths"),
                       .reading = {},
                       .parameters = {},
                       .without_effect = {},
                       .derivative = {}};
    result.configuration.engine = Engine::solver;
    check_viewing_cone(result.configuration);
    const Quantity quantity = result.configuration.quantity;
    const Experiment experiment = make_experiment(result.configuration);
    const ModelWavelengths wavelengths = model_wavelengths(experiment, result.wavelength_nm);
    const std::vector<Parameter> parameters = all_parameters();
    const EscapedLight light =
        light_of(angular_solver(experiment), experiment, measured_side(quantity), wavelengths, parameters);
    const Eigen::VectorXd reading = readings(light, experiment, quantity);
    result.reading.assign(reading.begin(), reading.end());
    const Eigen::MatrixXd derivative = reading_derivatives(light, experiment, quantity, parameters);
    std::vector<Index> columns;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const auto column = static_cast<Index>(i);
        const bool has_effect = !derivative.col(column).isZero(0.0);
        (has_effect ? result.parameters : result.without_effect).push_back(parameters[i]);
        if (has_effect) columns.push_back(column);
    }
    result.derivative = derivative(Eigen::all, columns);
    return result;
}

Eigen::MatrixXd relative_derivative(const Sensitivity& sensitivity) {
    Eigen::MatrixXd relative = sensitivity.derivative;
    for (std::size_t i = 0; i < sensitivity.parameters.size(); ++i) {
        relative.col(static_cast<Index>(i)) *= value_of(sensitivity.configuration.values, sensitivity.parameters[i]);
    }
    return relative;
}

}  // namespace skinfit
