#include "validation/claim.hpp"

#include <cassert>

namespace skinfit {

const std::vector<ClaimInfo>& claim_table() {
    static const std::vector<ClaimInfo> table = {
        // claim, name, kind, compares_series, needs_measured, text
        {Claim::falls_with_wavelength, "falls_with_wavelength", FigureKind::extinction, false, false,
         "each series falls with wavelength"},
        {Claim::darker_in_order, "darker_in_order", FigureKind::spectrum, true, false,
         "each series is darker at every wavelength"},
        {Claim::w_deepens_in_order, "w_deepens_in_order", FigureKind::spectrum, true, false,
         "the W deepens from series to series"},
        {Claim::close_to_measured, "close_to_measured", FigureKind::spectrum, false, true,
         "the model is close to the measurement"},
        {Claim::measured_within, "measured_within", FigureKind::spectrum, false, true,
         "the measurement lies between the series"},
        {Claim::redder_in_order, "redder_in_order", FigureKind::spectrum, true, false,
         "the skin reddens from series to series"},
        {Claim::yellower_in_order, "yellower_in_order", FigureKind::spectrum, true, false,
         "the skin yellows from series to series"},
        {Claim::more_directional_in_order, "more_directional_in_order", FigureKind::goniophotometer, true, false,
         "each series is more directional"},
        {Claim::near_lambertian, "near_lambertian", FigureKind::goniophotometer, false, false,
         "the light is nearly Lambertian"},
    };
    return table;
}

const ClaimInfo& info(Claim claim) {
    const ClaimInfo& row = claim_table().at(static_cast<std::size_t>(claim));
    assert(row.claim == claim);
    return row;
}

}  // namespace skinfit
