#include "measurements/spectral_cube.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "measurements/stated_words.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// The number that stands for no measurement, as it reads when stored in the data's type.
double stored_ignore_value(const EnviHeader& header) {
    const double stated = header.data_ignore_value.value_or(std::numeric_limits<double>::quiet_NaN());
    return header.data_type.kind == NumberKind::float32 ? static_cast<double>(static_cast<float>(stated)) : stated;
}

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// Whether the numbers of a pixel, `stride` apart from band to band, are the same in all of `bands`, three or more.
bool is_one_number(const double* pixel, std::size_t stride, const std::vector<std::size_t>& bands) {
    constexpr std::size_t fewest = 3;
    const double first = pixel[bands.front() * stride];
    return bands.size() >= fewest &&
           std::ranges::all_of(bands, [&](std::size_t band) { return pixel[band * stride] == first; });
}

/// Where the numbers of one pixel and one band lie among those read for some lines.
struct Strides {
    std::size_t line;
    std::size_t sample;
    std::size_t band;
};

Strides strides(const EnviHeader& header, std::size_t lines) {
    switch (header.interleave) {
        case Interleave::bsq:
            return {.line = header.samples, .sample = 1, .band = lines * header.samples};
        case Interleave::bil:
            return {.line = header.samples * header.bands, .sample = 1, .band = header.samples};
        case Interleave::bip:
            return {.line = header.samples * header.bands, .sample = header.bands, .band = 1};
    }
    assert(false);
    return {};
}

/// The numbers of some lines, in the order of the file; for bsq those lines of every band.
std::vector<double> read_numbers(const Raster& raster, const EnviHeader& header, std::size_t first, std::size_t count) {
    if (header.interleave == Interleave::bip) return raster.read_rows(first, count);
    if (header.interleave == Interleave::bil) return raster.read_rows(first * header.bands, count * header.bands);
    std::vector<double> numbers;
    numbers.reserve(count * header.samples * header.bands);
    for (std::size_t band = 0; band < header.bands; ++band) {
        const std::vector<double> part = raster.read_rows(band * header.lines + first, count);
        numbers.insert(numbers.end(), part.begin(), part.end());
    }
    return numbers;
}

void check_wavelengths(const EnviHeader& header, const std::vector<std::size_t>& bands) {
    for (const std::size_t band : bands) {
        const double wavelength = header.wavelength_nm[band];
        if (wavelength_range_nm.contains(wavelength)) continue;
        throw InputError({.where = header.source,
                          .problem = fmt::format("the wavelength of band {} is {} nm", band + 1, wavelength),
                          .why = fmt::format("it must lie between {} and {} nm", wavelength_range_nm.lowest,
                                             wavelength_range_nm.highest),
                          .remedy = R"(correct "wavelength" or "wavelength units", or mark the band as bad in "bbl")"});
    }
}

/// The good bands by ascending wavelength.
std::vector<std::size_t> choose_bands(const EnviHeader& header) {
    if (header.wavelength_nm.empty()) {
        throw InputError({.where = header.source,
                          .problem = "has no \"wavelength\"",
                          .why = "without wavelengths the bands are no spectra",
                          .remedy = "add \"wavelength = {...}\" with one number per band"});
    }
    std::vector<std::size_t> bands;
    for (std::size_t band = 0; band < header.bands; ++band) {
        if (header.good[band]) bands.push_back(band);
    }
    if (bands.empty()) {
        throw InputError({.where = header.source,
                          .problem = "\"bbl\" marks every band as bad",
                          .why = "nothing is left to read",
                          .remedy = "set 1 for the good bands"});
    }
    std::ranges::stable_sort(bands, {}, [&](std::size_t band) { return header.wavelength_nm[band]; });
    check_wavelengths(header, bands);
    return bands;
}

bool has_gains(const EnviHeader& header) {
    return !header.gain.empty() || !header.data_offset.empty();
}

CubeScale choose_scale(const EnviHeader& header, std::optional<Unit> unit) {
    constexpr double percent = 100;
    const std::string gains = has_gains(header) ? ", after the header's gains and offsets" : "";
    if (unit == Unit::percent) return {.one = percent, .rule = "percent: stated by the option" + gains, .stated = true};
    if (unit == Unit::fraction) return {.one = 1, .rule = "fraction: stated by the option" + gains, .stated = true};
    if (header.reflectance_scale_factor) {
        const double one = *header.reflectance_scale_factor;
        return {.one = one,
                .rule = fmt::format("fraction: after division by the header's scale factor {}{}", one, gains),
                .stated = true};
    }
    if (header.percent) return {.one = percent, .rule = "percent: stated by the header" + gains, .stated = true};
    if (has_gains(header)) return {.one = 1, .rule = "fraction: by the header's gains and offsets", .stated = false};
    if (!header.data_type.whole()) {
        return {.one = 1, .rule = "fraction: the header has no scale factor", .stated = false};
    }
    throw InputError({.where = header.source,
                      .problem = "has no \"reflectance scale factor\"",
                      .why = "its data are whole numbers, and which of them stands for 1 is not known",
                      .remedy = "add \"reflectance scale factor = 10000\", or whichever number stands for 1"});
}

