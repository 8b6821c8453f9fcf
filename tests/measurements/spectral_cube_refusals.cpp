#include <gtest/gtest.h>

#include <chrono>

#include "measurements/cube_region.hpp"
#include "measurements/spectral_cube.hpp"
#include "tests/measurements/made_cube.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using test::MadeCube;
using test::refusal_of;

struct Case {
    std::string header;   ///< as a whole
    std::string message;  ///< as a whole
};

const std::string sizes = "samples = 5\nlines = 4\nbands = 3\n";
const std::string layout = "data type = 12\ninterleave = bsq\nbyte order = 0\n";
const std::string spectral = "wavelength = {400, 500, 600}\nreflectance scale factor = 10000\n";

TEST(EnviHeaderRefusals, GiveTheseMessages) {
    const std::string mend = "correct the header, or export the data in another way";
    const std::vector<Case> cases{
        {"",
         "a.hdr:1: does not begin with the line ENVI (every ENVI header does); name an ENVI header or its data file"},
        {"ENVIRON\n" + sizes,
         "a.hdr:1: does not begin with the line ENVI (every ENVI header does); name an ENVI header or its data file"},
        {"ENVI", R"(a.hdr: has no "samples" (without it the data cannot be read); add a line "samples = ...")"},
        {"ENVI\nsamples = 5\nlines = 4\n" + layout,
         R"(a.hdr: has no "bands" (without it the data cannot be read); add a line "bands = ...")"},
        {"ENVI\n" + sizes + "interleave = bsq\n",
         R"(a.hdr: has no "data type" (without it the data cannot be read); add a line "data type = ...")"},
        {"ENVI\n" + sizes + "data type = 12\nbyte order = 0\n",
         R"(a.hdr: has no "interleave" (without it the data cannot be read); add a line "interleave = ...")"},
        {"ENVI\n" + sizes + "data type = 12\ninterleave = bil\n",
         R"(a.hdr: has no "byte order" (without it the data cannot be read); add a line "byte order = ...")"},
        {"ENVI\n" + sizes + layout + "lines = 4\n",
         "a.hdr:8: repeats \"lines\" (line 3 has it already); keep the one that is right"},
        {"ENVI\nsamples = 1000000000000000000\nlines = 4\nbands = 3\n" + layout,
         R"(a.hdr:2: "samples" is "1000000000000000000" (it must be a whole number from 1 to 2147483647); )" + mend},
        {"ENVI\nsamples = 0\nlines = 4\nbands = 3\n" + layout,
         R"(a.hdr:2: "samples" is "0" (it must be a whole number from 1 to 2147483647); )" + mend},
        {"ENVI\nsamples = -5\nlines = 4\nbands = 3\n" + layout,
         R"(a.hdr:2: "samples" is "-5" (it must be a whole number from 1 to 2147483647); )" + mend},
        {"ENVI\nsamples = 5\nlines = 4\nbands = 100000\n" + layout,
         R"(a.hdr:4: "bands" is "100000" (it must be a whole number from 1 to 65536); )" + mend},
        {"ENVI\n" + sizes + "data type = 6\ninterleave = bsq\nbyte order = 0\n",
         R"(a.hdr:5: "data type" is "6" (complex numbers are no fractions of light); )" + mend},
        {"ENVI\n" + sizes + "data type = 7\ninterleave = bsq\nbyte order = 0\n",
         R"(a.hdr:5: "data type" is "7" (the types of real numbers are 1, 2, 3, 4, 5, 12, 13, 14 and 15); )" + mend},
        {"ENVI\n" + sizes + "data type = 4\ninterleave = tile\nbyte order = 0\n",
         R"(a.hdr:6: "interleave" is "tile" (it must be bsq, bil or bip); )" + mend},
        {"ENVI\n" + sizes + "data type = 4\ninterleave = bsq\nbyte order = 2\n",
         R"(a.hdr:7: "byte order" is "2" (it must be a whole number from 0 to 1); )" + mend},
        {"ENVI\n" + sizes + layout + "file compression = 1\n",
         R"(a.hdr:8: "file compression" is "1" (only plain data without gaps are read); )" + mend},
        {"ENVI\n" + sizes + layout + "major frame offsets = {0, 16}\n",
         R"(a.hdr:8: "major frame offsets" is "0, 16" (only plain data without gaps are read); )" + mend},
        {"ENVI\n" + sizes + layout + "file type = ENVI Virtual Mosaic\n",
         R"(a.hdr:8: "file type" is "ENVI Virtual Mosaic" (only the plain data of ENVI Standard and ENVI Spectral )"
         "Library are read); " +
             mend},
        {"ENVI\n" + sizes + layout + "file type = ENVI Spectral Library\n",
         R"(a.hdr:4: "bands" is "3" (it must be a whole number from 1 to 1); )" + mend},
        {"ENVI\n" + sizes + layout + "wavelength = {400, 500,\n 600",
         "a.hdr:8: \"wavelength\" opens a brace (no later line closes it); check that the header is complete"},
        {"ENVI\n" + sizes + layout + "wavelength = {400, 500}\n",
         "a.hdr:8: \"wavelength\" has 2 numbers (the cube has 3 bands); give one number per band"},
        {"ENVI\n" + sizes + layout + "wavelength = {400,\n5OO, 600}\n",
         R"(a.hdr:8: number 2 of "wavelength" is "5OO" (a number is needed for every band); correct it)"},
        {"ENVI\n" + sizes + layout + "wavelength units = Index\nwavelength = {400, 500, 600}\n",
         R"(a.hdr:8: "wavelength units" is "Index" (it must be a unit of length such as nanometers, of frequency, or )"
         "wavenumber); " +
             mend},
        {"ENVI\n" + sizes + layout + "bbl = {1}\n",
         "a.hdr:8: \"bbl\" has 1 number (the cube has 3 bands); give one number per band"},
        {"ENVI\n" + sizes + layout + "reflectance scale factor = 0\n",
         R"(a.hdr:8: "reflectance scale factor" is "0" (it must be above 0); )" + mend},
        {"ENVI\n" + sizes + layout + "data ignore value = none\n",
         R"(a.hdr:8: "data ignore value" is "none" (it must be a number); )" + mend},
    };
    for (const Case& refused : cases) {
        EXPECT_EQ(refusal_of([&] { (void)parse_envi_header(refused.header, "a.hdr"); }), refused.message);
    }
}

