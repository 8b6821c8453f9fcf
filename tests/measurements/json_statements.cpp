#include <gtest/gtest.h>

#include <cmath>

#include "measurements/quality_checks.hpp"
#include "measurements/spectrum_file.hpp"
#include "tests/support/refusal.hpp"

/// What JSON states of its spectra, under whatever name and in whatever place.
namespace skinfit {
namespace {

using Numbers = std::vector<double>;

const std::string list = R"("start": 400, "step": 10, "values": [0.1, 0.2, 0.3])";

std::vector<Spectrum> read(const std::string& text) {
    return parse_spectra(text, "a.json").spectra;
}

/// Of one spectrum that says this too.
Spectrum with(const std::string& more) {
    return read("{" + list + ", " + more + "}").front();
}

/// Of a list of one spectrum, beside which this stands.
Spectrum beside(const std::string& more) {
    return read("{" + more + R"(, "spectra": [{)" + list + "}]}").front();
}

std::string refusal(const std::string& more) {
    const std::string alone = test::refusal_of([&] { (void)with(more); });
    const std::string as_list = test::refusal_of([&] { (void)beside(more); });
    return alone.empty() || as_list.empty() ? "" : alone;
}

TEST(JsonStatements, OfOtherQuantitiesAreRefusedInAnyPlace) {
    for (const std::string more :
         {R"("quantity": "absorbance")", R"("metadata": {"quantity": "absorbance"})", R"("y": {"unit": "absorbance"})",
          R"("metadata": {"yunits": "Absorbance"})", R"("notes": [["quantity", "absorbance"]])",
          R"j("yunits": "log(1/R)")j", R"("units": "absorbance")"}) {
        EXPECT_NE(refusal(more), "") << more;
    }
    EXPECT_NE(test::refusal_of([&] { (void)with(R"("name": "absorbance of forearm")"); }), "");
    const std::vector<Spectrum> others =
        read("[{" + list + R"(, "name": "a"}, {)" + list + R"(, "quantity": "absorbance"}])");
    ASSERT_EQ(others.size(), 1U);
    EXPECT_TRUE(as_read(others.front()));
}

TEST(JsonStatements, BesideTheListOrInsideObjectsHoldForEachSpectrum) {
    EXPECT_EQ(beside(R"("unit": "percent")").value, (Numbers{0.1 / 100, 0.2 / 100, 0.3 / 100}));
    EXPECT_EQ(with(R"("unit": "%")").value.front(), 0.1 / 100);
    for (const std::string more : {R"("specular": "excluded")", R"("specular": "SCE")", R"("notes": [["mode", "SCE"]])",
                                   R"("geometry": {"specular": "excluded"})"}) {
        EXPECT_EQ(with(more).geometry.specular, Specular::excluded) << more;
        EXPECT_EQ(beside(more).geometry.specular, Specular::excluded) << more;
    }
    EXPECT_EQ(with(R"("name": "forearm SCE")").geometry.specular, Specular::excluded);
    EXPECT_EQ(with(R"("name": "transmittance of ear")").quantity, Quantity::transmittance);
    EXPECT_EQ(with(R"("aperture": {"unit": "mm", "size": 8})").value.front(), 0.1) << "no unit of the values";
    EXPECT_EQ(read(R"({"wavelength_nm": [400, 410], "specular": "excluded",
                       "spectra": [{"values": [0.1, 0.2], "specular": "included"}]})")
                  .front()
                  .geometry.specular,
              Specular::included);
}

TEST(JsonStatements, OfTheAbscissaConvertIt) {
    for (const std::string axis :
         {R"("frequency_thz": [600, 500, 400])", R"("x": {"unit": "THz"}, "start": 600, "step": -100)",
          R"("start_unit": "THz", "start": 600, "step": -100)",
          R"("wavelength_nm": [600, 500, 400], "xunits": "THz")"}) {
        const Spectrum spectrum = read("{" + axis + R"(, "values": [0.1, 0.2, 0.3]})").front();
        EXPECT_DOUBLE_EQ(spectrum.wavelength_nm.back(), 299792.458 / 400) << axis;
        EXPECT_EQ(spectrum.value, (Numbers{0.1, 0.2, 0.3})) << axis;
    }
    EXPECT_EQ(read(R"({"wavelengths": [400, 410], "reflectance": [0.1, 0.2]})").front().value, (Numbers{0.1, 0.2}));
    EXPECT_NE(test::refusal_of([&] { (void)with(R"("wavelength_nm": [410, 420, 430])"); }), "") << "start says 400";
}

TEST(JsonStatements, UncertaintiesRepeatsFactorsAndFillNumbersAreHeeded) {
    for (const std::string name : {"sd", "se", "std", "stderr", "u", "uncertainty", "error"}) {
        EXPECT_EQ(with("\"" + name + R"(": [0.01, 0.02, 0.03])").sigma, (Numbers{0.01, 0.02, 0.03})) << name;
    }
    EXPECT_EQ(with(R"("sigma": 0.01)").sigma, (Numbers{0.01, 0.01, 0.01}));
    EXPECT_TRUE(with(R"("expanded_uncertainty": [0.01, 0.02, 0.03])").sigma.empty());
    const Spectrum spectrum = with(R"("fill_value": 0.2, "multiplier": 0.5, "repeats": [[0.1, 0.2, -9999]])");
    EXPECT_EQ(spectrum.value, (Numbers{0.05, 0.15}));
    ASSERT_EQ(spectrum.repeats.size(), 1U);
    EXPECT_EQ(spectrum.repeats.front().front(), 0.05);
    EXPECT_TRUE(std::isnan(spectrum.repeats.front().back()));
    const std::vector<Spectrum> scaled = read(
        R"([{"start": 400, "step": 10, "values": [10, 20], "multiplier": 0.01}, {"start": 400, "step": 10, "values": [1, 2],
            "multiplier": 0.01}])");
    EXPECT_EQ(scaled[0].value, (Numbers{0.1, 0.2})) << "the unit is that of the values after multiplication";
    EXPECT_EQ(scaled[1].value, (Numbers{0.01, 0.02}));
}

TEST(JsonStatements, OfExtentsThatContradictTheListAreDoubts) {
    for (const std::string more : {R"("npoints": 61)", R"("end": 800)", R"("lastx": 800)", R"("count": 4)"}) {
        EXPECT_TRUE(doubtful_file(with(more))) << more;
    }
    for (const std::string more : {R"("npoints": 3)", R"("end": 420)", R"("stop": 430)", R"("count": 3)"}) {
        EXPECT_FALSE(doubtful_file(with(more))) << more;
    }
}

}  // namespace
}  // namespace skinfit
