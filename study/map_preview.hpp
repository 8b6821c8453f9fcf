#pragma once

#include <filesystem>
#include <vector>

namespace skinfit {

/// Draws the map in the ENVI file `path` (`MapTile`) as PNGs in `folder`, and returns their names: for each parameter
/// its value with its sigma beside it, `<map>_<parameter>.png`; status and reason, `<map>_status.png`; rmse and chi2,
/// `<map>_misfit.png`.
///
/// Pixels are square; a map of more than 600 samples or lines is reduced by block averages. Colours (viridis) span the
/// quantiles 0.02 to 0.98 of what is drawn, as the picture says; grey has no value. Throws InputError as `reduced_map`,
/// when gnuplot is missing, and when a picture cannot be written.
[[nodiscard]] std::vector<std::filesystem::path> draw_map(const std::filesystem::path& path,
                                                          const std::filesystem::path& folder);

}  // namespace skinfit