class CubeRefusals : public test::TemporaryFolder {
protected:
    /// What opening the cube says, without the folder.
    [[nodiscard]] std::string message(const std::string& file) const {
        return short_message([&] { (void)SpectralCube(in_folder(file)); });
    }
    [[nodiscard]] std::string short_message(const std::function<void()>& action) const {
        std::string text = refusal_of(action);
        const std::string folder = in_folder("").string();
        for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
            text.erase(at, folder.size());
        }
        return text;
    }
    void write(const std::string& more, std::size_t bytes = 120) const {
        test::write_text(in_folder("a.hdr"), "ENVI\n" + sizes + layout + more);
        test::write_text(in_folder("a.dat"), std::string(bytes, '\0'));
    }
};

TEST_F(CubeRefusals, OfHeadersGiveTheseMessages) {
    write("");
    EXPECT_EQ(message("a.hdr"),
              "a.hdr: has no \"wavelength\" (without wavelengths the bands are no spectra); add \"wavelength = {...}\" "
              "with one "
              "number per band");
    write("wavelength = {400, 500, 600}\n");
    EXPECT_EQ(
        message("a.hdr"),
        "a.hdr: has no \"reflectance scale factor\" (its data are whole numbers, and which of them stands for 1 is not "
        "known); add \"reflectance scale factor = 10000\", or whichever number stands for 1");
    write(spectral + "bbl = {0, 0, 0}\n");
    EXPECT_EQ(message("a.hdr"),
              "a.hdr: \"bbl\" marks every band as bad (nothing is left to read); set 1 for the good bands");
    write("wavelength = {400, 500, 50000}\nreflectance scale factor = 1\n");
    EXPECT_EQ(
        message("a.hdr"),
        "a.hdr: the wavelength of band 3 is 50000 nm (it must lie between 100 and 10000 nm); correct \"wavelength\" or "
        "\"wavelength units\", or mark the band as bad in \"bbl\"");
}

TEST_F(CubeRefusals, OfFilesGiveTheseMessages) {
    write(spectral, 119);
    EXPECT_EQ(
        message("a.hdr"),
        "a.dat: has 119 bytes (its header promises 120); copy the file again if it is cut short, else correct the "
        "sizes in the header");
    std::filesystem::copy_file(in_folder("a.dat"), in_folder("a.img"));
    EXPECT_EQ(
        message("a.hdr"),
        "a.hdr: has several data files beside it (a.dat and a.img may both belong to it); name the data file instead "
        "of the header");
    std::filesystem::remove(in_folder("a.img"));
    std::filesystem::remove(in_folder("a.dat"));
    EXPECT_EQ(
        message("a.hdr"),
        "a.hdr: has no data file beside it (a header holds no measurements); put the data beside it, called a.dat");
    test::write_text(in_folder("b.dat"), "400 0.5\n");
    EXPECT_EQ(
        message("b.dat"),
        "b.dat: is no ENVI file (neither it nor a .hdr file beside it begins with the line ENVI); name the header or "
        "the data of an ENVI cube");
    test::write_text(in_folder("c.hdr"), "ENVI\n");
    std::filesystem::resize_file(in_folder("c.hdr"), (std::uintmax_t{16} << 20U) + 1);
    test::write_text(in_folder("c.dat"), "");
    EXPECT_EQ(message("c.hdr"),
              "c.hdr: has more than 16 MiB (no header of a cube needs as much); check that it is a header");
}

