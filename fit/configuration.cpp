#include "fit/configuration.hpp"

#include "core/input_error.hpp"

namespace skinfit {

double default_loss_scale(Loss loss) {
    return loss == Loss::cauchy ? 2.385 : 1.345;
}

Configuration default_configuration() {
    Configuration configuration;
    for (const ParameterInfo& info : parameter_table()) {
        configuration.bounds[static_cast<std::size_t>(info.parameter)] = {info.lower, info.upper};
    }
    for (const Parameter parameter :
         {Parameter::melanosome_fraction, Parameter::papillary_blood_fraction, Parameter::reticular_blood_fraction,
          Parameter::oxygen_saturation, Parameter::bilirubin_g_per_l}) {
        configuration.free[static_cast<std::size_t>(parameter)] = true;
    }
    return configuration;
}

Base resolved_base(const Configuration& configuration) {
    const bool separated = configuration.layers == 2;
    if (!configuration.base) {
        return separated ? Base{.kind = Base::Kind::index, .refractive_index = 1.0} : Base{};
    }
    if (separated && configuration.base->kind == Base::Kind::hypodermis) {
        throw InputError({.where = "base",
                          .problem = "hypodermis under two layers",
                          .why = "separated stratum corneum and epidermis have no dermis above a hypodermis",
                          .remedy = "leave base unset for air, or give matched or a refractive index"});
    }
    return *configuration.base;
}

std::vector<Parameter> free_parameters(const Configuration& configuration) {
    std::vector<Parameter> free;
    for (const ParameterInfo& info : parameter_table()) {
        if (configuration.free[static_cast<std::size_t>(info.parameter)]) free.push_back(info.parameter);
    }
    return free;
}

}  // namespace skinfit
