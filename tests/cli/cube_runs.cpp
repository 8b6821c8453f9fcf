#include <limits>
#include <nlohmann/json.hpp>

#include "measurements/text_reader.hpp"
#include "tests/cli/cli_test.hpp"
#include "tests/measurements/made_cube.hpp"

namespace skinfit::test {
namespace {

/// A cube of 4 x 3 pixels: skin in the middle, a white frame about it, and slightly brighter skin in one pixel.
class CubeRuns : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        skin_ = read_spectrum(std::filesystem::path(SKINFIT_SOURCE_DIR) / "measurements/data/ncsu_113.csv");
        std::string wavelengths;
        for (const double nm : skin_.wavelength_nm) wavelengths += std::to_string(nm / 1000) + ", ";
        const MadeCube cube{.samples = 4,
                            .lines = 3,
                            .bands = skin_.value.size(),
                            .interleave = "bip",
                            .data_type = 5,
                            .more = "wavelength units = Micrometers\nwavelength = {" + wavelengths + "}\n"};
        std::vector<double> numbers;
        std::vector<double> mask;
        for (std::size_t pixel = 0; pixel < 12; ++pixel) {
            const bool is_skin = pixel == 5 || pixel == 6;
            const double brighter = pixel == 6 ? 1.02 : 1;
            mask.push_back(is_skin ? 1 : 0);
            for (const double value : skin_.value) numbers.push_back(is_skin ? brighter * value : 1);
        }
        write_text(folder() / "arm.hdr", header_text(cube));
        write_text(folder() / "arm.raw", stored(numbers, 5, false));
        const MadeCube picture{.samples = 4, .lines = 3, .bands = 1, .data_type = 1, .more = ""};
        write_text(folder() / "mask.hdr", header_text(picture));
        write_text(folder() / "mask.dat", stored(mask, 1, false));
    }

    Spectrum skin_;
};

TEST_F(CubeRuns, InspectSaysWhatTheRegionHolds) {
    const Outcome outcome = run({"inspect", "arm.hdr", "--rectangle", "1,1,2,1", "--format", "json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["spectra"], 1);
    EXPECT_EQ(json["names"], std::vector<std::string>{"arm"});
}

TEST_F(CubeRuns, ConvertGivesTheMeanOfTheMaskOrTheRectangle) {
    for (const std::vector<std::string>& region :
         {std::vector<std::string>{"--rectangle", "1,1,2,1"}, {"--mask", "mask.hdr"}, {"--mask", "mask.dat"}}) {
        std::vector<std::string> arguments{"convert", "arm.raw", "--out", "mean.csv"};
        arguments.insert(arguments.end(), region.begin(), region.end());
        const Outcome outcome = run(arguments);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const Spectrum mean = read_spectrum(folder() / "mean.csv");
        ASSERT_EQ(mean.value.size(), skin_.value.size());
        for (std::size_t i = 0; i < mean.value.size(); ++i) {
            // Half of the last of six decimals of a micrometre.
            EXPECT_NEAR(mean.wavelength_nm[i], skin_.wavelength_nm[i], 0.5e-6 * 1000);
            EXPECT_DOUBLE_EQ(mean.value[i], 1.01 * skin_.value[i]);
            // Two values about this large and their mean are each rounded once, and differenced.
            EXPECT_NEAR(mean.sigma[i], 0.01 * skin_.value[i],
                        4 * std::numeric_limits<double>::epsilon() * skin_.value[i]);
        }
        EXPECT_EQ(mean.sigma_source, "from the scatter of 2 pixels");
    }
}

TEST_F(CubeRuns, FitExplainsTheMean) {
    const Outcome outcome = run({"fit", "arm.hdr", "--mask", "mask.dat", "--format", "json"});
    ASSERT_LE(outcome.exit_code, 1) << outcome.err;
    EXPECT_NE(outcome.out.find(R"("unit_rule": "fraction: most values are at most 1.5")"), std::string::npos)
        << outcome.out;
}

TEST_F(CubeRuns, NoFileOfTheCubeIsReplaced) {
    for (const std::string file : {"arm.raw", "arm.hdr", "mask.dat", "mask.hdr"}) {
        const Outcome outcome = run({"convert", "arm.hdr", "--mask", "mask.dat", "--out", file});
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_TRUE(outcome.err.starts_with("error: --out " + file + ": is a file that is read")) << outcome.err;
    }
}

TEST_F(CubeRuns, MistakesAreExplained) {
    const auto message = [this](const std::vector<std::string>& arguments) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2);
        return outcome.err;
    };
    EXPECT_EQ(message({"fit", "arm.hdr", "--rectangle", "1,1,2"}),
              "error: --rectangle: is \"1,1,2\" (four whole numbers are needed, the last two above 0); give "
              "x,y,width,height in pixels, counted from 0, such as 10,20,5,5\n");
    EXPECT_EQ(message({"inspect", "arm.hdr", "--rectangle", "1,1,4,1"}),
              "error: the rectangle 1,1,4,1: reaches beyond the cube (arm.raw has 4 x 3 pixels); give x,y,width,height "
              "within it, counted from 0\n");
    put("text.csv", "400,0.5\n500,0.6\n");
    EXPECT_EQ(message({"convert", "text.csv", "--mask", "mask.dat"}),
              "error: text.csv: is no ENVI cube (a mask or rectangle chooses pixels of one); leave the mask and the "
              "rectangle out\n");
    EXPECT_EQ(message({"inspect", "text.csv", "--reader", "envi"}),
              "error: text.csv: is no ENVI file (neither it nor a .hdr file beside it begins with the line ENVI); name "
              "the header or the data of an ENVI cube\n");
}

}  // namespace
}  // namespace skinfit::test
