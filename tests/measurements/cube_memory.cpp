#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>

#include "measurements/cube_mean.hpp"
#include "tests/measurements/made_cube.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

class CubeMemory : public test::TemporaryFolder, public testing::WithParamInterface<std::string> {};

double value_of_band(std::size_t band) {
    return static_cast<double>(band + 1) / 256;
}

/// Gives the pixels of the first line their values; all others stay 0.
void put_first_line(const test::MadeCube& made, const std::filesystem::path& path) {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    for (std::size_t band = 0; band < made.bands; ++band) {
        const double value = value_of_band(band);
        for (std::size_t sample = 0; sample < made.samples; ++sample) {
            const std::size_t place = made.interleave == "bip"   ? sample * made.bands + band
                                      : made.interleave == "bil" ? band * made.samples + sample
                                                                 : band * made.lines * made.samples + sample;
            file.seekp(static_cast<std::streamoff>(place * sizeof value));
            file.write(reinterpret_cast<const char*>(&value), sizeof value);
        }
    }
}

TEST_P(CubeMemory, StaysBelow300MegabytesForACubeOfOneGigabyte) {
    test::MadeCube made{.samples = 1000, .lines = 1000, .bands = 125, .interleave = GetParam(), .data_type = 5};
    made.more = "wavelength = {";
    for (std::size_t band = 0; band < made.bands; ++band) made.more += std::to_string(400 + band) + ", ";
    made.more += "}\n";
    test::write_text(in_folder("cube.hdr"), test::header_text(made));
    test::write_text(in_folder("cube.dat"), "");
    std::filesystem::resize_file(in_folder("cube.dat"), 1'000'000'000);  // a hole: no disk is used
    put_first_line(made, in_folder("cube.dat"));

    const SpectralCube cube(in_folder("cube.hdr"));
    const CubeMean mean = mean_spectrum(cube, CubeRegion({}, cube));
    EXPECT_EQ(mean.pixels, made.samples) << "the others are 0 in all bands, as masked ones are";
    for (std::size_t band = 0; band < made.bands; ++band) EXPECT_EQ(mean.value[band], value_of_band(band)) << band;
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer keeps what was given back";
#endif
    struct rusage used {};
    ASSERT_EQ(::getrusage(RUSAGE_SELF, &used), 0);
    const long kibibytes = used.ru_maxrss;
    EXPECT_LT(kibibytes, 300'000'000 / 1024);
    RecordProperty("kibibytes", std::to_string(kibibytes));
}

INSTANTIATE_TEST_SUITE_P(Interleaves, CubeMemory, testing::Values("bsq", "bil", "bip"),
                         [](const auto& interleave) { return interleave.param; });

}  // namespace
}  // namespace skinfit
