#include <gtest/gtest.h>

#include <filesystem>

#include "core/input_error.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit {
namespace {

struct Case {
    std::string text;
    std::string where;     ///< with which the message starts
    std::string contains;  ///< further on in it
};

/// Expects that the text is refused in one line of the four parts `<where>: <problem> (<why>); <what to do>`.
void expect_refusal(const Case& refused) {
    SCOPED_TRACE(refused.text);
    try {
        (void)parse_spectrum(refused.text, "a.csv");
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with(refused.where + ": ")) << message;
        EXPECT_NE(message.find(refused.contains), std::string::npos) << message;
        EXPECT_EQ(message.find_first_of("\n\r\t"), std::string::npos) << message;
        EXPECT_LT(message.find(" ("), message.find("); ")) << message;
        EXPECT_NE(message.find("); "), std::string::npos) << message;
    }
}

TEST(TextReaderRefuses, TextWithoutNumbers) {
    expect_refusal({"", "a.csv", "is empty"});
    expect_refusal({" \r\n\t\n", "a.csv", "is empty"});
    expect_refusal({"\xEF\xBB\xBF", "a.csv", "is empty"});
    expect_refusal({"# unit: percent\n#\n", "a.csv", "holds no numbers"});
    expect_refusal({"# note\nwavelength_nm,reflectance\n", "a.csv", "holds no numbers"});
    expect_refusal({",,\n", "a.csv", "holds no numbers"});
}

TEST(TextReaderRefuses, BinaryText) {
    expect_refusal({std::string("400,0.5\n4\0000", 11), "a.csv:2", "control byte 0x00"});
    expect_refusal({"400,0.5\n\x1b[0m\n", "a.csv:2", "control byte 0x1b"});
    expect_refusal({"400,0.5\x7f\n", "a.csv:1", "control byte 0x7f"});
}

TEST(TextReaderRefuses, LinesThatAreNeitherCommentNorHeaderNorNumbers) {
    expect_refusal({"Title\nnm,R\nO400,0.5\n410,0.5\n", "a.csv:3", "starts with the word \"O400\""});
    expect_refusal({"nm,R\n400,0.5\nend,0\n", "a.csv:3", "starts with the word \"end\""});
    expect_refusal({"nm,R\n\n4OO,0.5\n", "a.csv:3", "\"4OO\" as nm"});
    expect_refusal({"4OO,0.5\n500,0.5\n", "a.csv:1", "\"4OO\" as the wavelength"});
    expect_refusal({"400,O.5\n500,0.5\n", "a.csv:1", "\"O.5\" as column 1"});
    expect_refusal({"400,0.5 V\n", "a.csv:1", "\"0.5 V\" as column 1"});
}

TEST(TextReaderRefuses, MissingAndInfiniteNumbers) {
    expect_refusal({"nm,R\n400,\n410,\n", "a.csv:2", "R is empty"});
    expect_refusal({"nm,R\n400,NaN\n", "a.csv:2", "R is \"NaN\""});
    expect_refusal({"nm,R\n400,-nan\n", "a.csv:2", "R is \"-nan\""});
    expect_refusal({"nm,R\n400,inf\n", "a.csv:2", "R is \"inf\""});
    expect_refusal({"nm,R\n400,1e999\n", "a.csv:2", "\"1e999\" as R"});
    expect_refusal({"nm,R\n,0.5\n", "a.csv:2", "nm is empty"});
    expect_refusal({",0.5\n500,0.5\n", "a.csv:1", "the wavelength is empty"});
    expect_refusal({"nm,R,sigma\n400,0.5,\n410,0.5,1\n", "a.csv:2", "sigma has no number at 400 nm"});
}

TEST(TextReaderRefuses, LinesOfOtherLengths) {
    expect_refusal({"nm,R\n400,0.5\n410\n", "a.csv:3", "has 1 field (line 1 has 2)"});
    expect_refusal({"nm,R\n400,0.5,0.6\n", "a.csv:2", "has 3 fields (line 1 has 2)"});
    expect_refusal({"400 0.5\n410 0.5 0.6\n", "a.csv:2", "has 3 fields (line 1 has 2)"});
    expect_refusal({"nm,R,T\n400,0.5\n", "a.csv:2", "has 2 fields (line 1 has 3)"});
    expect_refusal({"Wavelength\n400,0.5\n", "a.csv:2", "has 2 fields (line 1 has 1)"});
    expect_refusal({"400\n410\n", "a.csv:1", "has one column"});
}

