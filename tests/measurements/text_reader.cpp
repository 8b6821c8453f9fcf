#include "measurements/text_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cfloat>

namespace skinfit {
namespace {

using Numbers = std::vector<double>;

const Numbers wavelengths{390.25, 400, 1e3 / 3};
const Numbers values{0.1, 2.0 / 3, 1e-300};

/// The numbers above as text, in shortest digits that read back to the same double.
std::string text_of(const std::string& separator, const std::string& line_end, const std::string& header = "",
                    char decimal_mark = '.') {
    std::string text = header;
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::string line = fmt::format("{}|{}", wavelengths[i], values[i]);
        for (char& c : line) {
            if (c == '.') c = decimal_mark;
        }
        text += line.replace(line.find('|'), 1, separator) + line_end;
    }
    return text;
}

void expect_the_numbers(const std::string& text) {
    const Spectrum spectrum = parse_spectrum(text, "a.txt");
    EXPECT_EQ(spectrum.wavelength_nm, (Numbers{1e3 / 3, 390.25, 400})) << text;
    EXPECT_EQ(spectrum.value, (Numbers{1e-300, 0.1, 2.0 / 3})) << text;
}

TEST(TextReader, ReadsTheSameNumbersForEverySeparatorAndLineEnd) {
    for (const std::string line_end : {"\n", "\r\n", "\r", "\n\n", "  \t\n", " # note\r\n"}) {
        for (const std::string separator : {",", ";", "\t", " ", "   ", " , ", " \t", " ; "}) {
            expect_the_numbers(text_of(separator, line_end));
        }
    }
}

TEST(TextReader, ReadsTheSameNumbersWithDecimalCommasBetweenTabsOrSemicolons) {
    for (const std::string separator : {";", "\t", " ; "}) {
        expect_the_numbers(text_of(separator, "\n", "", ','));
        expect_the_numbers(text_of(separator, separator + "\n", "nm" + separator + "\"a, b; c\"\n", ','));
    }
}

TEST(TextReader, IgnoresWhatCarriesNoNumbers) {
    expect_the_numbers("\xEF\xBB\xBF" + text_of(",", "\n", "nm,value\n"));
    expect_the_numbers(text_of(",", ",\n", "nm,value,\n"));
    expect_the_numbers(text_of(",", ",,\n", "nm,value\n"));
    expect_the_numbers(text_of(",", ",\n"));
    expect_the_numbers(text_of(" ", " \n", "\"wave length\" \"value\"\n"));
    expect_the_numbers("# note\n\n  # note: 1\n" + text_of(",", "\n,,\n\n", "nm,value\n") + "#");
}

TEST(TextReader, ReadsQuotedNumbersAndNames) {
    const Spectrum spectrum = parse_spectrum("\"Wavelength, nm\",\"the \"\"left\"\" arm, #1\"\n\"+400\",\"5e-1\"\n",
                                             "a", {.column = "the \"left\" arm, #1"});
    EXPECT_EQ(spectrum.wavelength_nm, Numbers{400});
    EXPECT_EQ(spectrum.value, Numbers{0.5});
}

TEST(TextReader, SortsValuesAndUncertaintiesWithTheirWavelengths) {
    const Spectrum spectrum = parse_spectrum("nm,R,sigma\n500,0.5,0.05\n400,0.4,0.04\n600,0.6,0.06\n", "a");
    EXPECT_EQ(spectrum.wavelength_nm, (Numbers{400, 500, 600}));
    EXPECT_EQ(spectrum.value, (Numbers{0.4, 0.5, 0.6}));
    EXPECT_EQ(spectrum.sigma, (Numbers{0.04, 0.05, 0.06}));
}

TEST(TextReader, LeavesOutAndCountsMissingValues) {
    const Spectrum spectrum =
        parse_spectrum("nm,R,sigma\n400,0.4,0.04\n410,,\n420,NaN,0.1\n430,n/a,\n440,0.5,0.05\n", "a");
    EXPECT_EQ(spectrum.wavelength_nm, (Numbers{400, 440}));
    EXPECT_EQ(spectrum.value, (Numbers{0.4, 0.5}));
    EXPECT_EQ(spectrum.sigma, (Numbers{0.04, 0.05}));
    EXPECT_EQ(spectrum.missing_nm.size(), 3U);
}

TEST(TextReader, TurnsPercentIntoFractions) {
    const Spectrum percent = parse_spectrum("nm,R,R_sigma\n400,57.23,0.31\n", "a");
    const Spectrum fraction = parse_spectrum("nm,R,R_sigma\n400,0.5723,0.0031\n", "a");
    // Rounding of the decimal text, of the quotient and of the fraction's text: 3 times half a unit in the last place.
    EXPECT_NEAR(percent.value[0], fraction.value[0], 1.5 * DBL_EPSILON * 0.5723);
    EXPECT_NEAR(percent.sigma[0], fraction.sigma[0], 1.5 * DBL_EPSILON * 0.0031);
}

TEST(TextReader, TakesTheUnitFromOptionThenCommentThenHeaderThenTheLargestValue) {
    const auto rule = [](const std::string& text, std::optional<Unit> unit = std::nullopt) {
        const Spectrum spectrum = parse_spectrum(text, "a", {.unit = unit});
        return fmt::format("{} ({})", spectrum.unit_rule, spectrum.value.back());
    };
    const std::string fraction = "# unit: fraction\n";
    const std::string percent = "# unit: Percent\n";
    EXPECT_EQ(rule(fraction + "nm,R\n400,0.5\n", Unit::percent), "percent: stated by the option (0.005)");
    EXPECT_EQ(rule(percent + "nm,R %\n400,0.5\n", Unit::fraction), "fraction: stated by the option (0.5)");
    EXPECT_EQ(rule(fraction + "nm,R %\n400,0.5\n"), "fraction: stated by a comment in the file (0.5)");
    EXPECT_EQ(rule(percent + "nm,R\n400,0.5\n"), "percent: stated by a comment in the file (0.005)");
    EXPECT_EQ(rule("nm,R (%)\n400,0.5\n"), "percent: stated by the header (0.005)");
    EXPECT_EQ(rule("nm,Percent R\n400,0.5\n"), "percent: stated by the header (0.005)");
    EXPECT_EQ(rule("400,0.25\n500,1.5\n"), "fraction: most values are at most 1.5 (1.5)");
    EXPECT_EQ(rule("400,1\n500,2\n600,1.6\n"), "percent: half of the values or more exceed 1.5 (0.016)");
}

TEST(TextReader, TakesTheDescriptionFromComments) {
    const Spectrum spectrum = parse_spectrum(
        "# specimen: left arm: inside\n# quantity: transmittance\n# incidence_deg: 45\n400,0.5\n# specular: excluded\n"
        "# note: unit: miles\n# operator: unknown\n# plain\n",
        "folder/a.txt");
    EXPECT_EQ(spectrum.name, "left arm: inside");
    EXPECT_EQ(spectrum.source, "folder/a.txt");
    EXPECT_EQ(spectrum.quantity, Quantity::transmittance);
    EXPECT_EQ(spectrum.geometry.incidence_deg, 45.0);
    EXPECT_EQ(spectrum.geometry.specular, Specular::excluded);
}

TEST(TextReader, LeavesOpenWhatTheFileDoesNotSay) {
    const Spectrum spectrum = parse_spectrum("400,0.5\n", "folder/left arm.txt");
    EXPECT_EQ(spectrum.name, "left arm");
    EXPECT_EQ(spectrum.quantity, std::nullopt);
    EXPECT_EQ(spectrum.geometry.incidence_deg, std::nullopt);
    EXPECT_EQ(spectrum.geometry.specular, std::nullopt);
    EXPECT_TRUE(spectrum.sigma.empty());
}

}  // namespace
}  // namespace skinfit
