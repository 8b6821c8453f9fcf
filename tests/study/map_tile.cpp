#include "study/map_tile.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "core/file.hpp"
#include "measurements/envi_reader.hpp"
#include "measurements/envi_writer.hpp"
#include "study/map_file.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/measurements/made_cube.hpp"
#include "tests/study/synthetic_cube.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit::test {
namespace {

/// A cube of 7 x 6 pixels in three files, one of each interleave, the first pixel without a number in one band; a mask.
class MapTileTest : public TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        for (const std::string interleave : {"bsq", "bil", "bip"}) {
            write_synthetic_cube(cube_, in_folder(interleave + ".hdr"), interleave);
        }
        MadeCube mask{.samples = 7, .lines = 6, .bands = 1, .data_type = 1, .more = ""};
        for (std::size_t pixel = 0; pixel < 42; ++pixel) mask.given.push_back(pixel % 4 == 1 ? 0 : 1);
        write_cube(in_folder("mask.hdr"), mask);
    }

    /// All tiles of `lines` lines, one after the other.
    [[nodiscard]] std::string map_bytes(const SpectralCube& cube, std::size_t lines,
                                        const RegionChoice& choice = {}) const {
        const PixelFitter fitter(cube_.configuration, common_spectrum(cube), no_cache());
        const CubeRegion region(choice, cube);
        std::string bytes;
        for (std::size_t first = 0; first < cube.lines(); first += lines) {
            bytes += fit_tile(fitter, cube, region, first, std::min(lines, cube.lines() - first)).bytes;
        }
        return bytes;
    }

    [[nodiscard]] static SyntheticCube made() {
        SyntheticCube cube = synthetic_cube(7, 6, 0.003, 2);
        cube.fractions[3] = std::nan("");
        return cube;
    }

    SyntheticCube cube_ = made();
};

