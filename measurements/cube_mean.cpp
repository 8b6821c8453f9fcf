#include "measurements/cube_mean.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/input_error.hpp"

namespace skinfit {
namespace {

/// Sums over pixels of how far they are from the first: then no digits cancel in the scatter of bright pixels.
struct Sums {
    std::vector<double> origin;
    std::vector<double> difference;
    std::vector<double> square;
    std::size_t pixels = 0;

    void add(std::span<const double> spectrum) {
        if (pixels == 0) {
            origin.assign(spectrum.begin(), spectrum.end());
            difference.assign(spectrum.size(), 0);
            square.assign(spectrum.size(), 0);
        }
        for (std::size_t i = 0; i < spectrum.size(); ++i) {
            const double d = spectrum[i] - origin[i];
            difference[i] += d;
            square[i] += d * d;
        }
        ++pixels;
    }
};

bool is_complete(std::span<const double> spectrum) {
    return std::ranges::none_of(spectrum, [](double value) { return std::isnan(value); });
}

std::vector<double> standard_uncertainty(const Sums& sums) {
    std::vector<double> sigma;
    const auto n = static_cast<double>(sums.pixels);
    for (std::size_t i = 0; i < sums.origin.size(); ++i) {
        const double squares_about_mean = sums.square[i] - sums.difference[i] * sums.difference[i] / n;
        if (!(squares_about_mean > 0)) return {};
        sigma.push_back(std::sqrt(squares_about_mean / (n - 1) / n));
    }
    return sigma;
}

}  // namespace

CubeMean mean_spectrum(const SpectralCube& cube, const CubeRegion& region) {
    const std::size_t bands = cube.bands().size();
    const Rectangle& rectangle = region.rectangle();
    const std::size_t end = rectangle.first_line + rectangle.lines;
    Sums sums;
    std::size_t left_out = 0;
    for (std::size_t first = rectangle.first_line; first < end; first += cube.lines_at_once()) {
        const std::size_t count = std::min(cube.lines_at_once(), end - first);
        const std::vector<bool> chosen = region.read_lines(first, count);
        if (std::ranges::find(chosen, true) == chosen.end()) continue;
        const std::vector<double> fractions = cube.read_lines(first, count);
        for (std::size_t pixel = 0; pixel < chosen.size(); ++pixel) {
            if (!chosen[pixel]) continue;
            const std::span<const double> spectrum = std::span(fractions).subspan(pixel * bands, bands);
            if (is_complete(spectrum)) {
                sums.add(spectrum);
            } else {
                ++left_out;
            }
        }
    }
    if (sums.pixels == 0) {
        throw InputError(
            {.where = cube.files().data.string(),
             .problem = "the region holds no complete pixel",
             .why = fmt::format("pixels chosen: {}; each lacks a number in some good band", left_out),
             .remedy = "choose another mask or rectangle, or mark the bands without data as bad in \"bbl\""});
    }
    CubeMean mean{.value = sums.origin, .sigma = {}, .pixels = sums.pixels, .left_out = left_out};
    for (std::size_t i = 0; i < bands; ++i) mean.value[i] += sums.difference[i] / static_cast<double>(sums.pixels);
    if (sums.pixels > 1) mean.sigma = standard_uncertainty(sums);
    return mean;
}

}  // namespace skinfit
