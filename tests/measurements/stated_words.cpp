#include <gtest/gtest.h>

#include <algorithm>

#include "measurements/spectrum_file.hpp"
#include "tests/support/refusal.hpp"

/// The same facts in other words and other places than in the files of `cases`.
namespace skinfit {
namespace {

using Numbers = std::vector<double>;

const std::string rows = "400,0.1\n410,0.2\n420,0.3\n";

std::vector<Spectrum> read(const std::string& text) {
    return parse_spectra(text, "a.csv").spectra;
}

std::string refusal(const std::string& text) {
    return test::refusal_of([&] { (void)read(text); });
}

TEST(StatedWords, OfOtherQuantitiesAreRefusedWhereverTheyStand) {
    for (const std::string name : {"Absorbance",
                                   "Abs",
                                   "A",
                                   "OD",
                                   "optical density",
                                   "log(1/R)",
                                   "log 1/R",
                                   "-log10(R)",
                                   "K/S",
                                   "Kubelka-Munk",
                                   "counts",
                                   "Reflectance [counts]",
                                   "DN",
                                   "raw",
                                   "Raw DN",
                                   "Radiance (W/m2/sr/nm)",
                                   "irradiance",
                                   "Emission",
                                   "Fluorescence",
                                   "Intensity (a.u.)",
                                   "reflectance x10000",
                                   "R*10^4",
                                   "1st derivative of reflectance",
                                   "AU",
                                   "O.D.",
                                   "lg(1/R)",
                                   "-lgR",
                                   "K-M",
                                   "Colour strength",
                                   "Reflectance (dB)",
                                   "cps",
                                   "Int.",
                                   "Power (mW)",
                                   "Photon flux",
                                   "BRDF (1/sr)"}) {
        EXPECT_NE(refusal("wavelength (nm),\"" + name + "\"\n" + rows).find(name), std::string::npos) << name;
    }
    for (const std::string line : {"YUNITS\tABSORBANCE",
                                   "Y Units: Absorbance",
                                   "Mode=Absorbance",
                                   "Technique,Raman",
                                   "# Type: counts",
                                   "# y axis: log(1/R)",
                                   "Absorbance",
                                   "# Optical density",
                                   "Measurement: IRRADIANCE",
                                   "\"Photometric mode: Abs.\"",
                                   "Mode/Unit-->,Irradiance[uW/cm2]",
                                   "Scan mode: Absorbance",
                                   "Title: Absorbance spectrum of forearm",
                                   "# y: absorbance",
                                   "Parameter: A",
                                   "# data: Kubelka-Munk",
                                   "Data: Raw counts",
                                   "Display: Log(1/R)",
                                   "Spectrum file is raw data",
                                   "Spectrum file is radiance data",
                                   "# values are absorbance",
                                   "# quantity = absorbance",
                                   "# units are digital numbers",

                                   "# Spectra of skin as absorbance, log10(1/R), measured by me in May"}) {
        EXPECT_NE(refusal(line + "\nwavelength,arm\n" + rows), "") << line;
        EXPECT_NE(refusal(line + "\n" + rows), "") << line;
    }
    for (const std::string label : {"Mode,Absorbance", "Quantity,K/S", "Measurement type,counts", "Tag,Absorbance",
                                    "spectrum,log(1/R)", "channel,K/S", "Signal,Raw counts", "kind,Absorbance (AU)"}) {
        const std::size_t comma = label.find(',');
        const std::string text =
            "id," + label.substr(0, comma) + ",400,410,420\n1," + label.substr(comma + 1) + ",1,2,3\n";
        EXPECT_NE(refusal(text), "") << label;
    }
    EXPECT_NE(refusal(R"({"yunits": "ABSORBANCE", "start": 400, "step": 10, "values": [0.1, 0.2]})"), "");
    EXPECT_NE(refusal("id,A400,A410,A420\n1,0.1,0.2,0.3\n"), "");
    EXPECT_NE(refusal("Absorbance,400,410,420\nx,0.1,0.2,0.3\n"), "");
    EXPECT_NE(refusal("Absorbance, forearm\nnm,a\n" + rows), "");
    const std::vector<Spectrum> other = read(",Absorbance,Reflectance\nnm,a,b\n400,0.1,0.2\n410,0.1,0.2\n");
    ASSERT_EQ(other.size(), 1U);
    EXPECT_EQ(other.front().value, (Numbers{0.2, 0.2})) << "of some columns";
}

TEST(StatedWords, OfReflectanceAndTransmittanceAreHeeded) {
    const auto quantity = [](const std::string& text) { return read(text).front().quantity; };
    for (const std::string name : {"R", "%R", "Reflect. [1.0]", "reflectivity", "forearm %R", "Refl (%)", "R (%)"}) {
        EXPECT_EQ(quantity("nm,\"" + name + "\"\n" + rows), Quantity::reflectance) << name;
    }
    for (const std::string name : {"T", "%T", "Transmission", "trans", "T (%)", "100%T"}) {
        EXPECT_EQ(quantity("nm,\"" + name + "\"\n" + rows), Quantity::transmittance) << name;
    }
    EXPECT_EQ(quantity("YUNITS\tTRANSMITTANCE\n" + rows), Quantity::transmittance);
    for (const std::string line : {"Transmittance", "Transmission spectrum", "Method: Transmittance",
                                   "# total transmittance of ear lobe, integrating sphere"}) {
        EXPECT_EQ(quantity(line + "\nx,y\n" + rows), Quantity::transmittance) << line;
    }
    for (const std::string line :
         {"Reflectance (%)", "Reflectance in percent", "# values in percent", "# x in nm, y in %"}) {
        EXPECT_DOUBLE_EQ(read(line + "\nx,y\n" + rows).front().value.front(), 0.001) << line;
    }
    EXPECT_EQ(quantity("Title: Absorbance test\nMode: %R\nx,y\n" + rows), Quantity::reflectance)
        << "the ordinate's key";
    EXPECT_EQ(quantity("Data is compared to a white reference\nSpectrum file is raw data\nx,y\n" + rows), std::nullopt);
    EXPECT_EQ(quantity("PE UV  SPECTRUM\nforearm.sp\n#GR\nnm\n%T\n1.0\n#DATA\n400 10\n410 20\n"),
              Quantity::transmittance);
    EXPECT_NE(refusal("PE UV  SPECTRUM\nforearm.sp\n#GR\nnm\nA\n1.0\n#DATA\n400 0.1\n410 0.2\n"), "");
    EXPECT_EQ(quantity("nm,L,T\n400,0.1,0.2\n"), std::nullopt) << "letters beside other letters are names";
    EXPECT_EQ(quantity("id,T_400nm,T_410nm,T_420nm\n1,0.1,0.2,0.3\n"), Quantity::transmittance);
    EXPECT_TRUE(read("nm,raw arm,white person\n400,0.1,0.2\n").size() == 2) << "names of specimens stay names";
}

TEST(StatedWords, OfTheAbscissaConvertIt) {
    const auto first = [](const std::string& header, const std::string& number) {
        return read(header + ",R\n" + number + ",0.1\n").front().wavelength_nm.front();
    };
    EXPECT_DOUBLE_EQ(first("Wavelength (\xC2\xB5m)", "0.5"), 500);
    EXPECT_DOUBLE_EQ(first("wavelength [\xC3\x85]", "5000"), 500);
    EXPECT_DOUBLE_EQ(first("Angstrom", "5000"), 500);
    EXPECT_DOUBLE_EQ(first("wavelength_m", "5e-7"), 500);
    EXPECT_DOUBLE_EQ(first("X [1/cm]", "20000"), 500);
    EXPECT_DOUBLE_EQ(first("wavenumber", "20000"), 500);
    EXPECT_DOUBLE_EQ(first("Frequency (GHz)", "600000"), 299792.458 / 600);
    EXPECT_NEAR(first("Energy (eV)", "2"), 1239.841984332 / 2, 1e-6);  // h c / e of the SI
    EXPECT_DOUBLE_EQ(read("XUNITS\t1/CM\n20000\t0.1\n25000\t0.2\n").front().wavelength_nm.back(), 500);
    EXPECT_DOUBLE_EQ(read("id,wavenumber,20000,25000,26000\nx,,0.1,0.2,0.3\n").front().wavelength_nm.back(), 500);
    EXPECT_DOUBLE_EQ(first("Wavenumber (m^-1)", "2000000"), 500);
    EXPECT_DOUBLE_EQ(first("Wavenumber (kK)", "20"), 500);
    EXPECT_DOUBLE_EQ(first("wavelength [\xC5]", "5000"), 500) << "in Latin-1";
    EXPECT_DOUBLE_EQ(first("lambda a", "500"), 500) << "of scan a";
    for (const std::string line :
         {"# frequency in THz", "Frequency (THz)", "# THz", "# x in THz, y as fraction", "Units: THz",
          "Spectral axis: frequency (THz)", "Domain: THz", "XAxis mode: Frequency THz"}) {
        EXPECT_DOUBLE_EQ(read(line + "\nx,y\n500,0.1\n600,0.2\n").front().wavelength_nm.back(), 299792.458 / 500)
            << line;
        EXPECT_DOUBLE_EQ(read(line + "\nid,500,600,700\nx,0.1,0.2,0.3\n").front().wavelength_nm.back(),
                         299792.458 / 500)
            << line;
    }
    EXPECT_DOUBLE_EQ(read("sample \\ THz,500,600,700\nx,0.1,0.2,0.3\n").front().wavelength_nm.back(), 299792.458 / 500);
    EXPECT_DOUBLE_EQ(
        read("XAxis mode: Wavenumbers\n>>>Begin<<<\n20000\t0.1\n25000\t0.2\n").front().wavelength_nm.back(), 500);
    EXPECT_NE(refusal("XAxis mode: Raman Shifts\n>>>Begin<<<\n400\t0.1\n500\t0.2\n"), "");
    for (const std::string name : {"Raman shift (cm-1)", "pixel", "Frequency", "Energy", "Raman shift", "Depth (um)",
                                   "Temperature (K)", "E (kJ/mol)"}) {
        EXPECT_NE(refusal("\"" + name + "\",R\n400,0.1\n500,0.2\n"), "") << name;
    }
    EXPECT_NE(refusal("XUNITS: 1/CM\nWavelength (nm),R\n400,0.1\n"), "") << "they contradict each other";
}

TEST(StatedWords, FindTheWavelengthsBehindOtherColumns) {
    for (const std::string front : {"", "Unnamed: 0", "index", "id", "sample", "#", "No."}) {
        const std::vector<Spectrum> found = read(front + ",Wavelength,R\n1,400,0.1\n2,410,0.2\n");
        ASSERT_EQ(found.size(), 1U) << front;
        EXPECT_EQ(found.front().wavelength_nm, (Numbers{400, 410})) << front;
        EXPECT_EQ(found.front().value, (Numbers{0.1, 0.2})) << front;
        EXPECT_FALSE(found.front().remarks.empty()) << front;
    }
    const std::vector<Spectrum> swapped = read("reflectance,wavelength_nm\n0.1,400\n0.2,410\n");
    EXPECT_EQ(swapped.front().wavelength_nm, (Numbers{400, 410}));
    EXPECT_EQ(swapped.front().value, (Numbers{0.1, 0.2}));
    EXPECT_EQ(read("wavenumber (1/cm),wavelength (nm),R\n25000,400,0.1\n20000,500,0.2\n").front().wavelength_nm,
              (Numbers{400, 500}));
    EXPECT_EQ(read("wavelength,pixel,R\n400,1,0.1\n410,2,0.2\n").size(), 1U);
}

TEST(StatedWords, PairColumnsOfDifferentLengths) {
    const std::vector<Spectrum> pairs = read("nm,a,nm,b\n400,0.1,500,0.4\n410,0.2,510,0.5\n,,520,0.6\n");
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[0].wavelength_nm, (Numbers{400, 410}));
    EXPECT_EQ(pairs[1].wavelength_nm, (Numbers{500, 510, 520}));
    EXPECT_EQ(pairs[1].value, (Numbers{0.4, 0.5, 0.6}));
    EXPECT_NE(refusal("nm,a,nm,b\n400,0.1,500,0.4\n,0.2,510,0.5\n").find("no wavelength"), std::string::npos);
}

TEST(StatedWords, OfSpecularAreHeededInAnyPlace) {
    const auto specular = [](const std::string& text) { return read(text).back().geometry.specular; };
    EXPECT_EQ(specular("nm,arm_SCI,arm_SCE\n400,0.1,0.2\n"), Specular::excluded);
    EXPECT_EQ(specular("Mode: SCI\nnm,R\n400,0.1\n"), Specular::included);
    EXPECT_EQ(specular("# specular component excluded\nnm,R\n400,0.1\n"), Specular::excluded);
    EXPECT_EQ(specular("Specular component\tincluded\nnm\tR\n400\t0.1\n"), Specular::included);
    EXPECT_EQ(specular("id,SCI/SCE,400,410,420\nx,SCE,0.1,0.2,0.3\n"), Specular::excluded);
    EXPECT_EQ(specular("id,Specular,400,410,420\nx,excl.,0.1,0.2,0.3\n"), Specular::excluded);
    EXPECT_EQ(specular("id,400,410,420\narm (SCE),0.1,0.2,0.3\n"), Specular::excluded);
    EXPECT_EQ(specular("id,Port,400,410,420\nx,SPEX,0.1,0.2,0.3\n"), Specular::excluded);
    for (const std::string name : {"forearmSCE", "RSEX", "de:8", "spec. excl.", "45/0", "Sce"}) {
        EXPECT_EQ(specular("nm," + name + "\n400,0.1\n"), Specular::excluded) << name;
    }
    EXPECT_EQ(specular("# Specular component excluded, d/8\nnm,R\n400,0.1\n"), Specular::excluded);
    EXPECT_EQ(specular("Mode,SCE,,\nnm,R,b\n400,0.1,0.2\n410,0.1,0.2\n"), Specular::excluded);
    EXPECT_EQ(specular("Geometry: d/8, SCE, 8 mm\nnm,R\n400,0.1\n410,0.1\n"), Specular::excluded);
    EXPECT_EQ(specular("Geometry: 45\xC2\xB0/0\xC2\xB0\nnm,R\n400,0.1\n410,0.1\n"), Specular::excluded);
    EXPECT_EQ(specular("id,Specular,400,410,420\nx,E,0.1,0.2,0.3\n"), Specular::excluded);
    EXPECT_EQ(specular("id,SEX,400,410,420\nx,1,0.1,0.2,0.3\n"), std::nullopt);
    EXPECT_EQ(specular("# 10:45:00 of 3/0/45\nnm,R\n400,0.1\n"), std::nullopt);
    EXPECT_EQ(specular("id,Sex,400,410,420\nx,F,0.1,0.2,0.3\n"), std::nullopt);
    EXPECT_EQ(specular("# Sci. Rep. 12\nnm,R\n400,0.1\n"), std::nullopt);
}

TEST(StatedWords, OfUncertaintiesGiveThemToTheirColumn) {
    for (const std::string name : {"R_sd", "R_std", "sd", "SE", "stderr", "R stderr", "u(R)", "u", "R_u", "std. dev.",
                                   "SD of R", "error", "R_err", "uncertainty", "sem", "R_sigma (fraction)"}) {
        const std::vector<Spectrum> found = read("nm,R," + name + "\n400,0.1,0.01\n410,0.2,0.02\n");
        ASSERT_EQ(found.size(), 1U) << name;
        EXPECT_EQ(found.front().sigma, (Numbers{0.01, 0.02})) << name;
    }
    const std::vector<Spectrum> each = read("nm,a,sd,b,sd\n400,0.1,0.01,0.2,0.02\n");
    EXPECT_EQ(each[0].sigma, Numbers{0.01});
    EXPECT_EQ(each[1].sigma, Numbers{0.02});
    EXPECT_EQ(read("nm,R,R_sd,R_se\n400,0.1,0.02,0.01\n").front().sigma, Numbers{0.01}) << "of the mean, where stated";
    EXPECT_TRUE(read("nm,R,U(R)\n400,0.1,0.02\n").front().sigma.empty()) << "expanded";
    EXPECT_TRUE(read("nm,R,R_se\n400,0.1,0\n410,0.2,0\n").front().sigma.empty()) << "0 throughout";
}

TEST(StatedWords, OfMissingValuesInEverySpelling) {
    for (const std::string cell :
         {"1.#QNAN",  "-1.#IND",      "1.#INF", "-1.#IND00", "#N/A",     "#DIV/0!",    "#VALUE!", "NaN",
          "NA",       "null",         "-",      "--",        "-9999",    "-999",       "-999.0",  "1e34",
          "-1.23e34", "9.96921e36",   "inf",    "n/a",       "nan(ind)", "-nan(snan)", "NaNQ",    "n.d.",
          "ND",       "\xE2\x80\x93", "?",      "OVER",      "-999.25",  "-888",       "65535",   "-1e10"}) {
        const Spectrum comma = read("nm,R\n400,0.1\n410," + cell + "\n420,0.3\n").front();
        EXPECT_EQ(comma.value, (Numbers{0.1, 0.3})) << cell;
        EXPECT_EQ(comma.missing_nm.size(), 1U) << cell;
        EXPECT_EQ(read("nm R\n400 0.1\n410 " + cell + "\n420 0.3\n").front().missing_nm.size(), 1U) << cell;
        EXPECT_EQ(read("id,400,410,420\nx,0.1," + cell + ",0.3\n").front().missing_nm.size(), 1U) << cell;
    }
    EXPECT_EQ(read(R"({"start": 400, "step": 10, "values": [0.1, -9999, 0.3]})").front().missing_nm.size(), 1U);
}

TEST(StatedWords, OfScalesAreAppliedOrRefused) {
    EXPECT_EQ(read("# multiplier: 0.5\nnm,R\n400,0.5\n").front().value, Numbers{0.25});
    EXPECT_EQ(read("divisor=2\nnm,R\n400,0.5\n").front().value, Numbers{0.25});
    EXPECT_EQ(read("# scale factor: 1\nnm,R\n400,0.5\n").front().value, Numbers{0.5});
    for (const std::string line : {"# scale_factor: 10000", "scale factor = 0.0001", "# gain: 1.05", "# offset: -0.05",
                                   "# factor: 0.5", "# scale 0.5"}) {
        EXPECT_NE(refusal(line + "\nnm,R\n400,0.5\n"), "") << line;
    }
    for (const std::string line : {"# calibration factor: 2", "Normalization factor: 0.5", "# slope: 2, intercept: 0.1",
                                   "# reflectance scaled by 2"}) {
        const Spectrum spectrum = read(line + "\nnm,R\n400,0.5\n410,0.5\n").front();
        EXPECT_EQ(spectrum.value.front(), 0.5) << line;
        EXPECT_FALSE(spectrum.remarks.empty()) << line;
    }
}

TEST(StatedWords, OfExtentsAreHeldAgainstTheTable) {
    EXPECT_EQ(refusal("NPOINTS,3\nFIRSTX,400\nLASTX,420.0\nFIRSTY,0.1\nMAXY,0.30\n" + rows), "");
    EXPECT_EQ(read("MAXY: 0.003\nYFACTOR: 0.01\nnm,R\n" + rows).front().value.size(), 3U) << "with the factor";
    EXPECT_EQ(refusal("Number of points,\"1,003\"\n" + rows), "") << "a separator of thousands is not understood";
    for (const std::string line :
         {"NPOINTS,4", "FIRSTX,390", "LASTX,430", "FIRSTY,0.2", "MAXY,0.4", "Number of Pixels in Processed Spectrum: 2",
          "Number of Pixels in Spectrum: 2", "Number of wavelengths: 5"}) {
        EXPECT_NE(refusal(line + "\nnm,R\n" + rows), "") << line;
    }
}

TEST(StatedWords, OfALogBelowTheTableAreNoReadings) {
    EXPECT_EQ(read("nm,R\n" + rows + "\nInstrument Cary 5000\nScan rate 600.0\n").front().value.size(), 3U);
    EXPECT_EQ(read("nm\tR\n400\t0.1\n410\t0.2\nCCT\t5465\nDuv\t0.004\n").front().value.size(), 2U);
    EXPECT_EQ(read("nm,R\n" + rows + "END\n").front().value.size(), 3U);
    EXPECT_NE(refusal("nm,R\n" + rows + "\nO430,0.4\n"), "") << "a slip in a reading is none";
    EXPECT_NE(refusal("nm,R\n" + rows + "stop\n430,0.4\n"), "") << "readings follow";
    EXPECT_NE(refusal("Absorbance\n\nnm,R2\n" + rows), "");
}

}  // namespace
}  // namespace skinfit
