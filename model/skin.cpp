#include "model/skin.hpp"

#include <algorithm>

namespace skinfit {

std::string layer_in_words(std::size_t layer) {
    std::string words(layer_names.at(layer));
    std::ranges::replace(words, '_', ' ');
    return words;
}

PerLayer<double> thickness_cm(const Skin& skin) {
    return {skin.stratum_corneum_thickness_cm, skin.epidermis_thickness_cm, skin.papillary_dermis_thickness_cm,
            skin.reticular_dermis_thickness_cm};
}

PerLayer<double> refractive_index(const Skin& skin) {
    return {skin.stratum_corneum_refractive_index, skin.epidermis_refractive_index,
            skin.papillary_dermis_refractive_index, skin.reticular_dermis_refractive_index};
}

}  // namespace skinfit
