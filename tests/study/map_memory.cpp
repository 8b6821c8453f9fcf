#include <gtest/gtest.h>
#include <sys/resource.h>

#include "measurements/envi_reader.hpp"
#include "measurements/envi_writer.hpp"
#include "study/map_file.hpp"
#include "study/map_tile.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/measurements/made_cube.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit::test {
namespace {

class MapMemory : public TemporaryFolder, public testing::WithParamInterface<std::string> {};

TEST_P(MapMemory, StaysBelow300MegabytesForACubeOfOneGigabyte) {
    MadeCube made{.samples = 1000, .lines = 1000, .bands = 250, .interleave = GetParam(), .data_type = 4};
    made.more = "wavelength = {";
    for (std::size_t band = 0; band < made.bands; ++band) made.more += std::to_string(401 + band) + ", ";
    made.more += "}\n";
    write_text(in_folder("cube.hdr"), header_text(made));
    write_text(in_folder("cube.dat"), "");
    std::filesystem::resize_file(in_folder("cube.dat"), 1'000'000'000);  // a hole: no disk is used

    const SpectralCube cube(in_folder("cube.hdr"));
    Configuration configuration = with_free(default_configuration(), {Parameter::melanosome_fraction});
    configuration.wavelength_max_nm = 430;
    const PixelFitter fitter(configuration, common_spectrum(cube), no_cache());
    // A stripe is enough: whole lines are read all the same.
    const CubeRegion region(
        {.rectangle = Rectangle{.first_sample = 500, .first_line = 0, .samples = 10, .lines = 1000}}, cube);
    EnviWriter writer(in_folder("map.dat"), map_output(fitter.problem(), cube, ""));
    std::uint64_t masked = 0;
    for (std::size_t first = 0; first < cube.lines(); first += tile_lines(cube)) {
        const MapTile tile = fit_tile(fitter, cube, region, first, std::min(tile_lines(cube), cube.lines() - first));
        masked += tile.pixels[static_cast<std::size_t>(FitStatus::masked)];
        writer.append(tile.bytes);
    }
    writer.finish();
    EXPECT_EQ(masked, 1'000'000U) << "those outside the region, and those that are 0 in all bands";
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer keeps what was given back";
#endif
    struct rusage used {};
    ASSERT_EQ(::getrusage(RUSAGE_SELF, &used), 0);
    EXPECT_LT(used.ru_maxrss, 300'000'000 / 1024);
    RecordProperty("kibibytes", std::to_string(used.ru_maxrss));
}

INSTANTIATE_TEST_SUITE_P(Interleaves, MapMemory, testing::Values("bsq", "bil", "bip"),
                         [](const auto& interleave) { return interleave.param; });

}  // namespace
}  // namespace skinfit::test
