#include "fit/physiological_priors.hpp"

#include <algorithm>
#include <array>

namespace skinfit {
namespace {

// A range from a to b gives median sqrt(a b) and sigma_log log(b / a) / 2.
const std::array<PhysiologicalPrior, 16> priors = {{
    {Parameter::melanosome_fraction, LogNormalPrior{.median = 0.0748, .sigma_log = 1.75},
     "[KA04]: 0.013 in light to 0.43 in dark skin", Bounds{0.013, 0.43}},
    {Parameter::melanin_slope, NormalPrior{.mean = 0.6, .sigma = 0.6},
     "skinfit: contact spheres ask for about 1.2, 45/0 for 0 to 0.4"},
    {Parameter::papillary_blood_fraction, LogNormalPrior{.median = 0.0118, .sigma_log = 1.78}, "[KA04]: 0.002 to 0.07",
     Bounds{0.002, 0.07}},
    {Parameter::reticular_blood_fraction, LogNormalPrior{.median = 0.0118, .sigma_log = 1.78}, "[KA04]: 0.002 to 0.07",
     Bounds{0.002, 0.07}},
    {Parameter::oxygen_saturation, BetaPrior{.a = 2.0, .b = 2.0},
     "skinfit: discourages the ends only; 90 % of it lies within 0.14 to 0.86, which holds [KA04, Table 1]'s 0.75"},
    {Parameter::hemoglobin_g_per_l, NormalPrior{.mean = 153.5, .sigma = 9.9},
     "[KA04, Table 1]: 134 to 173, a clinical reference range, which holds 95 %", Bounds{134, 173}},
    {Parameter::bilirubin_g_per_l, LogNormalPrior{.median = 0.05, .sigma_log = 1.5},
     "[KA04, Table 1]: 0.05; width: skinfit, so that jaundice of 1 g/L lies two standard deviations above"},
    {Parameter::dermal_bilirubin_g_per_l, LogNormalPrior{.median = 0.01, .sigma_log = 1.5},
     "skinfit: that of healthy serum, 1 mg/dL; width: as in blood"},
    {Parameter::lateral_loss_per_cm, LogNormalPrior{.median = 0.11, .sigma_log = 1.3},
     "skinfit: readings of spheres ask for 0.03, through 3 mm for 0.4"},
    {Parameter::stratum_corneum_thickness_cm, LogNormalPrior{.median = 0.00141, .sigma_log = 0.347},
     "[KA04, Sec. 2.1]: 0.001 to 0.002", Bounds{0.001, 0.002}},
    {Parameter::epidermis_thickness_cm, LogNormalPrior{.median = 0.00636, .sigma_log = 0.857},
     "[KA04, Sec. 2.1]: 0.0027 to 0.015", Bounds{0.0027, 0.015}},
    {Parameter::papillary_dermis_thickness_cm, LogNormalPrior{.median = 0.02, .sigma_log = 0.805},
     "[KA04, Table 1]: 0.02; width: that of the whole dermis, 0.06 to 0.3 in [KA04]"},
    {Parameter::reticular_dermis_thickness_cm, LogNormalPrior{.median = 0.18, .sigma_log = 0.805},
     "[KA04, Table 1]: 0.18; width: that of the whole dermis, 0.06 to 0.3 in [KA04]"},
    {Parameter::fibril_radius_nm, LogNormalPrior{.median = 25.0, .sigma_log = 0.3},
     "[KA04, Table 1]: 25; width: skinfit, fits to real skin choose 20 to 30"},
    {Parameter::scale, LogNormalPrior{.median = 1.0, .sigma_log = 0.1},
     "skinfit: contact instruments lose about 10 %, 45/0 reads 10 to 20 % more"},
    {Parameter::wavelength_shift_nm, NormalPrior{.mean = 0.0, .sigma = 1.0},
     "skinfit: wavelength accuracy of small spectrophotometers"},
}};

const std::array<PhysiologicalDerivedPrior, 1> derived = {{
    {Derived::pheomelanin_eumelanin_ratio, LogNormalPrior{.median = 0.133, .sigma_log = 0.997},
     "[KA04]: 0.049 to 0.36"},
}};

}  // namespace

std::span<const PhysiologicalPrior> physiological_priors() {
    return priors;
}

std::optional<PhysiologicalPrior> known_of(Parameter parameter) {
    const auto found = std::ranges::find(priors, parameter, &PhysiologicalPrior::parameter);
    return found == priors.end() ? std::nullopt : std::optional(*found);
}

std::span<const PhysiologicalDerivedPrior> physiological_derived_priors() {
    return derived;
}

}  // namespace skinfit
