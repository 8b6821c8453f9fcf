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

double reading(const EscapedLight& light, const Experiment& experiment, Quantity quantity) {
    const Instrument& instrument = experiment.values.instrument;
    const double surface = collected_surface(experiment, quantity);
    return instrument.scale * (light.share + surface * light.surface) + instrument.offset;
}

Eigen::RowVectorXd reading_derivatives(const EscapedLight& light, const Experiment& experiment, Quantity quantity,
                                       std::span<const Parameter> parameters) {
    assert(light.share_by.size() == static_cast<Column>(parameters.size()));
    const double surface = collected_surface(experiment, quantity);
    const double scale = experiment.values.instrument.scale;
    const bool collects_fraction =
        quantity == Quantity::reflectance && experiment.specular == Specular::excluded && !experiment.viewing_cone_rad;
    Eigen::RowVectorXd by(light.share_by.size());
    for (Column column = 0; column < by.size(); ++column) {
        switch (parameters[static_cast<std::size_t>(column)]) {
            case Parameter::scale:
                by[column] = light.share + surface * light.surface;
                break;
            case Parameter::offset:
                by[column] = 1.0;
                break;
            case Parameter::specular_fraction:
                by[column] = collects_fraction ? scale * light.surface : 0.0;
                break;
            default:
                by[column] = scale * (light.share_by[column] + surface * light.surface_by[column]);
        }
    }
    return by;
}

}  // namespace skinfit
