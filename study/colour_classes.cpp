#include "study/colour_classes.hpp"

#include <algorithm>

#include "study/marginal.hpp"

namespace skinfit {

std::optional<ColourClassProbabilities> colour_classes_of(const StudiedSpectrum& spectrum) {
    const auto angle =
        std::ranges::find(spectrum.indices, std::string_view("individual_typology_angle_deg"), &IndexValue::name);
    if (angle == spectrum.indices.end()) return std::nullopt;
    const MarginalDistribution marginal = marginal_of(*angle);
    ColourClassProbabilities probabilities{};
    double above = 0.0;  // the probability of the classes so far
    for (std::size_t i = 0; i < skin_colour_begins_deg.size(); ++i) {
        const double next = marginal.probability_above(skin_colour_begins_deg[i]);
        probabilities[i] = next - above;
        above = next;
    }
    probabilities.back() = 1.0 - above;
    return probabilities;
}

}  // namespace skinfit
