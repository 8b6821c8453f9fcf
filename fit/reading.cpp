#include "fit/reading.hpp"

#include <cassert>

namespace skinfit {

using Column = Eigen::Index;

Side measured_side(Quantity quantity) {
    return quantity == Quantity::reflectance ? Side::top : Side::bottom;
}

Eigen::VectorXd readings(const EscapedLight& light, const Experiment& experiment, Quantity quantity) {
    const ReadingLaw law = reading_law(experiment, quantity);
    return light.share.binaryExpr(light.surface,
                                  [&](double share, double surface) { return law.reading(law.light(share, surface)); });
}

Eigen::MatrixXd reading_derivatives(const EscapedLight& light, const Experiment& experiment, Quantity quantity,
                                    std::span<const Parameter> parameters) {
    assert(light.share_by.cols() == static_cast<Column>(parameters.size()));
    const ReadingLaw law = reading_law(experiment, quantity);
    Eigen::MatrixXd by(light.share_by.rows(), light.share_by.cols());
    for (Column column = 0; column < by.cols(); ++column) {
        const Parameter parameter = parameters[static_cast<std::size_t>(column)];
        if (belongs_to_instrument(parameter) && parameter != Parameter::wavelength_shift_nm) {
            by.col(column) = light.share.binaryExpr(light.surface, [&](double share, double surface) {
                return law.derivative(parameter, law.light(share, surface), surface);
            });
        } else {
            by.col(column) =
                law.scale * (light.share_by.col(column) + law.surface_weight * light.surface_by.col(column));
        }
    }
    return by;
}

}  // namespace skinfit
