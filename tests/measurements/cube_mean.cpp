#include "measurements/cube_mean.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "core/input_error.hpp"
#include "tests/measurements/made_cube.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using test::MadeCube;

class CubeMeans : public test::TemporaryFolder {
protected:
    [[nodiscard]] CubeMean mean(const MadeCube& made, const RegionChoice& choice = {}) const {
        test::write_cube(in_folder("cube.hdr"), made);
        const SpectralCube cube(in_folder("cube.hdr"));
        return mean_spectrum(cube, CubeRegion(choice, cube));
    }
};

/// The mean over pixels and its standard uncertainty by their definitions, in two passes.
void expect_mean(const CubeMean& mean, const MadeCube& made,
                 const std::vector<std::pair<std::size_t, std::size_t>>& lines_and_samples) {
    const auto n = static_cast<double>(lines_and_samples.size());
    ASSERT_EQ(mean.pixels, lines_and_samples.size());
    ASSERT_EQ(mean.value.size(), made.bands);
    ASSERT_EQ(mean.sigma.size(), made.bands);
    for (std::size_t band = 0; band < made.bands; ++band) {
        double sum = 0;
        for (const auto& [line, sample] : lines_and_samples) sum += made.number(line, sample, band) / 100;
        double squares = 0;
        for (const auto& [line, sample] : lines_and_samples) {
            squares += std::pow(made.number(line, sample, band) / 100 - sum / n, 2);
        }
        // Sums of at most 20 numbers of order 1: each operation rounds by half an epsilon of at most their sum.
        const double bound = 20 * 20 * std::numeric_limits<double>::epsilon();
        EXPECT_NEAR(mean.value[band], sum / n, bound);
        EXPECT_NEAR(std::pow(mean.sigma[band], 2), squares / (n - 1) / n, bound);
    }
}

std::string bytes_of_hex(std::string_view digits) {
    std::string bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2) {
        unsigned byte = 0;
        std::from_chars(digits.data() + i, digits.data() + i + 2, byte, 16);
        bytes += static_cast<char>(byte);
    }
    return bytes;
}

std::vector<std::pair<std::size_t, std::size_t>> block(const Rectangle& r) {
    std::vector<std::pair<std::size_t, std::size_t>> pixels;
    for (std::size_t line = r.first_line; line < r.first_line + r.lines; ++line) {
        for (std::size_t i = r.first_sample; i < r.first_sample + r.samples; ++i) pixels.emplace_back(line, i);
    }
    return pixels;
}

TEST_F(CubeMeans, AverageTheWholeCubeOrTheRectangle) {
    for (const std::string interleave : {"bsq", "bil", "bip"}) {
        const MadeCube made{.interleave = interleave};
        expect_mean(mean(made), made, block({.first_sample = 0, .first_line = 0, .samples = 5, .lines = 4}));
        const Rectangle rectangle{.first_sample = 1, .first_line = 2, .samples = 3, .lines = 2};
        expect_mean(mean(made, {.rectangle = rectangle}), made, block(rectangle));
    }
}

TEST_F(CubeMeans, OfOnePixelAreThatPixelWithoutUncertainty) {
    const MadeCube made;
    const CubeMean one =
        mean(made, {.rectangle = Rectangle{.first_sample = 4, .first_line = 3, .samples = 1, .lines = 1}});
    EXPECT_EQ(one.value, (std::vector<double>{made.number(3, 4, 0) / 100, made.number(3, 4, 1) / 100,
                                              made.number(3, 4, 2) / 100}));
    EXPECT_TRUE(one.sigma.empty());
}

