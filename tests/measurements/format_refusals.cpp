#include <gtest/gtest.h>

#include "core/input_error.hpp"
#include "measurements/limits.hpp"
#include "measurements/spectrum_file.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit {
namespace {

struct Refusal {
    std::string text;
    std::string message;
};

std::string message_of(const std::string& text) {
    return test::refusal_of([&] { (void)parse_spectra(text, "f"); });
}

void expect_messages(const std::vector<Refusal>& refusals) {
    for (const Refusal& refusal : refusals) EXPECT_EQ(message_of(refusal.text), refusal.message) << refusal.text;
}

const std::string unchanged = "check that the file is complete and unchanged";
const std::string json_example = "`skinfit convert --format json` writes an example";

TEST(FormatRefusals, OfFilesThatAreNoText) {
    expect_messages({
        {"PK\x03\x04...",
         "f: is a zip archive (plain text is needed; spreadsheets such as .xlsx and .ods are zip archives "
         "too); unpack it, or export the spreadsheet as CSV in UTF-8"},
        {"id,400,410,420\na,1,\x01,3\n",
         "f:2: holds the control byte 0x01 (plain text is needed; this is a binary, "
         "spreadsheet or UTF-16 file); export it as plain text or CSV in UTF-8"},
        {std::string("\xff\xfe") + std::string("4\0000\0000\0", 6),
         "f:1: holds the control byte 0x00 (plain text is needed; this is a binary, spreadsheet or UTF-16 file); "
         "export it "
         "as plain text or CSV in UTF-8"},
        {"400,0.5\n" + std::string(longest_line_bytes + 1, '1'),
         "f:2: has more than 16 MiB in one line (no file of spectra has such lines); check that this is a file of "
         "spectra"},
    });
}

TEST(FormatRefusals, OfRows) {
    expect_messages({
        {"id,400,410,420\na,0.1,0.2\n",
         "f:2: has 3 fields (line 1 has 4); give every spectrum one field per name and wavelength of the header"},
        {"id,400,410,420\na,0.1,0.2,0.3,0.4\n",
         "f:2: has 5 fields (line 1 has 4); give every spectrum one field per name and wavelength of the header"},
        {"id,400,410,420\na,0.1,O.2,0.3\n",
         "f:2: holds \"O.2\" as the value at 410 nm (a number is needed); correct the field or delete the line"},
        {"id,400,410,420\n",
         "f: holds no numbers (the first line names the cells: an id, then at least three wavelengths "
         "in nm); check that the file is complete, or choose another --reader"},
        {"id,400,410,420\na,,,\n",
         "f: holds no numbers (every value of every spectrum is missing); check that the file is complete"},
    });
}

TEST(FormatRefusals, OfCgats) {
    const std::string begin = "CTI3\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400 SPEC_410\nEND_DATA_FORMAT\n";
    expect_messages({
        {begin + "BEGIN_DATA\na 10 20\n",
         "f: ends inside its data (END_DATA is missing); check that the file is complete"},
        {begin + "BEGIN_DATA\na 10 20\nb 10\nEND_DATA\n",
         "f:7: has 2 words for 3 fields (every set has a value for each field); check that the file is complete"},
        {begin + "NUMBER_OF_SETS 3\nBEGIN_DATA\na 10 20\nEND_DATA\n",
         "f: holds 1 sets (NUMBER_OF_SETS promises 3); check that the file is complete"},
        {begin + "BEGIN_DATA\na 10 x\nEND_DATA\n",
         "f:6: holds \"x\" as SPEC_410 (a number is needed); correct the value, or write 0 for one that is missing"},
        {"CTI3\nBEGIN_DATA_FORMAT\nRGB_R\nEND_DATA_FORMAT\nBEGIN_DATA\n1\nEND_DATA\n",
         "f: holds no spectra (no table has fields such as SPEC_360, or pairs of SPECTRAL_NM and SPECTRAL_PCT, with "
         "numbers in them; it has RGB_R); export the measurement with its spectral values"},
        {begin + "BEGIN_DATA\na 0 0\nEND_DATA\n",
         "f: holds no spectra (no table has fields such as SPEC_360, or pairs of SPECTRAL_NM and SPECTRAL_PCT, with "
         "numbers in them; it has SAMPLE_ID, SPEC_400, SPEC_410); export the measurement with its spectral values"},
    });
}

TEST(FormatRefusals, OfJcampDx) {
    const std::string head = "##TITLE= a\n##XUNITS= NANOMETERS\n##YUNITS= REFLECTANCE\n";
    const std::string steps = head + "##FIRSTX= 400\n##LASTX= 420\n";
    expect_messages({
        {"##TITLE= a\n##END=\n",
         "f: holds no spectra (no block of it has ##XYDATA= or ##XYPOINTS= with values); export the "
         "spectrum as one of these; peak tables and NTUPLES are not read"},
        {steps + "##XYDATA= (X++(Y..Y))\n400 1 2 3\n##END=\n",
         "f:1: ##NPOINTS= is missing (the block needs it); add it, or export the spectrum again"},
        {steps + "##NPOINTS= 1E+18\n##XYDATA= (X++(Y..Y))\n400 1 2 3\n##END=\n",
         "f:6: ##NPOINTS= is 1e+18 (1 to 10000000 are read); correct it, or split the file"},
        {steps + "##NPOINTS= many\n##XYDATA= (X++(Y..Y))\n400 1 2 3\n##END=\n",
         "f:6: ##NPOINTS= is \"many\" (a number is needed); correct it, or export the spectrum again"},
        {steps + "##NPOINTS= 3\n##XYDATA= (X++(Y..Y))\n400 1 2 3 4\n##END=\n",
         "f:7: holds 4 or more points (##NPOINTS= promises 3); " + unchanged},
        {steps + "##NPOINTS= 3\n##XYDATA= (X++(Y..Y))\n400 1 2 !\n##END=\n",
         "f:8: holds \"!\" among its numbers (it has none of the forms AFFN, PAC, SQZ, DIF and DUP); " + unchanged},
        {steps + "##NPOINTS= 3\n##XYDATA= (R++(A..A))\n400 1 2 3\n##END=\n",
         "f:7: has the form \"(R++(A..A))\" (only (X++(Y..Y)) and (XY..XY) are read); export the spectrum again in one "
         "of "
         "these"},
        {head + "##XYPOINTS= (XY..XY)\n400 0.1 410\n##END=\n",
         "f:5: has 3 numbers (points are pairs of an abscissa and an ordinate); " + unchanged},
        {"##TITLE= a\n##XUNITS= SECONDS\n##YUNITS= REFLECTANCE\n##XYPOINTS= (XY..XY)\n400 0.1\n##END=\n",
         "f:2: ##XUNITS= is \"SECONDS\" (it must be a unit of wavelengths such as NANOMETERS or MICROMETERS, 1/CM, or "
         "a "
         "unit of frequency); correct it, or export the spectrum again"},
        {"##TITLE= a\n##XUNITS= NANOMETERS\n##YUNITS= ABSORBANCE\n##XYPOINTS= (XY..XY)\n400 0.1\n##END=\n",
         "f:3: ##YUNITS= is \"ABSORBANCE\" (only REFLECTANCE and TRANSMITTANCE are spectra that can be used); export "
         "reflectance or transmittance; an absorbance A is a share of light 10^-A"},
    });
}

TEST(FormatRefusals, OfJson) {
    expect_messages({
        {"{\"start\": 400,\n\"step\"}", "f:2: is no JSON (unexpected '}'); correct this line; " + json_example},
        {std::string(100, '['),
         "f: nests more than 64 deep (no file of ours is so deep); check that this is the right file"},
        {"{}", "f: has no values (one list of numbers is needed, called value or values); correct it; " + json_example},
        {R"({"values": [0.1]})",
         "f: has no wavelengths (wavelength_nm, or start and step in nm, give them); add them; " + json_example},
        {R"({"start": 4e-7, "step": 1e-8, "values": [0.1, 0.2]})",
         "f: the wavelength is 4e-07 nm (it must lie between 100 and 10000 nm); give wavelengths in nanometres, or "
         "name "
         "their unit in the header"},
        {R"({"wavelength_nm": [400], "value": [0.1, 0.2]})",
         "f: wavelength_nm: [400] cannot be used (it has 1 numbers for 2 wavelengths); correct it; " + json_example},
        {R"([{"start": 400, "step": 1, "value": ["x"]}])",
         "f: spectrum 1: value: \"x\" cannot be used (a number or null is needed); correct it; " + json_example},
        {R"({"start": 400, "step": 1, "value": [0.1], "specula": "included"})",
         R"(f: unknown name "specula" (it would have no effect); did you mean "specular"? Else rename it)"},
        {R"({"start": 400, "step": 1, "value": [0.1], "incidence_deg": 86})",
         "f: incidence_deg: 86 cannot be used (a number from 0 to 85 is needed); correct it; " + json_example},
        {R"({"start": 400, "step": 1, "value": [0.1], "specular": "half"})",
         "f: specular: \"half\" cannot be used (it must be included or excluded); correct it; " + json_example},
        {R"({"start": 400, "step": 1, "value": [0.1], "aperture_mm": 0})",
         "f: aperture_mm: 0 cannot be used (a number above 0 is needed); correct it; " + json_example},
        {R"({"start": 400, "step": 1, "value": [0.1], "bandpass_shape": "gaussian", "bandpass_width_nm": 100.5})",
         "f: bandpass_width_nm: 100.5 cannot be used (a number above 0 and at most 100 is needed); correct it; " +
             json_example},
        {R"({"start": 400, "step": 1, "value": [0.1], "bandpass_shape": "gaussian"})",
         "f: gives bandpass_shape alone (a bandpass is a shape and a width); add bandpass_width_nm"},
        {R"({"start": 400, "step": 1, "value": [0.1, 0.2], "repeats": [[0.1]]})",
         "f: repeats: [0.1] cannot be used (it has 1 numbers for 2 wavelengths); correct it; " + json_example},
        {R"({"start": 400, "start": 1, "value": [0.1]})",
         "f: gives \"start\" twice (only one of them could hold); keep one of the two"},
        {"[]", "f: holds no numbers (every value of every spectrum is missing); check that the file is complete"},
        {R"({"start": 400, "step": 1, "value": [1e999]})",
         "f: holds a number that is too large (it exceeds double precision); correct it; " + json_example},
    });
}

TEST(FormatRefusals, OfUnknownReadersAndSpectra) {
    try {
        (void)parse_spectra("400,0.5\n", "f", {}, "column");
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean columns?"), std::string::npos) << error.what();
    }
    try {
        (void)parse_spectra("id,400,410,420\na,1,2,3\nb,1,2,3\n", "f", {.column = "c"});
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "f: has no spectrum \"c\" (it holds a, b; the nearest name is \"a\"); choose one by its name "
                     "or by its number, counted from 1");
    }
}

}  // namespace
}  // namespace skinfit
