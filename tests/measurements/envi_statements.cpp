#include <fmt/format.h>
#include <gtest/gtest.h>

#include "measurements/envi_reader.hpp"
#include "measurements/quality_checks.hpp"
#include "measurements/spectrum_file.hpp"
#include "measurements/text_reader.hpp"
#include "tests/measurements/made_cube.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using Numbers = std::vector<double>;
using test::MadeCube;

const std::string nm = "wavelength = {400, 500, 600}\nwavelength units = Nanometers\n";

/// Cubes of four pixels of three bands, 1, 2, ... 12 in the order of pixels, with header lines that state things.
class EnviStatements : public test::TemporaryFolder {
protected:
    [[nodiscard]] Spectrum read(const std::string& more, int data_type = 12, const ReadOptions& options = {}) const {
        write(more, data_type);
        return read_envi(find_envi_files(in_folder("a.hdr")), options).front();
    }
    [[nodiscard]] std::string refusal(const std::string& more, int data_type = 4,
                                      const ReadOptions& options = {}) const {
        std::string text = test::refusal_of([&] { (void)read(more, data_type, options); });
        const std::string folder = in_folder("").string();
        for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
            text.erase(at, folder.size());
        }
        return text;
    }
    void write(const std::string& more, int data_type = 12) const {
        const MadeCube made{.samples = 2,
                            .lines = 2,
                            .bands = 3,
                            .interleave = "bip",
                            .data_type = data_type,
                            .more = more,
                            .given = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
        test::write_cube(in_folder("a.hdr"), made);
        if (more.find("description") == std::string::npos) return;
        std::string header = test::header_text(made);  // which has a description already
        header.replace(header.find("description"), std::string_view("description").size(), "comment");
        test::write_text(in_folder("a.hdr"), header);
    }
};

std::string remarks_of(const Spectrum& spectrum) {
    std::string text;
    for (const std::string& remark : spectrum.remarks) text += "- " + remark + "\n";
    for (const FileDoubt& doubt : spectrum.doubts) text += "! " + doubt.message + "\n";
    return text;
}

TEST_F(EnviStatements, NumbersAreScaledAsTheHeaderSays) {
    // The means of the numbers are 5.5, 6.5 and 7.5.
    const struct {
        std::string more;
        Numbers value;
    } cases[] = {
        {"reflectance scale factor = 50\n", {0.11, 0.13, 0.15}},
        {"data gain values = {0.01, 0.02, 0.04}\n", {0.055, 0.13, 0.3}},
        {"data gain values = {0.01, 0.01, 0.01}\ndata offset values = {0.1, 0.2, -0.05}\n", {0.155, 0.265, 0.025}},
        {"data gain values = 0.01\ndata offset values = -0.01\n", {0.045, 0.055, 0.065}},
        {"data_gain_values = {0.01 0.01 0.01}\n", {0.055, 0.065, 0.075}},
        {"data gain values = {2, 2, 2}\nreflectance scale factor = 100\n", {0.11, 0.13, 0.15}},
        {"data offset values = {5, 5, 5}\nreflectance scale factor = 100\n", {0.105, 0.115, 0.125}},
        {"data gain values = {9, 9, 9}\ndata reflectance gain values = {0.01, 0.01, 0.01}\n", {0.055, 0.065, 0.075}},
        {"z plot titles = {Wavelength, Reflectance (%)}\n", {0.055, 0.065, 0.075}},
        {"data units = percent\n", {0.055, 0.065, 0.075}},
    };
    for (const auto& each : cases) {
        const Spectrum spectrum =
            read(nm + each.more, each.more.starts_with("z") || each.more.starts_with("data u") ? 4 : 12);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(spectrum.value[i], each.value[i], 1e-12) << each.more << i;
    }
    EXPECT_EQ(read(nm + "z plot titles = {Wavelength, Reflectance}\nreflectance scale factor = 50\n").quantity,
              Quantity::reflectance);
    EXPECT_EQ(read(nm + "data units = Transmittance\nreflectance scale factor = 50\n").quantity,
              Quantity::transmittance);
}

TEST_F(EnviStatements, ContradictionsOfScalesAreRefused) {
    EXPECT_NE(refusal(nm + "data gain values = {0.01, 0.01, 0.01}\nreflectance scale factor = 100\n", 12)
                  .find("\"reflectance scale factor\" is \"100\" (the gains make the same conversion"),
              std::string::npos);
    EXPECT_NE(refusal(nm + "data gain values = {1, 0, 1}\n").find("a gain of 0"), std::string::npos);
    EXPECT_NE(refusal(nm + "data gain values = {1, 1}\n").find("has 2 numbers"), std::string::npos);
    // Gains of radiance give numbers far above 1, which nobody calls percent.
    const std::string radiance = nm + "data gain values = {3, 3, 3}\n";
    EXPECT_NE(refusal(radiance, 12).find("they may be radiances"), std::string::npos) << refusal(radiance, 12);
    EXPECT_NEAR(read(radiance, 12, {.unit = Unit::percent}).value[0], 0.165, 1e-12);
}

