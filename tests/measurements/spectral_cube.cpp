#include "measurements/spectral_cube.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/input_error.hpp"
#include "tests/measurements/made_cube.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using test::MadeCube;

class Cube : public test::TemporaryFolder {
protected:
    [[nodiscard]] SpectralCube written(const MadeCube& cube, std::optional<Unit> unit = {}) const {
        test::write_cube(in_folder("cube.hdr"), cube);
        return SpectralCube(in_folder("cube.hdr"), unit);
    }
};

/// All lines, read `step` at a time.
std::vector<double> all_lines(const SpectralCube& cube, std::size_t step) {
    std::vector<double> all;
    for (std::size_t first = 0; first < cube.lines(); first += step) {
        const std::vector<double> part = cube.read_lines(first, std::min(step, cube.lines() - first));
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

/// The cube's numbers pixel by pixel, divided by `one`.
std::vector<double> expected(const MadeCube& cube, double one) {
    std::vector<double> all;
    for (std::size_t line = 0; line < cube.lines; ++line) {
        for (std::size_t i = 0; i < cube.samples; ++i) {
            for (std::size_t band = 0; band < cube.bands; ++band) all.push_back(cube.number(line, i, band) / one);
        }
    }
    return all;
}

TEST_F(Cube, EveryInterleaveTypeAndByteOrderGivesTheSameNumbers) {
    for (const std::string interleave : {"bsq", "bil", "bip"}) {
        for (const int data_type : {1, 2, 3, 4, 5, 12, 13, 14, 15}) {
            for (const bool most_significant_first : {false, true}) {
                for (const std::size_t offset : {0U, 7U}) {
                    SCOPED_TRACE(testing::Message() << interleave << " type " << data_type << " order "
                                                    << most_significant_first << " offset " << offset);
                    const MadeCube made{.interleave = interleave,
                                        .data_type = data_type,
                                        .most_significant_byte_first = most_significant_first,
                                        .header_offset = offset};
                    const SpectralCube cube = written(made);
                    EXPECT_EQ(all_lines(cube, 4), expected(made, 100));
                    EXPECT_EQ(all_lines(cube, 3), expected(made, 100));
                    EXPECT_EQ(all_lines(cube, 1), expected(made, 100));
                }
            }
        }
    }
}

TEST_F(Cube, SignsAndFractionsSurviveInEveryTypeThatHasThem) {
    const std::vector<double> numbers{-1, -128, 127, -0.0};
    for (const int data_type : {2, 3, 4, 5, 14}) {
        const MadeCube made{
            .samples = 4, .lines = 1, .bands = 1, .data_type = data_type, .more = "wavelength = {500}\n"};
        test::write_text(in_folder("cube.hdr"), test::header_text(made));
        test::write_text(in_folder("cube.dat"), test::stored(numbers, data_type, false));
        EXPECT_EQ(SpectralCube(in_folder("cube.hdr"), Unit::fraction).read_lines(0, 1), numbers) << data_type;
    }
    const std::vector<double> fine{0.1, 1e-300, 1e29, -0.3};
    const MadeCube made{.samples = 4, .lines = 1, .bands = 1, .data_type = 5, .more = "wavelength = {500}\n"};
    test::write_text(in_folder("cube.hdr"), test::header_text(made));
    test::write_text(in_folder("cube.dat"), test::stored(fine, 5, false));
    EXPECT_EQ(SpectralCube(in_folder("cube.hdr")).read_lines(0, 1), fine);
}

TEST_F(Cube, IsNamedByItsHeaderOrItsData) {
    const MadeCube made;
    test::write_cube(in_folder("a.hdr"), made);
    const std::vector<double> numbers = expected(made, 100);
    EXPECT_EQ(SpectralCube(in_folder("a.hdr")).read_lines(0, 4), numbers);
    EXPECT_EQ(SpectralCube(in_folder("a.dat")).read_lines(0, 4), numbers);

    for (const std::string data : {"b", "c.raw", "d.BIL", "e f&<g>.img"}) {
        std::filesystem::copy_file(in_folder("a.dat"), in_folder(data));
        std::filesystem::copy_file(in_folder("a.hdr"), in_folder(data + ".hdr"));
        EXPECT_EQ(SpectralCube(in_folder(data)).read_lines(0, 4), numbers);
        EXPECT_EQ(SpectralCube(in_folder(data + ".hdr")).read_lines(0, 4), numbers);
    }
    std::filesystem::copy_file(in_folder("a.dat"), in_folder("h.RAW"));
    std::filesystem::copy_file(in_folder("a.hdr"), in_folder("h.HDR"));
    EXPECT_EQ(SpectralCube(in_folder("h.RAW")).read_lines(0, 4), numbers);
    EXPECT_EQ(SpectralCube(in_folder("h.HDR")).read_lines(0, 4), numbers);
}

TEST_F(Cube, FractionsAreNumbersOverTheScaleFactorUnlessAnOptionStatesTheUnit) {
    const MadeCube scaled{.more = "wavelength = {400, 500, 600}\nreflectance scale factor = 8.0\n"};
    EXPECT_EQ(written(scaled).read_lines(0, 4), expected(scaled, 8));
    EXPECT_EQ(written(scaled, Unit::percent).read_lines(0, 4), expected(scaled, 100));
    EXPECT_EQ(written(scaled, Unit::fraction).read_lines(0, 4), expected(scaled, 1));
    const MadeCube plain{.data_type = 4, .more = "wavelength = {400, 500, 600}\n"};
    EXPECT_EQ(written(plain).read_lines(0, 4), expected(plain, 1));
    EXPECT_EQ(written(scaled).unit_rule(), "fraction: after division by the header's scale factor 8");
    EXPECT_EQ(written(plain).unit_rule(), "fraction: the header has no scale factor");
}

TEST_F(Cube, WavelengthsAreNanometresWhicheverUnitTheyAreIn) {
    const std::vector<double> nm{400, 500, 2500};
    const auto with = [&](const std::string& lines) {
        return written({.more = "reflectance scale factor = 1\n" + lines}).wavelength_nm();
    };
    EXPECT_EQ(with("wavelength = {400, 500, 2500}\n"), nm);
    EXPECT_EQ(with("wavelength = {0.4, 0.5, 2.5}\n"), nm);
    EXPECT_EQ(with("Wavelength Units = Micrometers\nWAVELENGTH = {0.4,0.5,\n 2.5,\n}\n"), nm);
    EXPECT_EQ(with("wavelength units = \xC2\xB5m\nwavelength = {.4,.5,2.5}\n"), nm);
    EXPECT_EQ(with("wavelength units = Nanometers\r\nwavelength = {\r\n400,\r\n500,\r\n2.5e3}\r\n"), nm);
    EXPECT_EQ(with("wavelength units = Unknown\nwavelength = {400,500,2500}"), nm);
}

TEST_F(Cube, BadBandsAreLeftOutAndTheRestAscendsByWavelength) {
    for (const std::string interleave : {"bsq", "bil", "bip"}) {
        const MadeCube made{.bands = 5,
                            .interleave = interleave,
                            .more =
                                "wavelength = {700, 600, 500, 0, 650}\nbbl = {1, 1, 0, 0, 1}\n"
                                "reflectance scale factor = 1\n"};
        const SpectralCube cube = written(made);
        EXPECT_EQ(cube.bands(), (std::vector<std::size_t>{1, 4, 0}));
        EXPECT_EQ(cube.wavelength_nm(), (std::vector<double>{600, 650, 700}));
        const std::vector<double> line = cube.read_lines(2, 1);
        for (std::size_t i = 0; i < made.samples; ++i) {
            EXPECT_EQ(line[3 * i], made.number(2, i, 1));
            EXPECT_EQ(line[3 * i + 1], made.number(2, i, 4));
            EXPECT_EQ(line[3 * i + 2], made.number(2, i, 0));
        }
    }
}

TEST_F(Cube, IgnoredAndInfiniteNumbersAreMissing) {
    const double infinity = std::numeric_limits<double>::infinity();
    const std::vector<double> numbers{0.25, -0.1, infinity, std::nan(""), -infinity};
    for (const int data_type : {4, 5}) {
        const MadeCube made{
            .lines = 1, .bands = 1, .data_type = data_type, .more = "wavelength = {500}\ndata ignore value = -0.1\n"};
        test::write_text(in_folder("cube.hdr"), test::header_text(made));
        test::write_text(in_folder("cube.dat"), test::stored(numbers, data_type, false));
        const std::vector<double> read = SpectralCube(in_folder("cube.hdr")).read_lines(0, 1);
        EXPECT_EQ(read[0], 0.25);
        for (std::size_t i = 1; i < numbers.size(); ++i) EXPECT_TRUE(std::isnan(read[i])) << i;
    }
}

TEST_F(Cube, LinesOfManyNumbersInBlocksAreStillTheSame) {
    // More samples than a block of the transposition and more lines than are read at once.
    for (const std::string interleave : {"bsq", "bil", "bip"}) {
        const MadeCube made{.samples = 37, .lines = 11, .interleave = interleave, .data_type = 13};
        EXPECT_EQ(all_lines(written(made), 4), expected(made, 100));
    }
}

}  // namespace
}  // namespace skinfit
