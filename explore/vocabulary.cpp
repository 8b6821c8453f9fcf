#include "explore/vocabulary.hpp"

#include <optional>

#include "core/version.hpp"
#include "explore/configuration_request.hpp"
#include "explore/measured_request.hpp"
#include "explore/server.hpp"
#include "explore/simulation.hpp"
#include "fit/configuration_json.hpp"
#include "fit/fit_scale.hpp"
#include "fit/named_instrument.hpp"
#include "fit/physiological_priors.hpp"

namespace skinfit {
namespace {

/// Under which heading a parameter stands.
std::string_view group_of(Parameter parameter) {
    switch (parameter) {
        case Parameter::melanosome_fraction:
        case Parameter::eumelanin_g_per_l:
        case Parameter::pheomelanin_g_per_l:
        case Parameter::melanin_slope:
        case Parameter::stratum_corneum_carotene_g_per_l:
        case Parameter::epidermis_carotene_g_per_l:
            return "epidermis";
        case Parameter::papillary_blood_fraction:
        case Parameter::reticular_blood_fraction:
        case Parameter::oxygen_saturation:
        case Parameter::hemoglobin_g_per_l:
        case Parameter::whole_blood_share:
        case Parameter::bilirubin_g_per_l:
        case Parameter::dermis_carotene_g_per_l:
            return "blood";
        case Parameter::dermal_bilirubin_g_per_l:
        case Parameter::fibre_refractive_index:
        case Parameter::fibril_radius_nm:
            return "dermis";
        case Parameter::stratum_corneum_thickness_cm:
        case Parameter::epidermis_thickness_cm:
        case Parameter::papillary_dermis_thickness_cm:
        case Parameter::reticular_dermis_thickness_cm:
        case Parameter::stratum_corneum_refractive_index:
        case Parameter::epidermis_refractive_index:
        case Parameter::papillary_dermis_refractive_index:
        case Parameter::reticular_dermis_refractive_index:
        case Parameter::fold_aspect_ratio:
            return "geometry";
        case Parameter::lateral_loss_per_cm:
        case Parameter::scale:
        case Parameter::offset:
        case Parameter::specular_fraction:
        case Parameter::wavelength_shift_nm:
            break;
    }
    return "instrument";
}

/// The range published for healthy skin, or null.
Json usual_json(Parameter parameter) {
    const std::optional<PhysiologicalPrior> known = known_of(parameter);
    if (!known || !known->healthy) return {};
    return {{"lower", known->healthy->lower}, {"upper", known->healthy->upper}, {"source", known->source}};
}

Json parameter_json(const ParameterInfo& info, const Configuration& defaults) {
    return {{"name", info.name},
            {"unit", info.unit},
            {"group", group_of(info.parameter)},
            {"meaning", info.meaning},
            {"source", info.source},
            {"lowest", info.lowest},
            {"highest", info.highest},
            {"lower", info.lower},
            {"upper", info.upper},
            {"steers", info.steers},
            {"logarithmic", has_logarithmic_scale(info.parameter)},
            {"default", value_of(defaults.values, info.parameter)},
            {"usual", usual_json(info.parameter)}};
}

}  // namespace

Json vocabulary_json() {
    const Configuration defaults = explore_configuration();
    Json parameters = Json::array();
    for (const ParameterInfo& info : parameter_table()) parameters.push_back(parameter_json(info, defaults));
    Json engines = Json::array();
    for (const std::string_view engine : engine_names) {
        if (engine != engine_names[static_cast<std::size_t>(Engine::walk)]) engines.push_back(engine);
    }
    return {{"version", version},
            {"parameters", parameters},
            {"groups", {"epidermis", "blood", "dermis", "geometry", "instrument"}},
            {"layers", layer_names},
            {"instruments", instrument_names()},
            {"measurement_settings", measurement_settings},
            {"fit_engines", engines},
            {"largest_file_bytes", largest_body_bytes},
            {"configuration", to_json(defaults)},
            {"schema", configuration_schema()}};
}

}  // namespace skinfit