std::vector<float> numbers_in(const std::string& bytes) {
    std::vector<float> numbers(bytes.size() / sizeof(float));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

/// As bits, since NaN differs from itself.
std::vector<std::uint32_t> bits_of(const std::vector<float>& numbers) {
    std::vector<std::uint32_t> bits;
    for (const float number : numbers) bits.push_back(std::bit_cast<std::uint32_t>(number));
    return bits;
}

TEST_F(MapTileTest, HoldsWhatAPlainLoopOverThePixelsFinds) {
    const SpectralCube cube(in_folder("bil.hdr"));
    const PixelFitter fitter(cube_.configuration, common_spectrum(cube), no_cache());
    const CubeRegion region({.mask = in_folder("mask.hdr"),
                             .rectangle = Rectangle{.first_sample = 0, .first_line = 0, .samples = 5, .lines = 5}},
                            cube);
    const MapTile tile = fit_tile(fitter, cube, region, 0, 6);
    const std::vector<double> fractions = cube.read_lines(0, 6);
    const std::vector<std::string> planes = map_planes(fitter.problem());
    ASSERT_EQ(planes.size(), 14U);
    EXPECT_EQ(planes[6], "oxygen_saturation");
    EXPECT_EQ(planes[7], "oxygen_saturation_sigma");
    EXPECT_EQ(planes[10], "status");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> expected(14UL * 42, nan);
    std::array<std::uint64_t, fit_status_names.size()> pixels{};
    for (std::size_t line = 0; line < 6; ++line) {
        for (std::size_t sample = 0; sample < 7; ++sample) {
            const std::size_t pixel = line * 7 + sample;
            const auto put = [&](std::size_t plane, double number) {
                expected[(line * 14 + plane) * 7 + sample] = static_cast<float>(number);
            };
            if (sample >= 5 || line >= 5 || pixel % 4 == 1) {
                put(10, static_cast<double>(FitStatus::masked));
                ++pixels[static_cast<std::size_t>(FitStatus::masked)];
                continue;
            }
            const PixelFit fit = fitter.fit(std::span(fractions).subspan(pixel * 31, 31));
            for (std::size_t i = 0; i < 5; ++i) {
                put(2 * i, fit.values[i]);
                put(2 * i + 1, fit.sigmas[i]);
            }
            put(10, static_cast<double>(fit.status));
            put(11, static_cast<double>(fit.reason));
            put(12, fit.rmse);
            put(13, fit.chi2);
            ++pixels[static_cast<std::size_t>(fit.status)];
        }
    }
    EXPECT_EQ(bits_of(numbers_in(tile.bytes)), bits_of(expected));
    EXPECT_EQ(tile.pixels, pixels);
    EXPECT_EQ(expected[77], static_cast<float>(PixelReason::missing_values));
    EXPECT_EQ(pixels[static_cast<std::size_t>(FitStatus::rejected)], 1U);
}

TEST_F(MapTileTest, DependsNeitherOnTilesNorInterleaveNorThreads) {
    const SpectralCube bsq(in_folder("bsq.hdr"));
    const std::string bytes = map_bytes(bsq, 6);
    EXPECT_EQ(bytes.size(), std::size_t{14} * 42 * sizeof(float));
    EXPECT_EQ(map_bytes(bsq, 1), bytes);
    EXPECT_EQ(map_bytes(bsq, 4), bytes);
    EXPECT_EQ(map_bytes(SpectralCube(in_folder("bil.hdr")), 2), bytes);
    EXPECT_EQ(map_bytes(SpectralCube(in_folder("bip.hdr")), 6), bytes);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(map_bytes(bsq, 6), bytes);
}

TEST_F(MapTileTest, AMapIsReadBackAsItWasWritten) {
    const SpectralCube cube(in_folder("bip.hdr"));
    const std::string bytes = map_bytes(cube, 6);
    const PixelFitter fitter(cube_.configuration, common_spectrum(cube), no_cache());
    const EnviOutput output = map_output(fitter.problem(), cube, "c0ffee");
    EnviWriter writer(in_folder("map.dat"), output);
    writer.append(bytes);
    writer.finish();

    const EnviFiles files = find_envi_files(in_folder("map.dat"));
    const EnviHeader header = read_envi_header(files);
    EXPECT_EQ(header.samples, 7U);
    EXPECT_EQ(header.lines, 6U);
    EXPECT_EQ(header.band_names, map_planes(fitter.problem()));
    EXPECT_EQ(header.place, std::vector<std::string>{"map info = {UTM, 1, 1, 5, 6, 0.5, 0.5, 33, North}"});
    EXPECT_TRUE(std::isnan(header.data_ignore_value.value()));
    const std::string text = read_file(files.header);
    for (const std::string part : {"skinfit ", "bip.dat", "c0ffee", "1 fitted", "5 masked", "12 misfit"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part;
    }
    std::vector<float> read;
    for (const double number : open_envi_data(files, header).read_rows(0, 14UL * 6)) {
        read.push_back(static_cast<float>(number));
    }
    EXPECT_EQ(bits_of(read), bits_of(numbers_in(bytes)));
}

TEST_F(MapTileTest, TilesAreWholeLinesOfSome8000Pixels) {
    const auto lines_of = [&](std::size_t samples, std::size_t lines) {
        const MadeCube made{.samples = samples, .lines = lines, .bands = 3, .data_type = 1};
        write_text(in_folder("large.hdr"), header_text(made));
        write_text(in_folder("large.dat"), "");
        std::filesystem::resize_file(in_folder("large.dat"), samples * lines * 3);
        return tile_lines(SpectralCube(in_folder("large.hdr")));
    };
    EXPECT_EQ(lines_of(1000, 1000), 8U);
    EXPECT_EQ(lines_of(100000, 10), 1U);
    EXPECT_EQ(lines_of(10, 20), 20U);
}

}  // namespace
}  // namespace skinfit::test
