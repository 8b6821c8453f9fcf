#include "study/map_tile.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace skinfit {
namespace {

/// Those of a map that follow the planes of the parameters; `numbers_of` has the same order.
constexpr std::array further_planes = {"status", "reason", "rmse", "chi2"};

/// The numbers of one pixel, plane after plane.
std::vector<float> numbers_of(const PixelFit& fit) {
    std::vector<float> numbers;
    for (std::size_t i = 0; i < fit.values.size(); ++i) {
        numbers.push_back(static_cast<float>(fit.values[i]));
        numbers.push_back(static_cast<float>(fit.sigmas[i]));
    }
    numbers.push_back(static_cast<float>(fit.status));
    numbers.push_back(static_cast<float>(fit.reason));
    numbers.push_back(static_cast<float>(fit.rmse));
    numbers.push_back(static_cast<float>(fit.chi2));
    return numbers;
}

}  // namespace

std::vector<std::string> map_planes(const FitProblem& problem) {
    std::vector<std::string> names;
    for (const FreeParameter& free : problem.free) {
        names.push_back(name_of(free));
        names.push_back(name_of(free) + "_sigma");
    }
    names.insert(names.end(), further_planes.begin(), further_planes.end());
    return names;
}

std::size_t tile_lines(const SpectralCube& cube) {
    constexpr std::size_t pixels = 8192;
    return std::clamp<std::size_t>(pixels / cube.samples(), 1, cube.lines_at_once());
}

MapTile fit_tile(const PixelFitter& fitter, const SpectralCube& cube, const CubeRegion& region, std::size_t first,
                 std::size_t count) {
    const std::size_t samples = cube.samples();
    const std::size_t bands = cube.bands().size();
    const std::size_t planes = map_planes(fitter.problem()).size();
    const std::size_t status_plane = planes - further_planes.size();
    const std::vector<bool> chosen = region.read_lines(first, count);
    const bool has_any = std::ranges::find(chosen, true) != chosen.end();
    const std::vector<double> fractions = has_any ? cube.read_lines(first, count) : std::vector<double>{};
    std::vector<float> numbers(count * planes * samples, std::numeric_limits<float>::quiet_NaN());
    std::vector<FitStatus> statuses(count * samples, FitStatus::masked);
    tbb::parallel_for(std::size_t{0}, count * samples, [&](std::size_t pixel) {
        float* const to = &numbers[pixel / samples * planes * samples + pixel % samples];
        to[status_plane * samples] = static_cast<float>(FitStatus::masked);
        if (!chosen[pixel]) return;
        const std::span<const double> values = std::span(fractions).subspan(pixel * bands, bands);
        if (std::ranges::all_of(values, [](double value) { return std::isnan(value); })) return;
        const PixelFit fit = fitter.fit(values);
        const std::vector<float> pixel_numbers = numbers_of(fit);
        for (std::size_t plane = 0; plane < planes; ++plane) to[plane * samples] = pixel_numbers[plane];
        statuses[pixel] = fit.status;
    });
    MapTile tile{.bytes = std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float))};
    for (const FitStatus status : statuses) ++tile.pixels[static_cast<std::size_t>(status)];
    return tile;
}

}  // namespace skinfit
