#include "measurements/jcamp_values.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/input_error.hpp"
#include "measurements/spectrum_file.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit {
namespace {

using Numbers = std::vector<double>;

TEST(JcampValues, TheStandardsExampleReadsTheSameInEveryForm) {
    // McDonald and Wilks 1988, Sec. 5: the same ordinates in FIX, PAC, SQZ, DIF and DIFDUP form, here after 400.
    const Numbers ordinates{1, 2, 3, 3, 2, 1, 0, -1, -2, -3};
    for (const std::string form : {" 1 2 3 3 2 1 0 -1 -2 -3", "+1+2+3+3+2+1+0-1-2-3", "ABCCBA@abc", "AJJ%jjjjjj",
                                   "AJJ%jX", " 1, 2, 3, 3E+00, 2, 1, 0, -1, -2, -3"}) {
        const JcampLine line = decode_jcamp_line("400" + form, "f:1");
        EXPECT_EQ(line.abscissa, 400) << form;
        EXPECT_EQ(line.ordinates, ordinates) << form;
        EXPECT_EQ(line.ends_in_difference, form.starts_with("AJ")) << form;
    }
}

TEST(JcampValues, PseudoDigitsStandBeforeOrdinaryOnes) {
    EXPECT_EQ(decode_jcamp_line("599.86 H000@I0b57K3j1", "f:1").ordinates, (Numbers{8000, 0, 90, -257, -234, -245}));
    EXPECT_EQ(decode_jcamp_line("A00B5S2", "f:1").ordinates.size(), 12U) << "S2 counts to 12";
    EXPECT_EQ(decode_jcamp_line("100 E23", "f:1").ordinates, Numbers{523}) << "E is a digit unless a sign follows";
    EXPECT_EQ(decode_jcamp_line("100 1E-1 2.5E+1", "f:1").ordinates, (Numbers{0.1, 25}));
    EXPECT_TRUE(std::isnan(decode_jcamp_line("100 1 ? 2", "f:1").ordinates[1]));
}

TEST(JcampValues, DuplicatesOfADifferenceAreDifferences) {
    EXPECT_EQ(decode_jcamp_line("1 ABT", "f").ordinates, (Numbers{1, 2, 2}));
    EXPECT_EQ(decode_jcamp_line("1 AKU", "f").ordinates, (Numbers{1, 3, 5, 7}));
}

TEST(JcampValues, WhatHasNoFormIsRefused) {
    for (const std::string line : {"J 1", "T1", "1 J", "1 T", "1 A!", "1 AT9999999", "1 1E+999", "1 ..", "1 +", "u"}) {
        EXPECT_THROW((void)decode_jcamp_line(line, "f:1"), InputError) << line;
    }
    EXPECT_TRUE(decode_jcamp_line(" ", "f:1").ordinates.empty());
}

std::string block(const std::string& title, const std::string& data, const std::string& points = "10") {
    return "##TITLE= " + title + "\n##XUNITS= NANOMETERS\n##YUNITS= REFLECTANCE\n##XFACTOR= 1\n##YFACTOR= 0.01\n" +
           "##FIRSTX= 400\n##LASTX= 490\n##NPOINTS= " + points + "\n##XYDATA= (X++(Y..Y)) $$ a comment\n" + data +
           "##END=\n";
}

std::string refusal(const std::string& text) {
    return test::refusal_of([&] { (void)parse_spectra(text, "f.jdx"); });
}

TEST(JcampDx, ALineOfDifferencesIsCheckedByTheNext) {
    const Numbers ordinates{0.01, 0.02, 0.03, 0.03, 0.02, 0.01, 0.0, -0.01, -0.02, -0.03};
    for (const std::string data :
         {"400AJJ%jX\n", "400AJJ%\n430Cjjjjjj\n", "400ABCC\n440B jjjjj\n", "400AJJ%jX\n490c\n"}) {
        const Numbers value = parse_spectra(block("a", data), "f").spectra.front().value;
        ASSERT_EQ(value.size(), 10U) << data;
        for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(value[i], ordinates[i] * 100 * 0.01) << data;
    }
    EXPECT_EQ(
        refusal(block("a", "400AJJ%\n430Bjjjjjj\n")),
        "f.jdx:11: its first ordinate is 2, and the line before ended with 3 (after a line of differences it repeats "
        "that as a check); check that the file is complete and unchanged");
}

TEST(JcampDx, LostPointsAreFound) {
    EXPECT_EQ(refusal(block("a", "400 1 2 3\n")),
              "f.jdx:9: holds 3 points (##NPOINTS= promises 10); check that the file is complete and unchanged");
    EXPECT_EQ(refusal(block("a", "400 1 2 3\n470 4 5\n")),
              "f.jdx:11: starts at 470, not 430 (the points before it are too few or too many for ##NPOINTS= 10 "
              "from ##FIRSTX= 400 to ##LASTX= 490); check that the file is "
              "complete and unchanged");
}

TEST(JcampDx, LinkedBlocksAreSpectra) {
    const SpectrumFile file =
        parse_spectra("##TITLE= both\n##DATA TYPE= LINK\n##BLOCKS= 2\n" + block("a", "400AJJ%jX\n") +
                          block("b", "400 1 1 1 1 1\n450 1 1 1 1 1\n") + "##END=\n",
                      "f");
    ASSERT_EQ(file.spectra.size(), 2U);
    EXPECT_EQ(file.spectra[0].name, "a");
    EXPECT_EQ(file.spectra[1].name, "b");
    EXPECT_EQ(file.spectra[1].line, 23U);
}

TEST(JcampDx, WavenumbersBecomeWavelengths) {
    const Spectrum spectrum =
        parse_spectra(
            "##TITLE= a\n##XUNITS= 1/CM\n##YUNITS= TRANSMITTANCE\n##XYPOINTS= (XY..XY)\n25000 0.4\n20000 0.5\n##END=\n",
            "f")
            .spectra.front();
    EXPECT_EQ(spectrum.wavelength_nm, (Numbers{400, 500}));
    EXPECT_EQ(spectrum.value, (Numbers{0.4, 0.5}));
    EXPECT_EQ(spectrum.quantity, Quantity::transmittance);
}

}  // namespace
}  // namespace skinfit
