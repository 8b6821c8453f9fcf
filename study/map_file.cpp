#include "study/map_file.hpp"

#include <fmt/format.h>

#include <span>
#include <string_view>

#include "core/version.hpp"
#include "study/fit_status.hpp"
#include "study/map_tile.hpp"
#include "study/pixel_fitter.hpp"

namespace skinfit {
namespace {

/// `0 first, 1 second, ...`.
std::string numbered(std::span<const std::string_view> names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) text += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, names[i]);
    return text;
}

/// What the header of the cube states and is not used.
std::string not_used_of(const EnviHeader& header) {
    std::string text;
    for (const std::string& remark : header.remarks) text += "; " + remark;
    return text;
}

}  // namespace

EnviOutput map_output(const FitProblem& problem, const SpectralCube& cube, const std::string& configuration_hash) {
    return {.samples = cube.samples(),
            .lines = cube.lines(),
            .band_names = map_planes(problem),
            .description = fmt::format(
                "skinfit {}; cube {}; configuration {}; status: {}; reason: {}; sigma: 1 standard deviation, nan at a "
                "bound and where not identifiable{}",
                version, cube.files().data.string(), configuration_hash, numbered(fit_status_names),
                numbered(pixel_reason_names), not_used_of(cube.header())),
            .place = cube.header().place};
}

}  // namespace skinfit
