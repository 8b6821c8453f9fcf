#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/input_error.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {
namespace {

using Numbers = std::vector<double>;

struct Form {
    std::string reader;
    std::string text;
};

/// One made-up spectrum, 0.1 at 400 nm, 0.25 at 410 nm, 0.375 at 420 nm and nothing at 430 nm, in every form that can
/// leave a value out, and without 430 nm in the others.
const std::vector<Form> forms{
    {"columns", "400,0.1\n410,0.25\n420,0.375\n"},
    {"columns", "wavelength (nm) reflectance\n400 0.1\n410 0.25\n420 0.375\n"},
    {"columns", "Wavelength [nm]\tTransmittance [%]\r\n400\t10\r\n410\t25\r\n420\t37.5\r\n430\tNaN\r\n"},
    {"columns", "  4.0000000e+002  1.0000000e-001\r\n  4.1e+002  2.5e-001\r\n  4.2e+002  3.75e-001\r\n"},
    {"columns", "\"Wavelength, nm\",\"R, fraction\"\n\"400\",\"0.1\"\n410,0.25\n420,0.375\n430,\n"},
    {"columns", "nm;R\n400,0;0,1\n410,0;0,25\n420,0;0,375\n"},
    {"columns", "Wavelength (nm), Reflectance\n400 0.1\n410 0.25\n420 0.375\n"},
    {"columns", "Instrument: made up\n\nWave;Sample\n[nm];[%]\n400;10\n410;25\n420;37.5\n"},
    {"columns", "Wavelength (\xC2\xB5m),Reflectance\n0.4,0.1\n0.41,0.25\n0.42,0.375\n"},
    {"columns", "Made up\n>>>>> Begin <<<<<\n400\t0.1\n410\t0.25\n420\t0.375\n"},
    {"rows", "id,400,410,420,430\none,0.1,0.25,0.375,\n"},
    {"rows", "id;site;420 nm;410 nm;400 nm\none;arm;37,5;25;10\n"},
    {"rows", "\tSPEC_400\tSPEC_410\tSPEC_420\none\t0.1\t0.25\t0.375\n"},
    {"nist_m38597",
     "Made up,,,\n\x93Prose in quotes\x94,,,\n,Subject 7,,\nWavelength "
     "(nm),R1,,\n400,0.1,,\n410,0.25,,\n420,0.375,,\n"},
    {"cgats",
     "CTI3\n\nDESCRIPTOR \"made up\"\nNUMBER_OF_FIELDS 5\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400 SPEC_410 SPEC_420 "
     "SPEC_430\n"
     "END_DATA_FORMAT\nNUMBER_OF_SETS 1\nBEGIN_DATA\n\"one\" 10 25 37.5 0\nEND_DATA\n"},
    {"jcamp_dx",
     "##TITLE= one\n##XUNITS= NANOMETERS\n##YUNITS= REFLECTANCE\n##FIRSTX= 400\n##LASTX= 420\n##NPOINTS= 3\n"
     "##XYDATA= (X++(Y..Y))\n400 0.1 0.25 0.375\n##END=\n"},
    {"jcamp_dx",
     "##title= one\n##xunits= micrometers\n##yunits= %R\n##xypoints= (XY..XY)\n0.42, 37.5; 0.41, 25; 0.4, "
     "10\n##end=\n"},
    {"json", R"({"start": 400, "step": 10, "values": [0.1, 0.25, 0.375, null]})"},
    {"json", R"([{"name": "one", "unit": "percent", "wavelength_nm": [420, 410, 400], "value": [37.5, 25, 10]}])"},
};

TEST(Formats, TheSameSpectrumReadsTheSameInEveryForm) {
    for (const Form& form : forms) {
        SCOPED_TRACE(form.text);
        const SpectrumFile file = parse_spectra(form.text, "made_up");
        EXPECT_EQ(file.format, form.reader);
        ASSERT_EQ(file.spectra.size(), 1U);
        const Spectrum& spectrum = file.spectra.front();
        EXPECT_EQ(spectrum.wavelength_nm, (Numbers{400, 410, 420}));
        EXPECT_EQ(spectrum.value, (Numbers{0.1, 0.25, 0.375}));
        EXPECT_TRUE(spectrum.sigma.empty());
        EXPECT_FALSE(spectrum.name.empty());
        EXPECT_FALSE(spectrum.unit_rule.empty());
        const SpectrumFile named = parse_spectra(form.text, "made_up", {}, form.reader);
        EXPECT_EQ(named.spectra.front().value, spectrum.value);
    }
}

TEST(Formats, AMissingValueIsLeftOutAndCounted) {
    for (const Form& form : forms) {
        SCOPED_TRACE(form.text);
        const bool has_gap = form.text.find("430") != std::string::npos || form.text.find("null") != std::string::npos;
        EXPECT_EQ(parse_spectra(form.text, "made_up").spectra.front().missing_nm.size(), has_gap ? 1U : 0U);
    }
}

TEST(Formats, RowsKeepTheirOtherLabelsAsNotes) {
    const Spectrum spectrum = parse_spectra(forms[11].text, "made_up").spectra.front();
    EXPECT_EQ(spectrum.name, "one");
    EXPECT_EQ(spectrum.line, 2U);
    ASSERT_EQ(spectrum.notes.size(), 1U);
    EXPECT_EQ(spectrum.notes[0].key, "site");
    EXPECT_EQ(spectrum.notes[0].value, "arm");
}

TEST(Formats, TheUncertaintyOfAMeanComesFromItsRepeats) {
    const SpectrumFile file = parse_spectra(
        "Measurand is reflectance factor,,,,,\n,Subject 7,,,Subject 9,,\nWavelength (nm),R1,R2,Average,R1,R4,Average\n"
        "400,0.10,0.12,0.11,0.5,0.5,0.5\n403,0.20,0.26,0.23,0.6,0.6,0.6\n"
        "503.5,0.30,0.30,0.30,0.7,0.7,0.7\n",
        "made_up");
    EXPECT_EQ(file.format, "nist_m38597");
    ASSERT_EQ(file.spectra.size(), 6U);
    EXPECT_EQ(file.spectra[0].name, "subject 7 R1");
    EXPECT_EQ(file.spectra[4].name, "subject 9 R4");
    const Spectrum& mean = file.spectra[2];
    EXPECT_EQ(mean.name, "subject 7 mean");
    EXPECT_EQ(mean.quantity, Quantity::reflectance);
    EXPECT_EQ(mean.sigma_source, "from 2 repeats, pooled over 50 nm to either side");
    EXPECT_EQ(mean.repeats, (std::vector<Numbers>{{0.10, 0.20, 0.30}, {0.12, 0.26, 0.30}}));
    // Two readings that differ by d: the standard error of their mean is d / 2; rounding adds 1e-4 / sqrt(12).
    // Neighbours within 50 nm share the mean of their variances, the last stands alone.
    const double rounding = 1e-4 * 1e-4 / 12;
    const double shared = std::sqrt((0.01 * 0.01 + 0.03 * 0.03) / 2 + rounding);
    EXPECT_DOUBLE_EQ(mean.sigma[0], shared);
    EXPECT_DOUBLE_EQ(mean.sigma[1], shared);
    EXPECT_DOUBLE_EQ(mean.sigma[2], std::sqrt(rounding));
    EXPECT_DOUBLE_EQ(file.spectra[5].sigma[0], std::sqrt(rounding));
    EXPECT_TRUE(file.spectra[0].sigma.empty());
}

TEST(Formats, CgatsTakesTheUnitFromItsNormAndExactWavelengthsFromItsKeywords) {
    const std::string text =
        "SPECT\nMEAS_TYPE \"TRANSMISSIVE\"\nTARGET_INSTRUMENT \"made up\"\nSPECTRAL_BANDS \"4\"\n"
        "SPECTRAL_START_NM \"380.0\"\nSPECTRAL_END_NM \"390.0\"\nSPECTRAL_NORM \"100.0\"\n"
        "BEGIN_DATA_FORMAT\nSPEC_380 SPEC_383 SPEC_387 SPEC_390\nEND_DATA_FORMAT\nBEGIN_DATA\n1 1.2 1.4 "
        "0.5\nEND_DATA\n";
    const Spectrum spectrum = parse_spectra(text, "made_up").spectra.front();
    EXPECT_EQ(spectrum.unit_rule, "percent: stated by SPECTRAL_NORM");
    EXPECT_EQ(spectrum.value, (Numbers{1.0 / 100, 1.2 / 100, 1.4 / 100, 0.5 / 100}));
    EXPECT_EQ(spectrum.quantity, Quantity::transmittance);
    EXPECT_EQ(spectrum.instrument, "made up");
    EXPECT_EQ(spectrum.name, "set 1");
    EXPECT_DOUBLE_EQ(spectrum.wavelength_nm[1], 380 + 10.0 / 3);
    EXPECT_DOUBLE_EQ(spectrum.wavelength_nm[2], 380 + 20.0 / 3);
}

TEST(Formats, JcampFactorsMultiplyAbscissasAndOrdinatesInBothForms) {
    const std::string head = "##TITLE= one\n##XUNITS= NANOMETERS\n##YUNITS= REFLECTANCE\n";
    const std::string factors = "##XFACTOR= 4\n##YFACTOR= 0.125\n";
    const std::string steps = "##FIRSTX= 400\n##LASTX= 408\n##NPOINTS= 3\n##XYDATA= (X++(Y..Y))\n";
    const std::string pairs = "##XYPOINTS= (XY..XY)\n";
    for (const std::string& text :
         {head + factors + steps + "100 1 2 3\n##END=\n", head + factors + pairs + "100 1, 101 2, 102 3\n##END=\n"}) {
        const Spectrum spectrum = parse_spectra(text, "f.jdx").spectra.front();
        EXPECT_EQ(spectrum.wavelength_nm, (Numbers{400, 404, 408})) << text;
        EXPECT_EQ(spectrum.value, (Numbers{0.125, 0.25, 0.375})) << text;
    }
}

TEST(Formats, JsonListsInAnyOrderOfWavelengthsReadTheSame) {
    const Spectrum up = parse_spectra(R"({"wavelength_nm": [400, 410, 420, 430], "value": [0.1, 0.2, null, 0.4],
                                          "sigma": [0.01, 0.02, null, 0.04], "repeats": [[0.11, 0.21, null, 0.41]]})",
                                      "f")
                            .spectra.front();
    const Spectrum mixed = parse_spectra(R"({"wavelength_nm": [420, 430, 410, 400], "value": [null, 0.4, 0.2, 0.1],
                                             "sigma": [null, 0.04, 0.02, 0.01], "repeats": [[null, 0.41, 0.21, 0.11]]})",
                                         "f")
                               .spectra.front();
    EXPECT_EQ(up.repeats, (std::vector<Numbers>{{0.11, 0.21, 0.41}}));
    EXPECT_EQ(mixed.wavelength_nm, up.wavelength_nm);
    EXPECT_EQ(mixed.value, up.value);
    EXPECT_EQ(mixed.sigma, up.sigma);
    EXPECT_EQ(mixed.repeats, up.repeats);
}