TEST_F(CubeRefusals, OfHugePromisesComeAtOnceAndWithoutMemory) {
    const auto start = std::chrono::steady_clock::now();
    const std::string most = "samples = 2147483647\nlines = 2147483647\nbands = 65536\n";
    test::write_text(in_folder("a.hdr"), "ENVI\n" + most + layout);
    test::write_text(in_folder("a.dat"), std::string(1000, '\0'));
    EXPECT_EQ(
        message("a.hdr"),
        "a.dat: has 1000 bytes (its header promises more than 2^64); copy the file again if it is cut short, else "
        "correct the sizes in the header");
    test::write_text(in_folder("a.hdr"), "ENVI\nsamples = 1000000000\nlines = 1000000000\nbands = 1\n" + layout);
    EXPECT_EQ(
        message("a.hdr"),
        "a.dat: has 1000 bytes (its header promises 2000000000000000000); copy the file again if it is cut short, "
        "else correct the sizes in the header");

    // A file of holes that keeps the promise takes no room on the disk, but its lines would in memory.
    test::write_text(in_folder("a.hdr"),
                     "ENVI\nsamples = 100000000\nlines = 1\nbands = 3\ndata type = 1\ninterleave = bip\n" + spectral);
    std::filesystem::resize_file(in_folder("a.dat"), 300'000'000);
    EXPECT_EQ(message("a.hdr"),
              "a.hdr: describes 100000000 x 1 pixels of 3 bands (at most 8388608 samples times bands and "
              "2147483647 lines times bands can be read); cut the cube into parts");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST_F(CubeRefusals, OfRegionsGiveTheseMessages) {
    test::write_cube(in_folder("a.hdr"), {});
    const SpectralCube cube(in_folder("a.hdr"));
    const auto with_mask = [&](const std::string& file) {
        return short_message([&] { (void)CubeRegion({.mask = in_folder(file)}, cube); });
    };
    test::write_cube(in_folder("m.hdr"), {.samples = 4, .lines = 5, .bands = 1, .data_type = 1, .more = ""});
    EXPECT_EQ(with_mask("m.hdr"),
              "m.hdr: has 4 x 5 pixels (the cube has 5 x 4); give a mask of the same size as the cube");
    EXPECT_EQ(with_mask("a.hdr"), "a.hdr: has 3 bands (a mask has one); export the mask alone");
    EXPECT_EQ(with_mask("none.png"), "none.png: is no file (a picture is needed); check the name");
    test::write_text(in_folder("text.png"), "no picture");
    EXPECT_EQ(
        with_mask("text.png"),
        "text.png: cannot be read (GDAL: `text.png' not recognized as a supported file format.); give an ENVI file, a "
        "GeoTIFF or a PNG");

    const auto with_rectangle = [&](const std::string& text) {
        return short_message([&] { (void)CubeRegion({.rectangle = parse_rectangle(text, "--rectangle")}, cube); });
    };
    EXPECT_EQ(with_rectangle("0,0,5,4"), "");
    EXPECT_EQ(with_rectangle("4,3,1,1"), "");
    for (const std::string beyond : {"1,0,5,4", "0,1,5,4", "5,0,1,1", "0,4,1,1", "4,3,9007199254740992,1"}) {
        EXPECT_EQ(with_rectangle(beyond),
                  "the rectangle " + beyond +
                      ": reaches beyond the cube (a.dat has 5 x 4 pixels); give x,y,width,height "
                      "within it, counted from 0");
    }
    for (const std::string malformed :
         {"", "1,2,3", "1,2,3,4,5", "0,0,0,1", "0,0,1,0", "-1,0,1,1", "0.5,0,1,1", "a,b,c,d"}) {
        EXPECT_EQ(with_rectangle(malformed), "--rectangle: is \"" + malformed +
                                                 "\" (four whole numbers are needed, the last two above 0); give "
                                                 "x,y,width,height in pixels, counted from 0, such as 10,20,5,5");
    }
}

}  // namespace
}  // namespace skinfit