TEST_F(CubeMeans, AverageThePixelsOfTheMaskWithinTheRectangle) {
    const MadeCube made;
    std::vector<double> mask(20, 0);
    mask[1] = 1;     // line 0, sample 1
    mask[7] = -3;    // line 1, sample 2
    mask[8] = NAN;   // not chosen
    mask[19] = 0.5;  // line 3, sample 4
    for (const bool most_significant_first : {false, true}) {
        const MadeCube picture{
            .bands = 1, .data_type = 4, .most_significant_byte_first = most_significant_first, .more = ""};
        test::write_text(in_folder("mask.hdr"), test::header_text(picture));
        test::write_text(in_folder("mask.dat"), test::stored(mask, 4, most_significant_first));
        for (const std::string name : {"mask.hdr", "mask.dat"}) {
            expect_mean(mean(made, {.mask = in_folder(name)}), made, {{0, 1}, {1, 2}, {3, 4}});
        }
    }
    const Rectangle upper{.first_sample = 0, .first_line = 0, .samples = 5, .lines = 2};
    expect_mean(mean(made, {.mask = in_folder("mask.hdr"), .rectangle = upper}), made, {{0, 1}, {1, 2}});
}

TEST_F(CubeMeans, ReadMasksThatArePngOrTiff) {
    // 5 x 4 pixels of 8 bits; those of lines 0 and 2 at sample 3 are 255, all others 0.
    const std::string tiff = [] {
        std::string bytes("II*\0\x08\0\0\0", 8);
        const auto put16 = [&](int v) { bytes += {static_cast<char>(v & 0xff), static_cast<char>(v >> 8)}; };
        const auto entry = [&](int tag, int type, int value) {
            for (const int part : {tag, type, 1, 0, value, 0}) put16(part);
        };
        put16(8);
        entry(256, 3, 5), entry(257, 3, 4), entry(258, 3, 8), entry(259, 3, 1), entry(262, 3, 1);
        entry(273, 4, 8 + 2 + 8 * 12 + 4), entry(278, 3, 4), entry(279, 4, 20);
        bytes += std::string(4, '\0');
        std::string pixels(20, '\0');
        pixels[3] = pixels[13] = '\xff';
        return bytes + pixels;
    }();
    const std::string png = bytes_of_hex(
        "89504e470d0a1a0a0000000d49484452000000050000000408000000006358aa9c0000001149444154789c63606060f8cf80003036001b"
        "fc01ffbea95f370000000049454e44ae426082");
    test::write_text(in_folder("mask.tif"), tiff);
    test::write_text(in_folder("mask.png"), png);
    const MadeCube made;
    for (const std::string name : {"mask.tif", "mask.png"}) {
        SCOPED_TRACE(name);
        expect_mean(mean(made, {.mask = in_folder(name)}), made, {{0, 3}, {2, 3}});
    }
    EXPECT_EQ(entries(), 4) << "nothing is written beside the files";
}

TEST_F(CubeMeans, LeaveOutPixelsWithAMissingNumberAndCountThem) {
    const MadeCube made{.more =
                            "wavelength = {400, 500, 600}\nreflectance scale factor = 100\ndata ignore value = 22\n"};
    auto all = block({.first_sample = 0, .first_line = 0, .samples = 5, .lines = 4});
    std::erase(all, std::pair<std::size_t, std::size_t>{0, 1});  // whose second band is 22
    const CubeMean read = mean(made);
    expect_mean(read, made, all);
    EXPECT_EQ(read.incomplete, 1U);
}

TEST_F(CubeMeans, AreRefusedWhereNoPixelIsComplete) {
    const Rectangle pixel{.first_sample = 1, .first_line = 0, .samples = 1, .lines = 1};
    try {
        (void)mean({.more = "wavelength = {400, 500, 600}\nreflectance scale factor = 100\ndata ignore value = 22\n"},
                   {.rectangle = pixel});
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  in_folder("cube.dat").string() +
                      ": the region holds no complete pixel (pixels chosen: 1; each lacks a number in some good "
                      "band, or is one and the same number in all); choose another mask or rectangle, or mark the "
                      "bands without data as bad in \"bbl\"");
    }
}

}  // namespace
}  // namespace skinfit
