#include "fit/reading.hpp"

#include <cassert>

namespace skinfit {

using Column = Eigen::Index;

Side measured_side(Quantity quantity) {
    return quantity == Quantity::reflectance ? Side::top : Side::bottom;
}

double collected_surface(const Experiment& experiment, Quantity quantity) {
    return quantity == Quantity::reflectance ? surface_weight(experiment) : 0.0;
}

Eigen::VectorXd readings(const EscapedLight& light, const Experiment& experiment, Quantity quantity) {
    const Instrument& instrument = experiment.values.instrument;
    const double surface = collected_surface(experiment, quantity);
    return (instrument.scale * (light.share.array() + surface * light.surface.array()) + instrument.offset).matrix();
}

Eigen::MatrixXd reading_derivatives(const EscapedLight& light, const Experiment& experiment, Quantity quantity,
                                    std::span<const Parameter> parameters) {
    assert(light.share_by.cols() == static_cast<Column>(parameters.size()));
    const double surface = collected_surface(experiment, quantity);
    const double scale = experiment.values.instrument.scale;
    const bool collects_fraction =
        quantity == Quantity::reflectance && experiment.specular == Specular::excluded && !experiment.viewing_cone_rad;
    Eigen::MatrixXd by(light.share_by.rows(), light.share_by.cols());
    for (Column column = 0; column < by.cols(); ++column) {
        switch (parameters[static_cast<std::size_t>(column)]) {
            case Parameter::scale:
                by.col(column) = light.share + surface * light.surface;
                break;
            case Parameter::offset:
                by.col(column).setOnes();
                break;
            case Parameter::specular_fraction:
                by.col(column) = (collects_fraction ? scale : 0.0) * light.surface;
                break;
            default:
                by.col(column) = scale * (light.share_by.col(column) + surface * light.surface_by.col(column));
        }
    }
    return by;
}

}  // namespace skinfit
