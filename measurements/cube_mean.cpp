#include "measurements/cube_mean.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>

#include "core/input_error.hpp"

namespace skinfit {
namespace {

/// Sums over pixels of how far they are from the first: then no digits cancel in the scatter of bright pixels.
struct Sums {
    std::vector<double> origin;  ///< of each band: the first number
    std::vector<double> difference;
    std::vector<double> square;
    std::vector<std::size_t> count;  ///< of numbers in each band
    std::size_t pixels = 0;

    explicit Sums(std::size_t bands)
        : origin(bands, std::numeric_limits<double>::quiet_NaN()), difference(bands), square(bands), count(bands) {}

    void add(std::span<const double> spectrum) {
        for (std::size_t i = 0; i < spectrum.size(); ++i) {
            if (std::isnan(spectrum[i])) continue;
            if (count[i]++ == 0) origin[i] = spectrum[i];
            const double d = spectrum[i] - origin[i];
            difference[i] += d;
            square[i] += d * d;
        }
        ++pixels;
    }
};

bool has_number(std::span<const double> spectrum) {
    return std::ranges::any_of(spectrum, [](double value) { return !std::isnan(value); });
}

/// Whether there is a number in each of these bands.
bool is_complete(std::span<const double> spectrum, const std::vector<std::size_t>& needed) {
    return std::ranges::none_of(needed, [&](std::size_t band) { return std::isnan(spectrum[band]); });
}

/// True for a band whose number was 0 in every pixel, whatever its offset makes of it.
bool is_dead(const Sums& sums, const SpectralCube& cube, std::size_t band) {
    return sums.origin[band] == cube.fraction_of_zero(band) && sums.square[band] == 0;
}

/// The places of the wavelengths in the window; of all where it has none.
std::vector<std::size_t> places_in(const WavelengthWindow& window, const std::vector<double>& wavelength_nm) {
    std::vector<std::size_t> all(wavelength_nm.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::vector<std::size_t> used;
    std::ranges::copy_if(all, std::back_inserter(used),
                         [&](std::size_t i) { return window.contains(wavelength_nm[i]); });
    return used.empty() ? all : used;
}

std::vector<double> standard_uncertainty(const Sums& sums, const SpectralCube& cube,
                                         const std::vector<std::size_t>& needed) {
    std::vector<double> sigma;
    for (std::size_t i = 0; i < sums.origin.size(); ++i) {
        const auto n = static_cast<double>(sums.count[i]);
        const double squares_about_mean = sums.square[i] - sums.difference[i] * sums.difference[i] / n;
        const bool is_known = squares_about_mean > 0;
        if (!is_known && !is_dead(sums, cube, i) && std::ranges::binary_search(needed, i)) return {};
        sigma.push_back(is_known ? std::sqrt(squares_about_mean / (n - 1) / n)
                                 : std::numeric_limits<double>::quiet_NaN());
    }
    return sigma;
}

}  // namespace

CubeMean mean_spectrum(const SpectralCube& cube, const CubeRegion& region, const WavelengthWindow& window) {
    const std::size_t bands = cube.bands().size();
    const Rectangle& rectangle = region.rectangle();
    const std::size_t end = rectangle.first_line + rectangle.lines;
    const std::vector<std::size_t> needed = places_in(window, cube.wavelength_nm());
    Sums sums(bands);
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
            if (is_complete(spectrum, needed)) {
                sums.add(spectrum);
            } else {
                ++(has_number(spectrum) ? incomplete : masked);
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
        mean.value[i] += sums.difference[i] / static_cast<double>(sums.count[i]);
        if (is_dead(sums, cube, i)) mean.value[i] = std::numeric_limits<double>::quiet_NaN();
    }
    if (sums.pixels > 1) mean.sigma = standard_uncertainty(sums, cube, needed);
    return mean;
}

}  // namespace skinfit
