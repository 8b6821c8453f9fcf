#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "measurements/spectrum_file.hpp"
#include "tests/support/refusal.hpp"

/// Which cells of a table are spectra, their uncertainties, their wavelengths, or something else.
namespace skinfit {
namespace {

using Numbers = std::vector<double>;

std::vector<Spectrum> spectra_in(const std::string& text, const ReadOptions& options = {}) {
    return parse_spectra(text, "table.csv", options).spectra;
}

std::vector<std::string> names_in(const std::string& text) {
    std::vector<std::string> names;
    for (const Spectrum& spectrum : spectra_in(text)) names.push_back(spectrum.name);
    return names;
}

Spectrum only_in(const std::string& text, const ReadOptions& options = {}) {
    const std::vector<Spectrum> spectra = spectra_in(text, options);
    EXPECT_EQ(spectra.size(), 1U) << text;
    return spectra.front();
}

std::string refusal_of(const std::string& text) {
    return test::refusal_of([&] { (void)spectra_in(text); });
}

bool is_told(const Spectrum& spectrum, std::string_view words) {
    return std::ranges::any_of(spectrum.remarks,
                               [&](const std::string& remark) { return remark.find(words) != std::string::npos; });
}

using Names = std::vector<std::string>;

TEST(TableFactor, IsAppliedBeforeTheUnitIsFound) {
    for (const std::string text : {"# multiplier: 0.01\nwavelength,a,b\n400,8,9\n410,10,11\n",
                                   "# multiplier: 0.01\nid,400,410,420\na,8,10,11\nb,9,11,12\n"}) {
        const std::vector<Spectrum> spectra = spectra_in(text);
        ASSERT_EQ(spectra.size(), 2U) << text;
        EXPECT_DOUBLE_EQ(spectra[0].value[0], 0.08) << text;
        EXPECT_DOUBLE_EQ(spectra[1].value[1], 0.11) << text;
    }
}

TEST(TableUnit, IsNotThatOfOtherColumns) {
    for (const std::string header : {"wavelength,R,n", "wavelength,R,FWHM (nm)", "wavelength,R,Temperature (C)"}) {
        EXPECT_EQ(only_in(header + "\n400,0.08,5\n410,0.1,5\n").value, (Numbers{0.08, 0.1})) << header;
    }
    EXPECT_EQ(spectra_in("wavelength,R,other\n400,0.08,50\n410,0.1,50\n")[0].value, (Numbers{0.08, 0.1}));
}

TEST(TableUncertainty, IsUsedUnderTheNamesOfManyPrograms) {
    for (const std::string name : {"sigmaR", "stdR", "uR", "dR", "+/- R", "Standardabweichung", "ecart-type"}) {
        const Spectrum spectrum = only_in("wavelength,R," + name + "\n400,0.08,0.02\n410,0.1,0.02\n");
        EXPECT_EQ(spectrum.sigma, (Numbers{0.02, 0.02})) << name;
    }
}

TEST(TableUncertainty, IsLeftOutWhereItIsNotStandard) {
    for (const std::string name :
         {"U (k=2)", "Uncertainty (k=2)", "2 sigma", "2*SD", "R_2sigma", "95% CI", "CI95", "R_var"}) {
        const Spectrum spectrum = only_in("wavelength,R," + name + "\n400,0.08,0.02\n410,0.1,0.02\n");
        EXPECT_TRUE(spectrum.sigma.empty()) << name;
        EXPECT_TRUE(is_told(spectrum, "no standard uncertainty")) << name;
    }
}

TEST(TableUncertainty, HasItsOwnUnit) {
    const Spectrum mixed = only_in("wavelength,R (%),SD (fraction)\n400,8,0.02\n410,10,0.03\n");
    EXPECT_DOUBLE_EQ(mixed.value[0], 0.08);
    EXPECT_DOUBLE_EQ(mixed.sigma[1], 0.03);
    const Spectrum relative = only_in("wavelength,R,SD (%)\n400,0.08,10\n410,0.1,10\n");
    EXPECT_TRUE(relative.sigma.empty());
    EXPECT_TRUE(is_told(relative, "may be relative"));
}

TEST(TableUncertainty, StandsInRowsAndBlocksToo) {
    for (const std::string text :
         {"id,400,410,420\nforearm,0.08,0.1,0.12\nforearm_sd,0.02,0.02,0.03\n",
          "id,stat,400,410,420\nforearm,mean,0.08,0.1,0.12\nforearm,sd,0.02,0.02,0.03\n",
          "id,400,410,420,sd_400,sd_410,sd_420\nforearm,0.08,0.1,0.12,0.02,0.02,0.03\n",
          "id,R_400,R_410,R_420,R_sd_400,R_sd_410,R_sd_420\nforearm,0.08,0.1,0.12,0.02,0.02,0.03\n"}) {
        const Spectrum spectrum = only_in(text);
        EXPECT_EQ(spectrum.name, "forearm") << text;
        EXPECT_EQ(spectrum.value, (Numbers{0.08, 0.1, 0.12})) << text;
        EXPECT_EQ(spectrum.sigma, (Numbers{0.02, 0.02, 0.03})) << text;
    }
}

TEST(TableHeader, OfSeveralLinesSaysSomethingOfEachColumn) {
    const Spectrum pandas = only_in(",R,R\n,mean,std\nwavelength,,\n400,0.08,0.02\n410,0.1,0.02\n");
    EXPECT_EQ(pandas.sigma, (Numbers{0.02, 0.02}));
    const Spectrum units = only_in("Wavelength\tR\tR_sd\nnm\t\t\n400\t0.08\t0.02\n410\t0.1\t0.02\n");
    EXPECT_EQ(units.sigma, (Numbers{0.02, 0.02}));
    for (const std::string text : {"Quantity,Absorbance,Reflectance\nWavelength,forearm,cheek\n400,1,0.08\n410,1,0.1\n",
                                   "Sample,forearm,cheek\nQuantity,Absorbance,Reflectance\n400,1,0.08\n410,1,0.1\n",
                                   ",Absorbance,Reflectance\nWavelength,forearm,cheek\n400,1,0.08\n410,1,0.1\n"}) {
        const Spectrum cheek = only_in(text);
        EXPECT_EQ(cheek.quantity, Quantity::reflectance) << text;
        EXPECT_EQ(cheek.value, (Numbers{0.08, 0.1})) << text;
    }
    const std::vector<Spectrum> mixed = spectra_in("unit,%,fraction\nWavelength,a,b\n400,8,0.08\n410,10,0.1\n");
    EXPECT_EQ(mixed[0].value, mixed[1].value);
    const std::vector<Spectrum> gloss = spectra_in("Name,a,b\nMode,SCI,SCE\n400,8,4\n410,10,5\n");
    EXPECT_EQ(gloss[0].name, "a");
    EXPECT_EQ(gloss[0].geometry.specular, Specular::included);
    EXPECT_EQ(gloss[1].geometry.specular, Specular::excluded);
    EXPECT_EQ(names_in("Subject,A01,A01,A02\nSite,arm,cheek,arm\nWavelength,R,R,R\n400,.1,.2,.3\n410,.1,.2,.3\n"),
              (Names{"A01 arm", "A01 cheek", "A02 arm"}));
}

TEST(TableColumns, EachHaveTheirOwnWavelengthsBesideThem) {
    for (const std::string header : {"x1,y1,x2,y2\n", "X,Y,X,Y\n"}) {
        const std::vector<Spectrum> spectra =
            spectra_in(header + "400,0.08,405,0.09\n410,0.1,415,0.11\n420,0.1,425,0.1\n");
        ASSERT_EQ(spectra.size(), 2U) << header;
        EXPECT_EQ(spectra[1].wavelength_nm, (Numbers{405, 415, 425})) << header;
    }
    EXPECT_EQ(spectra_in("400\t0.08\t405\t0.09\n410\t0.1\t415\t0.11\n420\t0.1\t425\t0.1\n").size(), 2U);
}

TEST(TableColumns, MayBeCalledByNumbersUnderAnEmptyCorner) {
    EXPECT_EQ(names_in(",401,402,403\n400,0.08,0.07,0.06\n500,0.1,0.09,0.08\n"), (Names{"401", "402", "403"}));
    EXPECT_EQ(names_in(",400,410,420\n401,0.08,0.07,0.06\n402,0.1,0.09,0.08\n"), (Names{"401", "402"}));
}

TEST(TableRows, OfSeveralSpecimensBelowEachOtherAreTheirSpectra) {
    for (const std::string text :
         {"id,wavelength,R\n1,400,0.08\n2,405,0.09\n1,410,0.1\n2,415,0.11\n1,420,0.12\n2,425,0.13\n",
          "site,wavelength,R\n1,400,0.08\n1,410,0.1\n1,420,0.12\n2,405,0.09\n2,415,0.11\n2,425,0.13\n",
          "wavelength,R,subject\n400,0.08,1\n405,0.09,2\n410,0.1,1\n415,0.11,2\n420,0.12,1\n425,0.13,2\n"}) {
        const std::vector<Spectrum> spectra = spectra_in(text);
        ASSERT_EQ(spectra.size(), 2U) << text;
        EXPECT_EQ(spectra[0].name, "1") << text;
        EXPECT_EQ(spectra[0].value, (Numbers{0.08, 0.1, 0.12})) << text;
        EXPECT_EQ(spectra[1].wavelength_nm, (Numbers{405, 415, 425})) << text;
    }
    EXPECT_EQ(names_in("site,wavelength,R\narm,400,.1\narm,410,.1\narm,420,.1\nleg,400,.2\nleg,410,.2\nleg,420,.2\n"),
              (Names{"arm", "leg"}));
    EXPECT_EQ(only_in("site,wavelength,R\narm,400,0.08\narm,410,0.1\n").value, (Numbers{0.08, 0.1}));
}

TEST(TableRows, MayBeginWithTheirNamesAsOfR) {
    EXPECT_EQ(only_in("\"wavelength\" \"R\"\n\"1\" 400 0.08\n\"2\" 410 0.1\n").value, (Numbers{0.08, 0.1}));
    EXPECT_EQ(names_in("\"X400\",\"X410\",\"X420\"\n\"arm\",0.08,0.1,0.1\n\"leg\",0.1,0.1,0.1\n"),
              (Names{"arm", "leg"}));
    EXPECT_EQ(names_in(",id,400,410,420\n0,arm,0.08,0.1,0.1\n1,leg,0.1,0.1,0.1\n"), (Names{"arm", "leg"}));
}

TEST(TableRows, MayHoldSeveralSpectraEach) {
    const std::vector<Spectrum> both = spectra_in("id,R_400,R_410,R_420,T_400,T_410,T_420\na,.1,.2,.3,.01,.02,.03\n");
    ASSERT_EQ(both.size(), 2U);
    EXPECT_EQ(both[0].name, "a R");
    EXPECT_EQ(both[1].quantity, Quantity::transmittance);
    EXPECT_EQ(both[1].value, (Numbers{0.01, 0.02, 0.03}));
    const std::vector<Spectrum> gloss =
        spectra_in("id,SCI_400,SCI_410,SCI_420,SCE_400,SCE_410,SCE_420\na,.1,.2,.3,.05,.15,.25\n");
    ASSERT_EQ(gloss.size(), 2U);
    EXPECT_EQ(gloss[1].geometry.specular, Specular::excluded);
}

TEST(TableRows, HaveOneUnitAndOneDecimalMark) {
    EXPECT_DOUBLE_EQ(only_in("id,400,410,420\nunit,%,%,%\na,1.2,1.3,1.4\n").value[0], 0.012);
    EXPECT_EQ(only_in("id;date;400;410;420\na;01,02;0.08;0.1;0.12\n").value, (Numbers{0.08, 0.1, 0.12}));
    EXPECT_EQ(only_in("id;400,5;410,5;420,5\na;0,08;0,1;0,12\n").wavelength_nm, (Numbers{400.5, 410.5, 420.5}));
}

TEST(TableExtent, IsThatDeclaredAlsoOfSeveralSpectra) {
    EXPECT_NE(refusal_of("NPOINTS: 61\nwavelength,a,b\n400,.1,.1\n410,.1,.1\n").find("NPOINTS is 61"),
              std::string::npos);
    EXPECT_NE(refusal_of("# npoints: 61\nid,400,410,420\na,.1,.1,.1\n").find("npoints is 61"), std::string::npos);
    EXPECT_EQ(spectra_in("NPOINTS: 2\nwavelength,a,b\n400,.1,.1\n410,.1,.1\n").size(), 2U);
}

/// Twenty readings from 400 nm on, every 10 nm.
std::string twenty_readings() {
    std::string text = "wavelength,R\n";
    for (int nm = 400; nm < 600; nm += 10) text += fmt::format("{},0.1\n", nm);
    return text;
}

TEST(TableExtent, IsThatOfWavelengths) {
    for (const std::string more : {"12000,0.1\n", "0,0\n", "-9999,-9999\n", "NA,NA\n"}) {
        EXPECT_EQ(only_in(twenty_readings() + more).wavelength_nm.back(), 590) << more;
    }
    const ReadOptions visible{.window = {.range = {.lowest_nm = 400, .highest_nm = 700}}};
    EXPECT_EQ(only_in(twenty_readings() + "860,OVR\n", visible).value.size(), 20U);
    EXPECT_EQ(only_in("id,400,410,860\na,0.1,0.1,OVR\n", visible).value.size(), 2U);
}

TEST(TableWavelengths, ThatComeTwiceAreNoOverlapOfDetectors) {
    std::string text = twenty_readings() + "590,0.5\n";
    for (int nm = 600; nm < 700; nm += 10) text += fmt::format("{},0.1\n", nm);
    EXPECT_EQ(only_in(text).repeated.size(), 1U);
    std::string shifted = twenty_readings();
    for (int nm = 405; nm < 605; nm += 10) shifted += fmt::format("{},0.2\n", nm);
    EXPECT_NE(refusal_of(shifted).find("a second run of wavelengths begins at 405 nm"), std::string::npos);
}

TEST(TableBands, ThatAreZeroInEverySpectrumAreMissing) {
    for (const std::string text :
         {"wavelength,a,b\n400,0,0\n410,0.1,0.2\n420,0,0.2\n", "id,400,410,420\na,0,0.1,0\nb,0,0.2,0.2\n"}) {
        const std::vector<Spectrum> spectra = spectra_in(text);
        EXPECT_EQ(spectra[0].wavelength_nm, (Numbers{410, 420})) << text;
        EXPECT_EQ(spectra[1].missing_nm, (Numbers{400})) << text;
        EXPECT_TRUE(is_told(spectra[0], "0 in every spectrum")) << text;
    }
}

TEST(TableRefusal, NamesWhatIsWrong) {
    EXPECT_NE(refusal_of("id,x400_5,x410_5,x420_5\na,.1,.1,.1\n").find("every value needs its wavelength"),
              std::string::npos);
    EXPECT_NE(refusal_of("wavelength,R\n400,.1\n410,.1\nwavelength,R\n405,.1\n415,.1\n").find("a second table"),
              std::string::npos);
}

}  // namespace
}  // namespace skinfit
