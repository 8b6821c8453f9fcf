#include "fit/configuration.hpp"

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

std::vector<Parameter> free_parameters(const FitSettings& settings) {
    std::vector<Parameter> free;
    for (const ParameterInfo& info : parameter_table()) {
        if (settings.free[static_cast<std::size_t>(info.parameter)]) free.push_back(info.parameter);
    }
    return free;
}

WavelengthWindow window_of(const FitSettings& settings) {
    WavelengthWindow window{
        .range = {.lowest_nm = settings.wavelength_min_nm, .highest_nm = settings.wavelength_max_nm}};
    for (const Bounds& range_nm : settings.exclude_nm) {
        window.excluded.push_back({.lowest_nm = range_nm.lower, .highest_nm = range_nm.upper});
    }
    return window;
}

}  // namespace skinfit