TEST(TextReaderRefuses, DecimalCommasThatCanBeReadInTwoWays) {
    expect_refusal({"400,5 0,12\n", "a.csv:1", "decimal"});
    expect_refusal({"nm R\n400 0,12\n", "a.csv:2", "decimal"});
    expect_refusal({"400,0,12\n410,0,13\n", "a.csv:1", "decimal"});
    expect_refusal({"nm,R\n400,0,12\n", "a.csv:2", "has 3 fields"});
    expect_refusal({"nm;R\n400,5;0,12\n401.5;0,13\n", "a.csv:3", "\"401.5\" as nm (other fields have a decimal comma"});
    expect_refusal({"nm;R\n400;1.000,5\n", "a.csv:2", "two ways"});
    expect_refusal({"nm;R\n400;1,000,5\n", "a.csv:2", "separator of thousands"});
}

TEST(TextReaderRefuses, RepeatedWavelengths) {
    expect_refusal({"nm,R\n410,0.5\n400,0.5\n410.0,0.6\n", "a.csv:4", "repeats the wavelength 410 nm (line 2"});
}

TEST(TextReaderRefuses, WavelengthsThatAreNotInNanometres) {
    for (const std::string wavelength : {"0", "-400", "0.4", "4e-7", "99.999", "10001"}) {
        expect_refusal({"500,0.5\n" + wavelength + ",0.5\n", "a.csv:2", "the wavelength is "});
    }
}

TEST(TextReaderRefuses, ValuesThatAreNoFractions) {
    expect_refusal({"400,0.5\n410,-0.001\n", "a.csv:2", "the value -0.001 at 410 nm is negative"});
    expect_refusal({"400,50\n410,-1\n", "a.csv:2", "the value -0.01 at 410 nm is negative"});
    expect_refusal({"400,0.3\n410,2.5\n420,0.4\n", "a.csv:2", "the value 2.5 at 410 nm exceeds 1.5"});
    expect_refusal({"400,50\n410,151\n", "a.csv:2", "the value 1.51 at 410 nm exceeds 1.5"});
    expect_refusal({"wavelength_um,R\n0.41,0.5\n0.4,-1\n", "a.csv:3", "the value -1 at 400 nm is negative"});
    expect_refusal({"# unit: fraction\n400,1.6\n", "a.csv:2", "taken as fraction: stated by a comment"});
}

TEST(TextReaderRefuses, UncertaintiesThatAreNotAboveZero) {
    expect_refusal({"nm,R,sigma\n400,0.5,0\n410,0.5,0.1\n", "a.csv:2", "sigma is 0 at 400 nm"});
    expect_refusal({"nm,R,R_sigma\n400,0.5,-0.1\n", "a.csv:2", "R_sigma is -0.1 at 400 nm"});
    expect_refusal({"nm,R,sigma\n400,0.5,1e-155\n", "a.csv:2", "sigma is 1e-155 at 400 nm"});
    expect_refusal({"nm,R,sigma\n400,0.5,1e155\n", "a.csv:2", "sigma is 1e+155 at 400 nm"});
    expect_refusal({"nm,R,sigma\n400,0.5,inf\n", "a.csv:2", "sigma is \"inf\""});
}

TEST(TextReaderRefuses, KnownKeysWithBadValues) {
    const std::string data = "400,0.5\n";
    expect_refusal({data + "# incidence_deg: abc\n", "a.csv:2", "incidence_deg is \"abc\""});
    expect_refusal({"# incidence_deg: 90\n" + data, "a.csv:1", "incidence_deg is \"90\""});
    expect_refusal({"# incidence_deg: -1\n" + data, "a.csv:1", "incidence_deg is \"-1\""});
    expect_refusal({"# incidence_deg: nan\n" + data, "a.csv:1", "incidence_deg is \"nan\""});
    expect_refusal({"# unit: nm\n" + data, "a.csv:1", "it must be fraction or percent"});
    expect_refusal({"# quantity:\n" + data, "a.csv:1", "it must be reflectance or transmittance"});
    expect_refusal({"# specular: yes\n" + data, "a.csv:1", "it must be included or excluded"});
    expect_refusal({"# unit: percent\n# unit: percent\n" + data, "a.csv:2", "gives unit again (line 1"});
}

TEST(TextReaderRefuses, FilesThatAreMissingOrFolders) {
    const std::filesystem::path folder = testing::TempDir();
    EXPECT_THROW((void)read_spectrum(folder), InputError);
    EXPECT_THROW((void)read_spectrum(folder / "no such file.csv"), InputError);
    EXPECT_THROW((void)read_spectrum(""), InputError);
}

}  // namespace
}  // namespace skinfit
