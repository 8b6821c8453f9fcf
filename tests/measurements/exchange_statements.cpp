#include <fmt/format.h>
#include <gtest/gtest.h>

#include "measurements/quality_checks.hpp"
#include "measurements/spectrum_file.hpp"
#include "tests/support/refusal.hpp"

/// What JCAMP-DX, CGATS and QTX files state is heeded, checked or refused.
namespace skinfit {
namespace {

using Numbers = std::vector<double>;

std::vector<Spectrum> spectra_of(const std::string& text) {
    return parse_spectra(text, "f").spectra;
}

Spectrum only(const std::string& text) {
    const std::vector<Spectrum> spectra = spectra_of(text);
    EXPECT_EQ(spectra.size(), 1U);
    return spectra.front();
}

std::string refusal(const std::string& text) {
    return test::refusal_of([&] { (void)spectra_of(text); });
}

bool contains_text(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string jcamp(const std::string& x_unit, const std::string& y_unit, const std::string& rest) {
    return "##TITLE= a\n##XUNITS= " + x_unit + "\n##YUNITS= " + y_unit + "\n" + rest + "##END=\n";
}

const std::string pairs = "##XYPOINTS= (XY..XY)\n400 0.1\n500 0.2\n600 0.3\n";

TEST(JcampStatements, UnitsOfManyMakersAreUnderstood) {
    for (const std::string y : {"Reflection", "REFLECTANCE FACTOR", "R", "Diffuse Reflectance", "Reflexion"}) {
        EXPECT_EQ(only(jcamp("NANOMETERS", y, pairs)).quantity, Quantity::reflectance) << y;
        EXPECT_EQ(only(jcamp("NANOMETERS", y, pairs)).value, (Numbers{0.1, 0.2, 0.3})) << y;
    }
    for (const std::string y : {"Transmission (%)", "PERCENT TRANSMITTANCE", "%T", "% Transmission"}) {
        EXPECT_EQ(only(jcamp("nm", y, pairs)).quantity, Quantity::transmittance) << y;
        EXPECT_EQ(only(jcamp("Wavelength (nm)", y, pairs)).value.front(), 0.1 / 100) << y;
    }
    const struct {
        std::string unit;
        std::string first;
    } abscissae[] = {{"1/CM", "25000"},           {"cm-1", "25000"},     {"MICROMETERS", "0.4"}, {"THZ", "749.481145"},
                     {"TERAHERTZ", "749.481145"}, {"Angstroms", "4000"}, {"\xB5m", "0.4"},       {"eV", "3.09960496"}};
    for (const auto& each : abscissae) {
        const Spectrum spectrum =
            only(jcamp(each.unit, "REFLECTANCE", "##XYPOINTS= (XY..XY)\n" + each.first + " 0.1\n"));
        EXPECT_NEAR(spectrum.wavelength_nm.front(), 400, 1e-5) << each.unit;
    }
    for (const std::string x : {"SECONDS", "", "ARBITRARY UNITS", "PIXEL"}) {
        EXPECT_TRUE(contains_text(refusal(jcamp(x, "REFLECTANCE", pairs)), "f:2: ##XUNITS= is")) << x;
    }
}

TEST(JcampStatements, FillNumbersAreMissingAndNoiseIsNot) {
    const auto values = [](const std::string& factor, const std::string& number) {
        return only(jcamp("NM", "R", "##YFACTOR= " + factor + "\n##XYPOINTS= (XY..XY)\n400 " + number + " 410 2000\n"))
            .value.size();
    };
    EXPECT_EQ(values("0.0001", "-9999"), 1U);
    EXPECT_EQ(values("1", "-999"), 1U);
    EXPECT_EQ(values("1", "1E+34"), 1U);
    EXPECT_EQ(values("0.00001", "-999"), 2U) << "noise about 0";
    EXPECT_EQ(values("0.0001", "9999"), 2U) << "a white";
    EXPECT_EQ(only(jcamp("NM", "R", "##$SPECULAR= excluded\n" + pairs)).geometry.specular, Specular::excluded);
}

TEST(JcampStatements, OtherQuantitiesAreRefusedWithTheWayOut) {
    for (const std::string y : {"ABSORBANCE", "KUBELKA-MUNK", "COUNTS", "ARBITRARY UNITS", "LOG(1/R)",
                                "log(1/Reflectance)", "INTENSITY", "K/S", "RADIANCE", "", "OPTICAL DENSITY"}) {
        const std::string message = refusal(jcamp("NANOMETERS", y, pairs));
        EXPECT_TRUE(contains_text(message, "f:3: ##YUNITS= is")) << y << message;
        EXPECT_TRUE(contains_text(message, "reflectance") || contains_text(message, "REFLECTANCE")) << message;
    }
    EXPECT_TRUE(contains_text(refusal(jcamp("1/CM", "REFLECTANCE", "##DATA TYPE= RAMAN SPECTRUM\n" + pairs)),
                              "##DATA TYPE= is \"RAMAN SPECTRUM\""));
}

TEST(JcampStatements, RecordsThatContradictTheDataAreAWarning) {
    const std::string steps = "##FIRSTX= 400\n##LASTX= 420\n##NPOINTS= 3\n##YFACTOR= 0.001\n";
    const std::string data = "##XYDATA= (X++(Y..Y))\n400 100 250 375\n";
    const struct {
        std::string records;
        std::string remark;
    } cases[] = {
        {"##FIRSTY= 0.1\n##MAXY= 0.375\n##MINY= 0.1\n##DELTAX= 10\n##MAXX= 420\n##MINX= 400\n", ""},
        {"##FIRSTY= 100\n##MAXY= 375\n", ""},
        {"##FIRSTY= 0,100\n", ""},
        {"##FIRSTY= 0.25\n", "##FIRSTY= is \"0.25\", and the data have 0.1"},
        {"##MAXY= 0.5\n", "##MAXY= is \"0.5\", and the data have 0.375"},
        {"##MINX= 390\n", "##MINX= is \"390\", and the data have 400"},
        {"##DELTAX= 5.0\n", "##DELTAX= is \"5.0\", and from ##FIRSTX= to ##LASTX= the step is 10"},
    };
    for (const auto& each : cases) {
        const Spectrum spectrum = only(jcamp("NM", "REFLECTANCE", steps + each.records + data));
        EXPECT_EQ(spectrum.value, (Numbers{0.1, 0.25, 0.375}));
        const std::optional<Finding> finding = doubtful_file(spectrum);
        EXPECT_EQ(finding.has_value(), !each.remark.empty()) << each.records;
        if (finding) {
            EXPECT_TRUE(contains_text(finding->message, each.remark)) << finding->message;
        }
    }
    const Spectrum shifted = only(jcamp("NM", "R", steps + "##XYDATA= (X++(Y..Y))\n410 100 250 375\n"));
    ASSERT_TRUE(doubtful_file(shifted));
    EXPECT_EQ(doubtful_file(shifted)->message, "line 9 starts at 410, and ##FIRSTX= is 400");
    const Spectrum moved = only(jcamp("NM", "REFLECTANCE", "##FIRSTX= 410\n##LASTX= 600\n" + pairs));
    ASSERT_TRUE(doubtful_file(moved));
    EXPECT_EQ(doubtful_file(moved)->message, "line 4: ##FIRSTX= is \"410\", and the data have 400");
    EXPECT_TRUE(contains_text(refusal(jcamp("NM", "REFLECTANCE", "##NPOINTS= 4\n" + pairs)), "holds 3 points"));
    EXPECT_TRUE(contains_text(refusal(jcamp("NM", "REFLECTANCE", "##YFACTOR= 0\n" + pairs)), "##YFACTOR= is 0"));
}

TEST(JcampStatements, DecimalCommasAreReadInEveryForm) {
    const std::string stated = "##FIRSTX= 400,0\n##LASTX= 402,0\n##NPOINTS= 3\n";
    const std::string unstated = "##FIRSTX= 400\n##LASTX= 402\n##NPOINTS= 3\n";
    const std::string steps = "##XYDATA= (X++(Y..Y))\n400,0 0,1 0,25 0,375\n";
    for (const std::string& head : {stated, unstated}) {
        EXPECT_EQ(only(jcamp("NM", "R", head + steps)).value, (Numbers{0.1, 0.25, 0.375})) << head;
        for (const std::string separator : {", ", "; ", " ", "\t"}) {
            const std::string text = "##XYPOINTS= (XY..XY)\n400,0" + separator + "0,1\n401,0" + separator +
                                     "0,25\n402,0" + separator + "0,375\n";
            EXPECT_EQ(only(jcamp("NM", "R", head + text)).value, (Numbers{0.1, 0.25, 0.375})) << head << separator;
        }
    }
    EXPECT_EQ(only(jcamp("NM", "R", unstated + "##XYPOINTS= (XY..XY)\n400,0.1\n401,0.25\n402,0.375\n")).value,
              (Numbers{0.1, 0.25, 0.375}))
        << "a comma may separate";
    EXPECT_EQ(only(jcamp("NM", "R", "##NPOINTS= 2\n##XYPOINTS= (XY..XY)\n400,1 401,0\n")).value, (Numbers{1, 0}))
        << "and of two readings the one that is promised counts";
}

TEST(JcampStatements, OneBadBlockHidesNoGoodOne) {
    const std::string good = jcamp("NM", "REFLECTANCE", pairs);
    for (const std::string& bad :
         {jcamp("NM", "COUNTS", pairs), jcamp("PIXEL", "REFLECTANCE", pairs),
          jcamp("NM", "R", "##NPOINTS= 9\n" + pairs), jcamp("NM", "R", "##XYDATA= (X++(Y..Y))\n400 1 2\n"),
          jcamp("NM", "R", "##XYDATA= (XYZ)\n400 1 2\n")}) {
        for (const std::string& text : {bad + good, good + bad}) {
            const Spectrum spectrum = only("##TITLE= all\n##DATA TYPE= LINK\n##BLOCKS= 2\n" + text + "##END=\n");
            EXPECT_EQ(spectrum.value, (Numbers{0.1, 0.2, 0.3}));
            ASSERT_TRUE(as_read(spectrum));
            EXPECT_TRUE(as_read(spectrum)->message.starts_with("1 of the file's spectra is left out: f:"));
        }
    }
}

std::string cgats(const std::string& keywords, const std::string& fields, const std::string& data) {
    return "CGATS.17\n" + keywords + "BEGIN_DATA_FORMAT\n" + fields + "\nEND_DATA_FORMAT\nBEGIN_DATA\n" + data +
           "\nEND_DATA\n";
}

TEST(CgatsStatements, FieldsOfManyMakersAreFound) {
    for (const std::string fields :
         {"SAMPLE_ID nm_400 nm_410 nm_420", "SAMPLE_ID SPECTRUM_400 SPECTRUM_410 SPECTRUM_420",
          "SAMPLE_ID R_400 R_410 R_420", "SAMPLE_ID 400_NM 410_NM 420_NM", "SAMPLE_ID 400nm 410nm 420nm",
          "SAMPLE_ID SPECTRAL_400 SPECTRAL_410 SPECTRAL_420", "SAMPLE_ID SPEC_400.0 SPEC_410.0 SPEC_420.0",
          "SAMPLE_ID SPECTRAL_DEC_400 SPECTRAL_DEC_410 SPECTRAL_DEC_420", "SampleID NM400 NM410 NM420"}) {
        const Spectrum spectrum = only(cgats("", fields, "a 0.1 0.25 0.375"));
        EXPECT_EQ(spectrum.wavelength_nm, (Numbers{400, 410, 420})) << fields;
        EXPECT_EQ(spectrum.value, (Numbers{0.1, 0.25, 0.375})) << fields;
        EXPECT_EQ(spectrum.name, "a") << fields;
    }
    EXPECT_EQ(only(cgats("", "SAMPLE_ID SPECTRAL_PCT_400 SPECTRAL_PCT_410", "a 1 1.25")).value,
              (Numbers{1.0 / 100, 1.25 / 100}));
    const std::string of_pairs = "SAMPLE_ID SPECTRAL_NM SPECTRAL_DEC SPECTRAL_NM SPECTRAL_DEC";
    EXPECT_EQ(only(cgats("", of_pairs, "a 410 0.25 400 0.1")).value, (Numbers{0.1, 0.25}));
    const std::vector<Spectrum> two =
        spectra_of(cgats("", "ID SCI_400 SCI_410 SCI_420 SCE_400 SCE_410 SCE_420", "1 0.2 0.3 0.4 0.1 0.2 0.3"));
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[0].geometry.specular, Specular::included);
    EXPECT_EQ(two[1].geometry.specular, Specular::excluded);
    EXPECT_EQ(two[1].value, (Numbers{0.1, 0.2, 0.3}));
    EXPECT_TRUE(contains_text(refusal(cgats("", "SAMPLE_ID LAB_L LAB_A", "a 1 2")), "it has SAMPLE_ID, LAB_L, LAB_A"));
    EXPECT_EQ(only(cgats("", "ID\tSPEC_400\tSPEC_410", "left arm\t12,5\t\n")).value, (Numbers{0.125}));
    EXPECT_EQ(refusal(cgats("", "ID SPEC_400 SPEC_410", "left arm 0.1 0.2")),
              "f:6: has 4 words for 3 fields (every set has a value for each field); put names with blanks in quotes");
}

TEST(CgatsStatements, KeywordsAreHeeded) {
    const std::string fields = "SAMPLE_ID SPEC_400 SPEC_410";
    EXPECT_EQ(only(cgats("SPECTRAL_NORM 10000\n", fields, "a 1000 2500")).value, (Numbers{0.1, 0.25}));
    EXPECT_TRUE(contains_text(refusal(cgats("SPECTRAL_NORM 0\n", fields, "a 1 2")), "SPECTRAL_NORM is \"0\""));
    for (const std::string keyword :
         {"MEAS_TYPE \"EMISSION\"", "MEAS_TYPE AMBIENT", "DEVICE_CLASS \"DISPLAY\"", "MEAS_TYPE \"DENSITY\"",
          "MEASUREMENT \"absorbance\"", "DESCRIPTOR \"spectral absorbance of skin\""}) {
        EXPECT_TRUE(contains_text(refusal(cgats(keyword + "\n", fields, "a 0.1 0.2")), "no reflectance")) << keyword;
    }
    const Spectrum old =
        only(cgats("MEASUREMENT_GEOMETRY \"45/0\"\nINSTRUMENTATION \"made up\"\n", fields, "a 0.1 0.2"));
    EXPECT_EQ(old.geometry.incidence_deg, 45.0);
    EXPECT_EQ(old.geometry.specular, Specular::excluded);
    EXPECT_EQ(old.instrument, "made up");
    const Spectrum sphere = only(cgats("MEASUREMENT_GEOMETRY \"d:8 SCI\"\n", fields, "a 0.1 0.2"));
    EXPECT_EQ(sphere.geometry.incidence_deg, 8.0);
    EXPECT_EQ(sphere.geometry.specular, Specular::included);
    EXPECT_EQ(only(cgats("", fields, "\"arm SCE\" 0.1 0.2")).geometry.specular, Specular::excluded);
    EXPECT_TRUE(as_read(only(cgats("FILTER \"Pol\"\n", fields, "a 0.1 0.2"))));
    const std::string range = "SPECTRAL_BANDS 3\nSPECTRAL_START_NM 380\nSPECTRAL_END_NM 400\n";
    EXPECT_TRUE(doubtful_file(only(cgats(range, fields, "a 0.1 0.2"))));
}

TEST(CgatsStatements, UncertaintiesAndFillNumbersAreHeeded) {
    const Spectrum spectrum = only(cgats(
        "SPECTRAL_NORM 100\n", "ID SPEC_400 SPEC_410 SPEC_420 STDEV_400 STDEV_410 STDEV_420", "a 10 -9999 20 1 2 3"));
    EXPECT_EQ(spectrum.value, (Numbers{0.1, 0.2}));
    EXPECT_EQ(spectrum.sigma, (Numbers{0.01, 0.03}));
    EXPECT_EQ(spectrum.missing_nm, Numbers{410});
    EXPECT_EQ(only(cgats("SPECTRAL_NORM 10000\n", "ID SPEC_400 SPEC_410", "a 9999 2500")).value.size(), 2U);
}

TEST(CgatsStatements, OneBadSetHidesNoGoodOne) {
    const Spectrum spectrum = only(cgats("", "SAMPLE_ID SPEC_400 SPEC_410", "a 0.1 0.2\nb x 0.2"));
    EXPECT_EQ(spectrum.name, "a");
    EXPECT_TRUE(contains_text(as_read(spectrum)->message, "holds \"x\" as SPEC_400"));
}

std::string qtx(const std::string& more) {
    return "[STANDARD_DATA 0]\r\nSTD_NAME=a\r\nSTD_REFLPOINTS=3,\r\nSTD_REFLINTERVAL=10,\r\nSTD_REFLLOW=400,\r\n" +
           more;
}

TEST(QtxStatements, PointsViewingAndMissingReadingsAreHeeded) {
    const Spectrum spectrum =
        only(qtx("STD_R= 10.0, 25.0, ,\r\nSTD_VIEWING=Specular Excluded\r\n") + "[BATCH_DATA 0]\n");
    EXPECT_EQ(spectrum.wavelength_nm, (Numbers{400, 410}));
    EXPECT_EQ(spectrum.value, (Numbers{0.1, 0.25}));
    EXPECT_EQ(spectrum.missing_nm.size(), 1U);
    EXPECT_EQ(spectrum.geometry.specular, Specular::excluded);
    EXPECT_TRUE(contains_text(refusal(qtx("STD_R=1,2\n")), "f:6: holds 2 readings (REFLPOINTS promises 3)"));
    EXPECT_EQ(only(qtx("STD_R=10,-9999,30\n")).value, (Numbers{0.1, 0.3}));
    EXPECT_TRUE(contains_text(refusal(qtx("STD_SPECTYPE=K/S\nSTD_R=10,20,30\n")), "SPECTYPE is \"K/S\""));
    EXPECT_TRUE(doubtful_file(only(qtx("STD_SCALE=10000\nSTD_R=10,20,30\n"))));
    EXPECT_TRUE(doubtful_file(only(qtx("STD_R=0.1,0.2,0.3\n")))) << "hardly percent";
    EXPECT_TRUE(contains_text(refusal(qtx("STD_R=1,x,2\n")), "holds \"x\" among its readings"));
    const Spectrum other = only("[BATCH_DATA 0]\nBAT_R=1,2\n" + qtx("STD_R=10,20,30\n"));
    EXPECT_EQ(other.value, (Numbers{0.1, 0.2, 0.3}));
    EXPECT_TRUE(contains_text(as_read(other)->message, "REFLLOW is \"\""));
    EXPECT_TRUE(contains_text(refusal("[STANDARD_DATA 0]\nSTD_NAME=a\n"), "holds no spectra"));
}

TEST(QtxStatements, ABracketIsNoProofOfJson) {
    EXPECT_EQ(parse_spectra("[Measurement]\nnm,R\n400,0.1\n410,0.2\n", "f").format, "columns");
    EXPECT_EQ(parse_spectra(R"([{"start": 400, "step": 10, "values": [0.1, 0.2]}])", "f").format, "json");
}

}  // namespace
}  // namespace skinfit
