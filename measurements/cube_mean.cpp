#include "measurements/cube_mean.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

std::size_t numbers_in(std::span<const double> spectrum) {
    return static_cast<std::size_t>(std::ranges::count_if(spectrum, [](double value) { return !std::isnan(value); }));
}

/// True for a band that was 0 in every pixel.
bool is_dead(const Sums& sums, std::size_t band) {
    return sums.origin[band] == 0 && sums.square[band] == 0;
}

std::vector<double> standard_uncertainty(const Sums& sums) {
    std::vector<double> sigma;
    const auto n = static_cast<double>(sums.pixels);
    for (std::size_t i = 0; i < sums.origin.size(); ++i) {
        if (is_dead(sums, i)) {
            sigma.push_back(std::numeric_limits<double>::quiet_NaN());
            continue;
        }
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
    std::size_t masked = 0;
    std::size_t incomplete = 0;
    for (std::size_t first = rectangle.first_line; first < end; first += cube.lines_at_once()) {
        const std::size_t count = std::min(cube.lines_at_once(), end - first);
        const std::vector<bool> chosen = region.read_lines(first, count);
        if (std::ranges::find(chosen, true) == chosen.end()) continue;
        const std::vector<double> fractions = cube.read_lines(first, count);
        for (std::size_t pixel = 0; pixel < chosen.size(); ++pixel) {
            if (!chosen[pixel]) continue;
            const std::span<const double> spectrum = std::span(fractions).subspan(pixel * bands, bands);
            const std::size_t numbers = numbers_in(spectrum);
            if (numbers == bands) {
                sums.add(spectrum);
            } else {
                ++(numbers == 0 ? masked : incomplete);
            }
        }
    }
    if (sums.pixels == 0) {
        throw InputError(
            {.where = cube.files().data.string(),
             .problem = "the region holds no complete pixel",
             .why = fmt::format("pixels chosen: {}; each lacks a number in some good band, or is one and the same "
                                "number in all",
                                masked + incomplete),
             .remedy = "choose another mask or rectangle, or mark the bands without data as bad in \"bbl\""});
    }
    CubeMean mean{.value = sums.origin, .sigma = {}, .pixels = sums.pixels, .masked = masked, .incomplete = incomplete};
    for (std::size_t i = 0; i < bands; ++i) {
        mean.value[i] += sums.difference[i] / static_cast<double>(sums.pixels);
        if (is_dead(sums, i)) mean.value[i] = std::numeric_limits<double>::quiet_NaN();
    }
    if (sums.pixels > 1) mean.sigma = standard_uncertainty(sums);
    return mean;
}

}  // namespace skinfit
