#include "model/skin.hpp"

namespace skinfit {

PerLayer<double> thickness_cm(const Skin& skin) {
    return {skin.stratum_corneum_thickness_cm, skin.epidermis_thickness_cm, skin.papillary_dermis_thickness_cm,
            skin.reticular_dermis_thickness_cm};
}

PerLayer<double> refractive_index(const Skin& skin) {
    return {skin.stratum_corneum_refractive_index, skin.epidermis_refractive_index,
            skin.papillary_dermis_refractive_index, skin.reticular_dermis_refractive_index};
}

}  // namespace skinfit