TEST_F(EnviStatements, OtherQuantitiesAreRefused) {
    const std::string scale = "reflectance scale factor = 50\n";
    EXPECT_EQ(refusal(nm + "z plot titles = {Wavelength (nm), Absorbance}\n"),
              "a.hdr:14: \"z plot titles\" is \"Wavelength (nm), Absorbance\" (Absorbance is no reflectance or "
              "transmittance); export reflectance or transmittance; an absorbance A is a share of light 10^-A; if they "
              "are, correct the header");
    for (const std::string more :
         {"data units = W/m2/sr/um, radiance", "z plot titles = {Wavelength, Radiance}", "data units = DN",
          "z plot titles = {Wavelength, log(1/Reflectance)}", "z plot titles = {Band, Counts}", "data units = K/S",
          "description = {At-sensor radiance of the forearm}", "description = {Raw digital numbers}",
          "product type = radiance", "description = {Absorbance, not scaled}"}) {
        EXPECT_NE(refusal(nm + scale + more + "\n").find("no reflectance or transmittance"), std::string::npos) << more;
    }
    // Prose may name where a reflectance came from, and may be overruled.
    for (const std::string more :
         {"description = {Radiance converted to reflectance}", "description = {volar forearm, calibrated}",
          "z plot titles = {Wavelength, Value}", "band names = {counts, DN, radiance}"}) {
        EXPECT_EQ(refusal(nm + scale + more + "\n"), "") << more;
    }
    const std::string overruled = nm + "description = {from the radiance cube}\n";
    EXPECT_EQ(refusal(overruled, 4, {.unit = Unit::percent}), "");
}

TEST_F(EnviStatements, QuantityScaleAndGeometryAreReadWhereverTheyStand) {
    const std::string scale = "reflectance scale factor = 50\n";
    for (const std::string more : {"data unit = log(1/R)", "measurement = absorbance", "y plot titles = {Absorbance}",
                                   "band names = {Absorbance 400 nm, Absorbance 500 nm, Absorbance 600 nm}"}) {
        EXPECT_NE(refusal(nm + more + "\n").find("no reflectance or transmittance"), std::string::npos) << more;
    }
    // A factor that the header's own scale undoes, and how values came about.
    for (const std::string more : {"data units = Reflectance x10000", "z plot titles = {Wavelength, Reflectance*10^4}",
                                   "description = {reflectance scaled by 10000}", "data units = Reflectance (x 1e4)",
                                   "data units = Reflectance\ndescription = {made from radiance}"}) {
        EXPECT_EQ(refusal(nm + scale + more + "\n"), "") << more;
    }
    EXPECT_NE(refusal(nm + "data units = Reflectance x10000\n"), "");
    EXPECT_EQ(read(nm + scale + "specular = excluded\n").geometry.specular, Specular::excluded);
    EXPECT_EQ(read(nm + scale + "description = {forearm SCE}\n").geometry.specular, Specular::excluded);
    EXPECT_EQ(read(nm + scale + "measurement geometry = d/8\n").geometry.incidence_deg, 8.0);
}

TEST_F(EnviStatements, ABandOfZerosWasNotMeasuredWhateverItsOffset) {
    test::write_cube(in_folder("a.hdr"), {.samples = 2,
                                          .lines = 1,
                                          .bands = 3,
                                          .interleave = "bsq",
                                          .data_type = 4,
                                          .more = nm + "data offset values = {0.05, 0.05, 0.05}\n",
                                          .given = {0, 0.2, 0.4, 0, 0.3, 0.5}});
    const Spectrum spectrum = read_envi(find_envi_files(in_folder("a.hdr"))).front();
    EXPECT_EQ(spectrum.wavelength_nm, (Numbers{500, 600}));
    EXPECT_EQ(spectrum.missing_nm, Numbers{400});
}

