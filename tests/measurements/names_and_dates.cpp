#include <gtest/gtest.h>

#include "measurements/spectrum_file.hpp"

/// What looks like a statement and may be the name of a person, a site, a visit or an instrument, or a date.
namespace skinfit {
namespace {

using Numbers = std::vector<double>;

const std::string rows = "400,0.1\n410,0.2\n420,0.3\n";

std::vector<Spectrum> read(const std::string& text) {
    return parse_spectra(text, "a.csv").spectra;
}

TEST(NamesAndDates, StateNothing) {
    for (const std::string name : {"20/10/2026", "1/10", "baseline", "w/ makeup", "forearm w/moisturizer", "LN",
                                   "Subject x10", "high intensity site", "Lambda 950", "Waveguide probe", "a"}) {
        EXPECT_EQ(read("wavelength," + name + ",other\n" + "400,0.1,0.2\n410,0.1,0.2\n").size(), 2U) << name;
        EXPECT_EQ(read("id,400,410,420\n" + name + ",0.1,0.2,0.3\nother,0.1,0.2,0.3\n").size(), 2U) << name;
    }
    for (const std::string line :
         {"# 05/10/2026", "10/10/2026", "Measurement: 05/10/2026", "# baseline", "Mode: baseline", "# scope test",
          "# skin w/ makeup", "# offset: yes", "# scale: no", "Lamp: Fluorescence", "Eye: OD",
          "Purpose: absorption of bilirubin", "Spectralon: 100 % reflectance",
          "# absorption by haemoglobin is seen at 542 and 577 nm", "# aperture 3 mm"}) {
        const Spectrum spectrum = read(line + "\nwavelength,arm\n" + rows).front();
        EXPECT_EQ(spectrum.value, (Numbers{0.1, 0.2, 0.3})) << line;
        EXPECT_EQ(spectrum.wavelength_nm, (Numbers{400, 410, 420})) << line;
    }
    for (const std::string label : {"treatment,raw,cooked", "eye,OD,OS", "visit,baseline,week 4"}) {
        const std::size_t first = label.find(',');
        const std::size_t second = label.find(',', first + 1);
        EXPECT_EQ(
            read("id," + label.substr(0, first) + ",400,410,420\nx," + label.substr(first + 1, second - first - 1) +
                 ",0.1,0.2,0.3\ny," + label.substr(second + 1) + ",0.1,0.2,0.3\n")
                .size(),
            2U)
            << label;
    }
}

TEST(NamesAndDates, StateNoSpecularState) {
    for (const std::string name : {"specimen 3 (excluded)", "muestra de 8", "3/0/45", "sex", "Sci. Rep."}) {
        EXPECT_EQ(read("nm," + name + "\n400,0.1\n410,0.2\n").front().geometry.specular, std::nullopt) << name;
    }
}

}  // namespace
}  // namespace skinfit