TEST(Formats, JsonCarriesTheWholeDescription) {
    const Spectrum spectrum =
        parse_spectra(R"({"name": "arm", "quantity": "reflectance", "incidence_deg": 8, "specular": "included",
                          "instrument": "made up", "site": "inside", "aperture_mm": 3, "bandpass_shape": "triangular",
                          "bandpass_width_nm": 10, "operator": "A", "wavelength_nm": [400, 410], "value": [0.1, 0.2],
                          "sigma": [0.01, 0.02], "repeats": [[0.09, 0.2], [0.11, 0.2]]})",
                      "made_up")
            .spectra.front();
    EXPECT_EQ(spectrum.name, "arm");
    EXPECT_EQ(spectrum.quantity, Quantity::reflectance);
    EXPECT_EQ(spectrum.geometry.incidence_deg, 8.0);
    EXPECT_EQ(spectrum.geometry.specular, Specular::included);
    EXPECT_EQ(spectrum.bandpass->width_nm, 10.0);
    EXPECT_EQ(spectrum.sigma, (Numbers{0.01, 0.02}));
    EXPECT_EQ(spectrum.repeats.size(), 2U);
    EXPECT_EQ(spectrum.notes.front().key, "operator");
}

TEST(Formats, ASpectrumIsChosenByNameThenByNumber) {
    const std::string text = "id,400,410,420\na,0.1,0.2,0.3\nb,0.4,0.5,0.6\n";
    EXPECT_EQ(parse_spectra(text, "f", {.column = "b"}).spectra.front().value, (Numbers{0.4, 0.5, 0.6}));
    EXPECT_EQ(parse_spectra(text, "f", {.column = "2"}).spectra.front().name, "b");
    const std::string numbered = "id,400,410,420\n2,0.1,0.2,0.3\n3,0.4,0.5,0.6\n";
    EXPECT_EQ(parse_spectra(numbered, "f", {.column = "2"}).spectra.front().value, (Numbers{0.1, 0.2, 0.3}));
    EXPECT_THROW((void)parse_spectra(numbered, "f", {.column = "1"}), InputError) << "names that are numbers are names";
}

}  // namespace
}  // namespace skinfit