TEST_F(EnviStatements, WavelengthsInUnitsOfLengthFrequencyAndWavenumberAreConverted) {
    const struct {
        std::string more;
        Numbers wavelength_nm;
    } cases[] = {
        {"wavelength units = THz\nwavelength = {749.481145, 599.584916, 499.65409667}\n", {400, 500, 600}},
        {"wavelength units = GHz\nwavelength = {749481.145, 599584.916, 499654.09667}\n", {400, 500, 600}},
        {"wavelength units = MHz\nwavelength = {749481145, 599584916, 499654096.67}\n", {400, 500, 600}},
        {"wavelength units = Wavenumber\nwavelength = {25000, 20000, 16000}\n", {400, 500, 625}},
        {"wavelength units = Angstroms\nwavelength = {4000, 5000, 6000}\n", {400, 500, 600}},
        {"wavelength units = Millimeters\nwavelength = {0.0004, 0.0005, 0.0006}\n", {400, 500, 600}},
        {"wavelength units = {um}\nwavelength = {0.4, 0.5, 0.6}\n", {400, 500, 600}},
        {"Wavelength_Units = Micrometers ; as the camera has it\nWAVELENGTH = {0.4, 0.5, 0.6}\n", {400, 500, 600}},
        {"wavelength units =\nwavelength = {600, 500, 400}\n", {400, 500, 600}},
        {"wavelength = {\"400 nm\", \"500 nm\", \"600 nm\"}\n", {400, 500, 600}},
        {"wavelength = {0.4 um, 0.5 um, 0.6 um}\n", {400, 500, 600}},
        {"z plot titles = {Frequency (THz), Reflectance}\nwavelength = {749.481145, 599.584916, 499.65409667}\n",
         {400, 500, 600}},
        {"wavelength\t=\n\n; in nm\n{\n400\n; the second\n500\n600\n}\n", {400, 500, 600}},
    };
    for (const auto& each : cases) {
        const Spectrum spectrum = read(each.more + "reflectance scale factor = 50\n");
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(spectrum.wavelength_nm[i], each.wavelength_nm[i], 1e-3) << each.more;
    }
    // 10 / cm about 20000 / cm are 500^2 / 1e7 * 10 nm.
    const Spectrum spectrum = read(
        "wavelength units = Wavenumber\nwavelength = {20000, 20001, 20002}\nfwhm = {10, 10, 10}\n"
        "reflectance scale factor = 50\n");
    ASSERT_TRUE(spectrum.bandpass);
    EXPECT_NEAR(spectrum.bandpass->width_nm, 0.25, 1e-3);
    EXPECT_NE(refusal("wavelength units = Index\nwavelength = {1, 2, 3}\n").find("it must be a unit of length"),
              std::string::npos);
    EXPECT_NE(refusal("wavelength = {1, 2, 3}\n").find("numbers of the bands, no wavelengths"), std::string::npos);
    EXPECT_NE(refusal("wavelength units = THz\nwavelength = {0, 500, 600}\n").find("are above 0"), std::string::npos);
}

TEST_F(EnviStatements, PixelsAndBandsWithoutAMeasurementAreLeftOutAndCounted) {
    const auto made = [&](const Numbers& numbers, const std::string& more) {
        test::write_cube(in_folder("a.hdr"), {.samples = 2,
                                              .lines = 2,
                                              .bands = 3,
                                              .interleave = "bsq",
                                              .data_type = 4,
                                              .more = nm + more,
                                              .given = numbers});
        return read_envi(find_envi_files(in_folder("a.hdr"))).front();
    };
    const Numbers good{0.1, 0.2, 0.3, 0.3, 0.4, 0.5};
    const auto with = [&good](Numbers more) {
        more.insert(more.begin(), good.begin(), good.end());
        return more;
    };
    for (const double fill : {0.0, -1.0, -9999.0, -999.0, 1e34, -3.4028234663852886e38, 65535.0}) {
        const Spectrum spectrum = made(with({fill, fill, fill, 0.2, 0.3, 0.4}), "");
        EXPECT_NEAR(spectrum.value[0], 0.2, 1e-7) << fill;
        EXPECT_EQ(remarks_of(spectrum),
                  "- 1 of 4 pixels are left out: 1 have no number, or the same one in all bands, such as 0\n");
    }
    const Spectrum partial = made(with({-9999, 0.1, 0.2, -7, -7.5, -7}), "data ignore value = -7\n");
    EXPECT_NEAR(partial.value[0], 0.2, 1e-7);
    EXPECT_EQ(remarks_of(partial), "- 2 of 4 pixels are left out: 2 lack a number in some band\n");
    // No surface reflects nothing: a band of zeros was not measured.
    const Spectrum dead = made({0.1, 0, 0.3, 0.3, 0, 0.5, 0.2, 0, 0.4, 0.4, 0, 0.6}, "");
    EXPECT_EQ(dead.wavelength_nm, (Numbers{400, 600}));
    EXPECT_EQ(dead.missing_nm.size(), 1U);
    EXPECT_EQ(dead.sigma.size(), 2U);
    EXPECT_FALSE(remarks_of(made(with(good), "bbl = {1, 1, 1}\n")).size() > 0);
}

