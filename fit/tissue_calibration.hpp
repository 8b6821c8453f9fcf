#pragma once

#include "fit/result.hpp"

/// The hemoglobin of the dermis as fits of the preset `skin` tell that of another physics.
///
/// What the model takes for blood is no absolute amount: how much a skin absorbs is told against how much it scatters,
/// which differs between skins and between models, and what a grey loss takes is hard to tell from blood. On skins
/// drawn wide from a conventional Monte Carlo (calibration/), whose truth is known, the regression
///
///     log(true umol/L) = a + b log(papillary blood) + c log(reticular blood) + d log(lateral loss)
///                          + e log(fibril radius) + N(0, s^2)
///
/// of what the preset fits there gives the numbers here; s is what the intervals of the fits leave of the residuals,
/// by maximum likelihood. calibration/dermal_hemoglobin.csv holds the fits, docs/skin.md the recipe.
namespace skinfit {

/// s, a standard deviation of the logarithm.
inline constexpr double hemoglobin_model_error = 0.315;

/// Whether the calibration holds for a fit: of reflectance, by the preset `skin`, with all four parameters adjusted
/// under log-normal priors, which keep them above 0.
[[nodiscard]] bool has_calibrated_hemoglobin(const FitResult& result);

/// Tetramers in a litre of dermis, umol/L, by the regression; blood of another `hemoglobin_g_per_l` than 150 counts by
/// its hemoglobin. The four parameters are above 0.
[[nodiscard]] double calibrated_hemoglobin_umol_per_l(const Skin& skin);

}  // namespace skinfit
