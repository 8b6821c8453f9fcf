#include "fit/tissue_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

namespace skinfit {
namespace {

constexpr std::array predictors = {Parameter::papillary_blood_fraction, Parameter::reticular_blood_fraction,
                                   Parameter::lateral_loss_per_cm, Parameter::fibril_radius_nm};

}  // namespace

bool has_calibrated_hemoglobin(const FitResult& result) {
    if (result.configuration.preset != Preset::skin) return false;
    const bool reflects = std::ranges::all_of(result.spectra, [](const FittedSpectrum& each) {
        return each.configuration.quantity == Quantity::reflectance;
    });
    return reflects && std::ranges::all_of(predictors, [&](Parameter parameter) {
               const auto found = std::ranges::find(result.free, parameter, &FittedParameter::parameter);
               return found != result.free.end() && found->prior &&
                      std::holds_alternative<LogNormalPrior>(*found->prior);
           });
}

double calibrated_hemoglobin_umol_per_l(const Skin& skin) {
    constexpr double drawn_g_per_l = 150.0;  // of the blood of the skins drawn
    return skin.hemoglobin_g_per_l / drawn_g_per_l *
           std::exp(11.485 + 0.562 * std::log(skin.papillary_blood_fraction) +
                    0.896 * std::log(skin.reticular_blood_fraction) - 0.347 * std::log(skin.lateral_loss_per_cm) -
                    0.527 * std::log(skin.fibril_radius_nm));
}

}  // namespace skinfit
