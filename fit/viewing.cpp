#include "fit/viewing.hpp"

#include <fmt/format.h>

#include "core/input_error.hpp"

namespace skinfit {
void check_viewing_cone(const ResolvedConfiguration& configuration) {
    if (!configuration.viewing_cone_deg) return;
    const auto refuse = [&](const std::string& why, const std::string& remedy) {
        throw InputError({.where = "viewing_cone_deg",
                          .problem = fmt::format("{} cannot be used", *configuration.viewing_cone_deg),
                          .why = why,
                          .remedy = remedy});
    };
    if (configuration.engine != Engine::solver && configuration.engine != Engine::walk) {
        refuse("engine=paths and engine=emulator do not know in which direction light leaves",
               "set engine=solver, or engine=walk for a simulation");
    }
    if (configuration.quantity == Quantity::transmittance) {
        refuse("the cone looks at the reflected light, not at the transmitted", "leave it out");
    }
    if (configuration.specular == Specular::included) {
        refuse("the reflectance factor is computed without the surface reflection, which 45/0 instruments avoid",
               "set specular=excluded");
    }
    const auto fraction = static_cast<std::size_t>(Parameter::specular_fraction);
    if (configuration.values.instrument.specular_fraction != 0.0 || configuration.free[fraction]) {
        refuse("specular_fraction is of the surface reflection over the hemisphere",
               "set specular_fraction=0 and fix it");
    }
}

}  // namespace skinfit