/// The header, where what it says of the values can be used.
EnviHeader checked(EnviHeader header, std::optional<Unit> unit) {
    if (header.file_type.find("classification") != std::string::npos) {
        throw InputError({.where = header.source,
                          .problem = "holds a classification",
                          .why = "numbers of classes are no light",
                          .remedy = "name the cube it was made from"});
    }
    const std::optional<EnviStatement>& other = header.other_quantity;
    if (!other || (other->in_prose && unit)) return header;
    throw InputError({.where = fmt::format("{}:{}", header.source, other->line),
                      .problem = fmt::format("{} is {}", in_quotes(other->key), in_quotes(other->value)),
                      .why = fmt::format("{} is no reflectance or transmittance", other->word),
                      .remedy = remedy_for(other->word) + (other->in_prose ? "; if the values are reflectances, say so "
                                                                             "in the header or with --unit"
                                                                           : "; if they are, correct the header")});
}

}  // namespace

SpectralCube::SpectralCube(const std::filesystem::path& path, std::optional<Unit> unit)
    : SpectralCube(find_envi_files(path), unit) {}

SpectralCube::SpectralCube(EnviFiles files, std::optional<Unit> unit)
    : files_(std::move(files)),
      header_(checked(read_envi_header(files_), unit)),
      bands_(choose_bands(header_)),
      scale_(choose_scale(header_, unit)),
      ignored_(stored_ignore_value(header_)),
      numbers_(open_envi_data(files_, header_)) {
    for (const std::size_t band : bands_) wavelength_nm_.push_back(header_.wavelength_nm[band]);
}

std::size_t SpectralCube::lines_at_once() const {
    constexpr std::size_t bytes = std::size_t{24} << 20U;
    return std::clamp<std::size_t>(bytes / (sizeof(double) * samples() * header_.bands), 1, lines());
}

bool SpectralCube::is_missing(double number) const {
    constexpr double largest = 1e30;  // chosen: beyond it stand fills such as 1e34, and bytes in the wrong order
    // Fills of remote sensing and of 16-bit data, whether stated or not.
    return number == ignored_ || number == -9999 || number == -32768 || !(std::abs(number) < largest);
}

double SpectralCube::fraction(double number, std::size_t i) const {
    if (is_missing(number)) return missing;
    if (!header_.gain.empty()) number *= header_.gain[bands_[i]];
    if (!header_.data_offset.empty()) number += header_.data_offset[bands_[i]];
    return number / scale_.one;
}

double SpectralCube::fraction_of_zero(std::size_t i) const {
    return header_.data_offset.empty() ? 0.0 : header_.data_offset[bands_[i]] / scale_.one;
}

std::vector<double> SpectralCube::read_lines(std::size_t first, std::size_t count) const {
    assert(first + count <= lines());
    const std::vector<double> numbers = read_numbers(numbers_, header_, first, count);
    const Strides stride = strides(header_, count);
    std::vector<double> fractions(count * samples() * bands_.size());
    // Block by block: where a pixel's bands lie far apart, both the numbers and the fractions stay in the cache.
    constexpr std::size_t block = 16;
    for (std::size_t line = 0; line < count; ++line) {
        for (std::size_t start = 0; start < samples(); start += block) {
            const std::size_t end = std::min(start + block, samples());
            for (std::size_t i = 0; i < bands_.size(); ++i) {
                const double* const from = &numbers[line * stride.line + bands_[i] * stride.band];
                double* const to = &fractions[line * samples() * bands_.size() + i];
                for (std::size_t sample = start; sample < end; ++sample) {
                    to[sample * bands_.size()] = fraction(from[sample * stride.sample], i);
                }
            }
            for (std::size_t sample = start; sample < end; ++sample) {
                const double* const pixel = &numbers[line * stride.line + sample * stride.sample];
                double* const to = &fractions[(line * samples() + sample) * bands_.size()];
                if (is_one_number(pixel, stride.band, bands_)) std::fill_n(to, bands_.size(), missing);
            }
        }
    }
    return fractions;
}

}  // namespace skinfit
