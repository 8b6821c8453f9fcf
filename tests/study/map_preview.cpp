#include "study/map_preview.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "measurements/envi_writer.hpp"
#include "study/map_reduction.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit::test {
namespace {

const float missing = std::nanf("");

/// A map of three planes and 5 x 3 pixels.
class MapPreview : public TemporaryFolder {
protected:
    void write_map(const std::vector<std::string>& names, const std::vector<std::vector<float>>& planes) const {
        EnviWriter writer(in_folder("map.dat"),
                          {.samples = 5, .lines = 3, .band_names = names, .description = "made up"});
        for (std::size_t line = 0; line < 3; ++line) {
            for (const std::vector<float>& plane : planes) {
                writer.append({reinterpret_cast<const char*>(&plane[line * 5]), 5 * sizeof(float)});
            }
        }
        writer.finish();
    }

    const std::vector<float> value_ = {1, 2, 3, 4, 5, 6, 7, missing, 9, 10, 11, 12, 13, missing, 15};
    const std::vector<float> status_ = {1, 1, 2, 3, 5, 1, 2, 5, 5, 5, 1, 4, 2, 2, 5};
    const std::vector<float> reason_ = {0, 0, 12, 1, missing, 0, 12, missing, missing, missing, 0, 11, 14, 12, missing};
};

TEST_F(MapPreview, ReducesByMeansOfNumbersAndByMajoritiesOfWords) {
    write_map({"melanosome_fraction", "status", "reason"}, {value_, status_, reason_});
    const ReducedMap whole = reduced_map(in_folder("map.dat"), 5);
    EXPECT_EQ(whole.block, 1U);
    EXPECT_EQ(whole.planes[1].value, status_);
    const ReducedMap map = reduced_map(in_folder("map.dat"), 4);
    EXPECT_EQ(map.block, 2U);
    EXPECT_EQ(map.samples, 3U);
    EXPECT_EQ(map.lines, 2U);
    EXPECT_EQ(map.pixels, 15U);
    ASSERT_EQ(map.planes.size(), 3U);
    EXPECT_EQ(map.planes[0].name, "melanosome_fraction");
    EXPECT_EQ(map.planes[0].value, (std::vector<float>{4, 16.0F / 3, 7.5F, 11.5F, 13, 15}));
    EXPECT_EQ(map.planes[1].value, (std::vector<float>{1, 5, 5, 1, 2, 5}));
    EXPECT_EQ(map.planes[1].pixels, (std::map<float, std::uint64_t>{{1, 4}, {2, 4}, {3, 1}, {4, 1}, {5, 5}}));
    EXPECT_EQ(map.planes[2].value[0], 0.0F);
    EXPECT_TRUE(std::isnan(map.planes[2].value[2]));
}

TEST_F(MapPreview, DrawsOnePictureForEachParameterAndTwoMore) {
    write_map({"melanosome_fraction", "melanosome_fraction_sigma", "status", "reason", "rmse", "chi2"},
              {value_, value_, status_, reason_, value_, value_});
    const std::vector<std::filesystem::path> pictures = draw_map(in_folder("map.dat"), in_folder(""));
    ASSERT_EQ(pictures.size(), 3U);
    EXPECT_EQ(pictures[0].filename(), "map_melanosome_fraction.png");
    EXPECT_EQ(pictures[1].filename(), "map_status.png");
    EXPECT_EQ(pictures[2].filename(), "map_misfit.png");
    for (const std::filesystem::path& picture : pictures) {
        EXPECT_TRUE(read_file(picture).starts_with("\x89PNG")) << picture;
    }
}

TEST_F(MapPreview, DrawsMapsWithoutAnyNumber) {
    const std::vector<float> nothing(15, missing);
    const std::vector<float> masked(15, 5);
    write_map({"melanosome_fraction", "melanosome_fraction_sigma", "status", "reason", "rmse", "chi2"},
              {nothing, nothing, masked, nothing, nothing, nothing});
    EXPECT_EQ(draw_map(in_folder("map.dat"), in_folder("")).size(), 3U);
}

TEST_F(MapPreview, DrawsMapsOfOnePixel) {
    EnviWriter writer(
        in_folder("one.dat"),
        {.samples = 1, .lines = 1, .band_names = {"status", "reason", "rmse", "chi2"}, .description = "made up"});
    const std::vector<float> numbers = {1, 0, 0.01F, 30};
    writer.append({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)});
    writer.finish();
    EXPECT_EQ(draw_map(in_folder("one.dat"), in_folder("")).size(), 2U);
}

TEST_F(MapPreview, RefusesWhatIsNoMap) {
    const auto refusal = [&] {
        try {
            (void)draw_map(in_folder("map.dat"), in_folder(""));
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    write_map({"red", "green"}, {value_, value_});
    EXPECT_EQ(refusal(), in_folder("map.dat").string() +
                             ": has no band called status (every map has); give a map that skinfit made");
    write_map({"status", "reason", "rmse", "chi2"}, {value_, value_, value_, value_});
    EXPECT_EQ(refusal(), in_folder("map.dat").string() +
                             ": has the number 6 in its band status (no status or reason has this number); give a map "
                             "that skinfit made");
}

}  // namespace
}  // namespace skinfit::test