TEST_F(EnviStatements, WhatIsNotUnderstoodIsARemark) {
    const Spectrum spectrum = read(nm +
                                   "reflectance scale factor = 50\nscale = 0.5\ndark offset = 3\nfps = 25\n"
                                   "default bands = {1, 2, 3}\nx start = 1\n");
    EXPECT_EQ(remarks_of(spectrum),
              "- line 16 of the header, \"dark offset\" = \"3\", is not understood and not applied\n"
              "! line 15 of the header, \"scale\" = \"0.5\", is not understood and not applied\n");
    EXPECT_TRUE(doubtful_file(spectrum));
    EXPECT_EQ(as_read(spectrum)->severity, Severity::note);
}

TEST_F(EnviStatements, DataOfOtherSizesAndFormsAreSaid) {
    write(nm + "reflectance scale factor = 50\n");
    test::write_text(in_folder("a.dat"), std::string("\x1f\x8b", 2) + std::string(10, 'x'));
    EXPECT_NE(
        test::refusal_of([&] { (void)read_envi(find_envi_files(in_folder("a.hdr"))); }).find("is compressed by gzip"),
        std::string::npos);
    for (const std::string type : {"TIFF", "ENVI Virtual Mosaic", "HDF Scientific Data", "NITF"}) {
        EXPECT_NE(test::refusal_of([&] {
                      (void)parse_envi_header(
                          "ENVI\nsamples = 1\nlines = 1\nbands = 1\ndata type = 1\n"
                          "interleave = bsq\nfile type = " +
                              type + "\n",
                          "a");
                  }).find("only the plain data"),
                  std::string::npos)
            << type;
    }
    test::write_text(in_folder("c.hdr"),
                     "ENVI\nsamples = 1\nlines = 1\nbands = 3\ndata type = 1\ninterleave = bsq\n"
                     "file type = ENVI Classification\n" +
                         nm);
    test::write_text(in_folder("c.dat"), "123");
    EXPECT_NE(
        test::refusal_of([&] { (void)read_envi(find_envi_files(in_folder("c.hdr"))); }).find("holds a classification"),
        std::string::npos);
}

TEST_F(EnviStatements, ALibraryKeepsItsNamesScalesAndGaps) {
    test::write_text(in_folder("skin.hdr"),
                     "ENVI\nsamples = 3\nlines = 3\nbands = 1\nfile type = ENVI Spectral Library\ndata type = 4\n"
                     "interleave = bsq\nbyte order = 0\nwavelength units = Micrometers\nreflectance scale factor = 2\n"
                     "spectra names = {one SCI,\n two, three}\nwavelength = {0.4, 0.5, 0.6}\n");
    test::write_text(in_folder("skin.sli"), test::stored({0.2, 0.4, 0.6, 0.5, -1.23e34, 0.7, 0, 0, 0}, 4, false));
    const std::vector<Spectrum> spectra = read_spectra(in_folder("skin.sli")).spectra;
    ASSERT_EQ(spectra.size(), 2U);
    EXPECT_EQ(spectra[0].name, "one SCI");
    EXPECT_EQ(spectra[0].geometry.specular, Specular::included);
    EXPECT_NEAR(spectra[0].value[0], 0.1, 1e-7);
    EXPECT_EQ(spectra[1].wavelength_nm, (Numbers{400, 600}));
    EXPECT_EQ(spectra[1].missing_nm.size(), 1U);
    EXPECT_EQ(remarks_of(spectra[0]), "- 1 of 3 spectra of the file are without numbers and are left out\n");
    EXPECT_EQ(read_spectrum(in_folder("skin.hdr"), {.column = "two"}).name, "two");
    EXPECT_NE(test::refusal_of([&] { (void)read_spectrum(in_folder("skin.hdr")); }).find("has 2 spectra"),
              std::string::npos);
    test::write_text(in_folder("names.hdr"),
                     "ENVI\nsamples = 3\nlines = 3\nbands = 1\nfile type = ENVI Spectral Library\ndata type = 4\n"
                     "interleave = bsq\nbyte order = 0\n" +
                         nm + "spectra names = {arm absorbance, arm reflectance, ear transmittance}\n");
    test::write_text(in_folder("names.sli"), test::stored({1, 1.1, 1.2, 0, 0.2, 0.3, 0, 0.4, 0.5}, 4, false));
    const std::vector<Spectrum> named = read_spectra(in_folder("names.sli")).spectra;
    ASSERT_EQ(named.size(), 2U);
    EXPECT_EQ(named[1].quantity, Quantity::transmittance);
    const ReadOptions region{.region = {.rectangle = Rectangle{0, 0, 1, 1}}};
    EXPECT_NE(test::refusal_of([&] { (void)read_spectra(in_folder("skin.hdr"), region); }).find("no pixels to choose"),
              std::string::npos);
}

}  // namespace
}  // namespace skinfit
