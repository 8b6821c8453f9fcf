#include "measurements/spectrum_file.hpp"

#include <gtest/gtest.h>

#include "core/input_error.hpp"

namespace skinfit {
namespace {

using Numbers = std::vector<double>;

TEST(SpectrumFile, HoldsEveryColumnOfValuesWithItsOwnUncertainty) {
    const SpectrumFile file = parse_spectra(
        "# specimen: arm\n# site: inside\nnm,left,right,left_sigma,remark\n410,0.2,,0.02,\n400,0.1,0.3,0.01,wet\n",
        "a");
    EXPECT_EQ(file.source, "a");
    EXPECT_EQ(file.format, "columns");
    ASSERT_EQ(file.spectra.size(), 2U) << "a column of words is no spectrum";
    const Spectrum& left = file.spectra[0];
    EXPECT_EQ(left.name, "left");
    EXPECT_EQ(left.site, "inside");
    EXPECT_EQ(left.wavelength_nm, (Numbers{400, 410}));
    EXPECT_EQ(left.value, (Numbers{0.1, 0.2}));
    EXPECT_EQ(left.sigma, (Numbers{0.01, 0.02}));
    EXPECT_EQ(left.sigma_source, "given by the file");
    EXPECT_EQ(left.missing_nm.size(), 0U);
    EXPECT_EQ(left.line, 3U);
    const Spectrum& right = file.spectra[1];
    EXPECT_EQ(right.name, "right");
    EXPECT_EQ(right.wavelength_nm, Numbers{400});
    EXPECT_EQ(right.value, Numbers{0.3});
    EXPECT_TRUE(right.sigma.empty());
    EXPECT_EQ(right.missing_nm.size(), 1U);
}

TEST(SpectrumFile, HoldsValuesThatNoSpectrumHas) {
    const SpectrumFile file = parse_spectra("# unit: fraction\n400,-1,0.5\n410,1e9,0.6\n", "a");
    ASSERT_EQ(file.spectra.size(), 2U);
    EXPECT_EQ(file.spectra[0].value, (Numbers{-1, 1e9}));
}

TEST(SpectrumFile, OneColumnMayBeChosen) {
    const SpectrumFile file = parse_spectra("nm,a,b\n400,x1,0.5\n410,0.1,0.6\n", "a", {.column = "b"});
    ASSERT_EQ(file.spectra.size(), 1U);
    EXPECT_EQ(file.spectra[0].name, "b");
}

TEST(SpectrumFile, TheBandpassIsShapeAndWidth) {
    const Spectrum spectrum =
        parse_spectra("# bandpass_shape: gaussian\n# bandpass_width_nm: 8.5\n# aperture_mm: 3\n400,0.5\n", "a")
            .spectra.front();
    ASSERT_TRUE(spectrum.bandpass.has_value());
    EXPECT_EQ(spectrum.bandpass->shape, BandpassShape::gaussian);
    EXPECT_EQ(spectrum.bandpass->width_nm, 8.5);
    EXPECT_EQ(spectrum.aperture_mm, 3.0);
    EXPECT_THROW((void)parse_spectra("# bandpass_shape: gaussian\n400,0.5\n", "a"), InputError);
}

}  // namespace
}  // namespace skinfit
