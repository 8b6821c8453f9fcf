#include "measurements/envi_reader.hpp"

#include <gtest/gtest.h>

#include "core/input_error.hpp"
#include "measurements/cube_mean.hpp"
#include "measurements/spectrum_file.hpp"
#include "tests/measurements/made_cube.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using test::MadeCube;

class EnviReader : public test::TemporaryFolder {
protected:
    [[nodiscard]] Spectrum written(const MadeCube& cube, const ReadOptions& options = {}) const {
        test::write_cube(in_folder("arm.hdr"), cube);
        return read_envi(find_envi_files(in_folder("arm.hdr")), options).front();
    }
};

std::string note(const Spectrum& spectrum, const std::string& key) {
    for (const FileNote& note : spectrum.notes) {
        if (note.key == key) return note.value;
    }
    return "none";
}

TEST_F(EnviReader, IsChosenByContentForEitherFile) {
    test::write_cube(in_folder("arm.hdr"), {});
    for (const std::string name : {"arm.hdr", "arm.dat"}) {
        const SpectrumFile file = read_spectra(in_folder(name));
        EXPECT_EQ(file.format, "envi");
        EXPECT_EQ(file.source, in_folder(name).string());
        ASSERT_EQ(file.spectra.size(), 1U);
        EXPECT_EQ(file.spectra.front().name, "arm");
        EXPECT_EQ(file.spectra.front().source, in_folder("arm.dat").string());
        EXPECT_EQ(read_spectra(in_folder(name), {}, "envi").spectra.front().value, file.spectra.front().value);
    }
    test::write_text(in_folder("arm.csv"), "400,0.5\n500,0.6\n");
    EXPECT_EQ(read_spectra(in_folder("arm.csv")).format, "columns") << "the header beside it is the cube's";
    test::write_text(in_folder("leg.dat"), "400 0.5\n500 0.6\n");
    EXPECT_EQ(read_spectra(in_folder("leg.dat")).format, "columns") << "there is no header beside it";
    EXPECT_THROW((void)read_spectra(in_folder("leg.dat"), {}, "envi"), InputError);
}

TEST_F(EnviReader, GivesTheMeanOfTheRegionAndSaysWhatItIs) {
    const MadeCube made;
    const Rectangle rectangle{.first_sample = 1, .first_line = 0, .samples = 2, .lines = 3};
    const Spectrum spectrum = written(made, {.region = {.rectangle = rectangle}});
    const SpectralCube cube(in_folder("arm.hdr"));
    const CubeMean mean = mean_spectrum(cube, CubeRegion({.rectangle = rectangle}, cube));
    EXPECT_EQ(spectrum.wavelength_nm, (std::vector<double>{400, 500, 600}));
    EXPECT_EQ(spectrum.value, mean.value);
    EXPECT_EQ(spectrum.sigma, mean.sigma);
    EXPECT_EQ(spectrum.sigma_source, "from the scatter of 6 pixels");
    EXPECT_EQ(note(spectrum, "pixels"), "6");
    EXPECT_EQ(note(spectrum, "rectangle"), "1,0,2,3");
    EXPECT_EQ(note(spectrum, "cube"), "5 x 4 pixels, 3 of 3 bands, bsq");
    EXPECT_EQ(note(spectrum, "wavelength_unit"), "nanometres: some exceed 10");
    EXPECT_EQ(spectrum.unit_rule, "fraction: after division by the header's scale factor 100");
}

TEST_F(EnviReader, TakesInstrumentAndBandpassFromTheHeader) {
    const Spectrum spectrum = written({.more = "wavelength units = micrometers\nwavelength = {0.4, 0.5, 0.6}\n"
                                               "fwhm = {0.004, 0.005, 0.006}\nsensor type = made up\n"
                                               "reflectance scale factor = 100\n"});
    EXPECT_EQ(spectrum.instrument, "made up");
    ASSERT_TRUE(spectrum.bandpass);
    EXPECT_EQ(spectrum.bandpass->shape, BandpassShape::gaussian);
    EXPECT_DOUBLE_EQ(spectrum.bandpass->width_nm, 5);
    EXPECT_EQ(note(spectrum, "fwhm_nm"), "4 to 6");
}

TEST_F(EnviReader, RefusesBandsWiderThanAnyThatIsModelled) {
    EXPECT_NO_THROW(
        written({.more = "wavelength = {400, 500, 600}\nfwhm = {5, 5, 100}\nreflectance scale factor = 100\n"}));
    EXPECT_THROW(
        written({.more = "wavelength = {400, 500, 600}\nfwhm = {5, 5, 100.1}\nreflectance scale factor = 100\n"}),
        InputError);
}

TEST_F(EnviReader, FindsTheUnitOfNumbersWithoutAScaleFactor) {
    const MadeCube made{.data_type = 4, .more = "wavelength = {400, 500, 600}\n"};  // from 1 to 60: percent
    const Spectrum found = written(made);
    EXPECT_DOUBLE_EQ(found.value[0], 0.105);
    EXPECT_TRUE(found.unit_rule.starts_with("percent: ")) << found.unit_rule;
    EXPECT_DOUBLE_EQ(written(made, {.unit = Unit::fraction}).value[0], 10.5);
    EXPECT_DOUBLE_EQ(written(made, {.unit = Unit::percent}).sigma[0], found.sigma[0]);
}

TEST_F(EnviReader, ChecksTheValuesOfASpectrumToFit) {
    test::write_cube(in_folder("arm.hdr"), {.more = "wavelength = {400, 500, 600}\nreflectance scale factor = 10\n"});
    try {
        (void)read_spectrum(in_folder("arm.hdr"));
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).substr(in_folder("").string().size()),
                  "arm.hdr: the value 3.05 at 500 nm exceeds 1.5 (as a fraction; the unit was taken as fraction: after "
                  "division by the header's scale factor 10); correct the value, or, where the file is in percent, add "
                  "a line \"# unit: percent\" or give --unit percent");
    }
}

TEST_F(EnviReader, KeepsTheNamesOfBandsAndThePlaceOfThePicture) {
    const test::MadeCube made{.more =
                                  "band names = {\n red,\n green, blue}\nmap info = {UTM, 1, 1,\r\n 5, 6, 2, 2, 33, "
                                  "North}\nX start = 4\ncoordinate system string = {PROJCS[\"a\"]}\n"};
    const EnviHeader header = parse_envi_header(test::header_text(made), "a.hdr");
    EXPECT_EQ(header.band_names, (std::vector<std::string>{"red", "green", "blue"}));
    EXPECT_EQ(header.place, (std::vector<std::string>{"map info = {UTM, 1, 1,   5, 6, 2, 2, 33, North}",
                                                      "coordinate system string = {PROJCS[\"a\"]}", "x start = 4"}));
    const test::MadeCube wrong{.more = "band names = {red, green}\n"};
    EXPECT_TRUE(parse_envi_header(test::header_text(wrong), "a.hdr").band_names.empty());
}

TEST_F(EnviReader, LeavesTextWithoutPixelsToChoose) {
    test::write_text(in_folder("a.csv"), "400,0.5\n500,0.6\n");
    const ReadOptions region{.region = {.mask = "mask.png"}};
    EXPECT_THROW((void)read_spectra(in_folder("a.csv"), region), InputError);
    EXPECT_THROW((void)read_spectrum(in_folder("a.csv"), region), InputError);
}

}  // namespace
}  // namespace skinfit
