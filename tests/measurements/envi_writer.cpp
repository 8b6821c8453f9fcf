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

class EnviWriterTest : public test::TemporaryFolder {};

const float missing = std::numeric_limits<float>::quiet_NaN();

/// Two lines of two bands of three pixels, in the order of the file.
const std::vector<std::vector<float>> line_of_bands = {
    {0.1F, 0.2F, 0.3F}, {1e-38F, -1, 2}, {0.4F, 0.5F, missing}, {3e38F, 0, 7}};

EnviOutput output() {
    return {.samples = 3,
            .lines = 2,
            .band_names = {"melanosome_fraction", "oxygen_saturation"},
            .description = "made {up}\nhere",
            .place = {"map info = {UTM, 1, 1, 500000, 4000000, 0.5, 0.5, 33, North}", "x start = 4"}};
}

std::string bytes_of(const std::vector<float>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)};
}

TEST_F(EnviWriterTest, WritesInPartsWhatIsReadBack) {
    EnviWriter writer(in_folder("maps.dat"), output());
    for (const std::vector<float>& numbers : line_of_bands) {
        EXPECT_FALSE(std::filesystem::exists(in_folder("maps.dat")));
        writer.append(bytes_of(numbers));
    }
    writer.finish();
    EXPECT_EQ(entries(), 2);
    EXPECT_EQ(read_file(in_folder("maps.hdr")),
              "ENVI\ndescription = {made (up) here}\nsamples = 3\nlines = 2\nbands = 2\nheader offset = 0\n"
              "file type = ENVI Standard\ndata type = 4\ninterleave = bil\nbyte order = 0\ndata ignore value = nan\n"
              "band names = {melanosome_fraction, oxygen_saturation}\n"
              "map info = {UTM, 1, 1, 500000, 4000000, 0.5, 0.5, 33, North}\nx start = 4\n");

    const EnviFiles files = find_envi_files(in_folder("maps.dat"));
    const EnviHeader header = read_envi_header(files);
    EXPECT_EQ(header.band_names, output().band_names);
    EXPECT_EQ(header.place, output().place);
    const std::vector<double> read = open_envi_data(files, header).read_rows(0, 4);
    for (std::size_t i = 0; i < read.size(); ++i) {
        const float written = line_of_bands[i / 3][i % 3];
        if (std::isnan(written)) {
            EXPECT_TRUE(std::isnan(read[i]));
        } else {
            EXPECT_EQ(read[i], static_cast<double>(written));
        }
    }
}

TEST_F(EnviWriterTest, WithoutItsEndTheOldFileStaysAndNothingElse) {
    write_file_atomically(in_folder("maps.dat"), "old");
    {
        EnviWriter writer(in_folder("maps.dat"), output());
        writer.append(bytes_of(line_of_bands[0]));
        EXPECT_EQ(entries(), 2);
    }
    EXPECT_EQ(entries(), 1);
    EXPECT_EQ(read_file(in_folder("maps.dat")), "old");
}

TEST_F(EnviWriterTest, RefusesToReplaceDataByTheirHeader) {
    EXPECT_THROW(EnviWriter(in_folder("maps.hdr"), output()), InputError);
    EXPECT_EQ(entries(), 0);
}

TEST_F(EnviWriterTest, RefusesAMissingFolder) {
    try {
        const EnviWriter writer(in_folder("none") / "maps.dat", output());
        FAIL();
    } catch (const InputError& error) {
        EXPECT_TRUE(std::string(error.what())
                        .starts_with((in_folder("none") / "maps.dat").string() +
                                     ": cannot be written (No such file or directory)"))
            << error.what();
    }
}

}  // namespace
}  // namespace skinfit
