#include "measurements/envi_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "measurements/envi_files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

class EnviWriter : public test::TemporaryFolder {};

TEST_F(EnviWriter, WritesWhatIsReadBack) {
    const float missing = std::numeric_limits<float>::quiet_NaN();
    const Planes planes{.samples = 3,
                        .lines = 2,
                        .description = "made up",
                        .planes = {{.name = "melanosome_fraction", .value = {0.1F, 0.2F, 0.3F, 0.4F, 0.5F, missing}},
                                   {.name = "oxygen_saturation", .value = {1e-38F, -1, 2, 3e38F, 0, 7}}}};
    write_envi(in_folder("maps.dat"), planes);
    EXPECT_EQ(entries(), 2);
    EXPECT_EQ(read_file(in_folder("maps.hdr")),
              "ENVI\ndescription = {made up}\nsamples = 3\nlines = 2\nbands = 2\nheader offset = 0\n"
              "file type = ENVI Standard\ndata type = 4\ninterleave = bsq\nbyte order = 0\ndata ignore value = nan\n"
              "band names = {melanosome_fraction, oxygen_saturation}\n");

    const EnviFiles files = find_envi_files(in_folder("maps.dat"));
    const Raster raster = open_envi_data(files, read_envi_header(files));
    const std::vector<double> read = raster.read_rows(0, 4);
    for (std::size_t plane = 0; plane < 2; ++plane) {
        for (std::size_t i = 0; i < 6; ++i) {
            const double written = planes.planes[plane].value[i];
            if (std::isnan(written)) {
                EXPECT_TRUE(std::isnan(read[6 * plane + i]));
            } else {
                EXPECT_EQ(read[6 * plane + i], written);
            }
        }
    }
}

TEST_F(EnviWriter, RefusesToReplaceDataByTheirHeader) {
    EXPECT_THROW(write_envi(in_folder("maps.hdr"), {}), InputError);
    EXPECT_EQ(entries(), 0);
}

}  // namespace
}  // namespace skinfit
