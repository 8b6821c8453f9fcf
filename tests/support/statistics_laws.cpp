#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/reference_spectrum.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit::test {
namespace {

TEST(Statistics, ChiSquareTailHasItsClosedForms) {
    // Two degrees of freedom: exp(-x / 2). One: that of a squared normal variable.
    for (const double x : {0.1, 1.0, 10.0, 100.0}) {
        EXPECT_NEAR(chi_square_p_value(x, 2) / std::exp(-x / 2), 1.0, 1e-13);
        EXPECT_NEAR(chi_square_p_value(x, 1) / two_sided_p_value(std::sqrt(x)), 1.0, 1e-13);
    }
}

TEST(Statistics, EvenCountsHaveNoEvidenceAgainstThem) {
    EXPECT_EQ(equal_bins_p_value(std::vector<std::uint64_t>{7, 7, 7}), 1.0);
    // Two bins, 60 and 40: chi-square 100 / 50 + 100 / 50 = 4 with one degree of freedom, z = 2.
    EXPECT_NEAR(equal_bins_p_value(std::vector<std::uint64_t>{60, 40}), two_sided_p_value(2.0), 1e-14);
}

TEST(Statistics, TheWorstOfSeveralIsMultipliedByTheirNumber) {
    EXPECT_DOUBLE_EQ(family_wise_p_value(std::vector<double>{0.1, -3.0, 1.0}), 3 * two_sided_p_value(3.0));
    EXPECT_EQ(family_wise_p_value(std::vector<double>{0.0, 0.1}), 1.0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(family_wise_p_value(std::vector<double>{nan, 0.0}), 0.0);
    EXPECT_EQ(family_wise_p_value(std::vector<double>{0.0, nan}), 0.0);
}

TEST(Statistics, ZIsTheDifferenceInStandardErrors) {
    EXPECT_DOUBLE_EQ(z_between(Estimate{2.0, 0.3}, Estimate{1.0, 0.4}), 2.0);
    EXPECT_EQ(z_between(Estimate{1.0, 0.0}, Estimate{1.0, 0.0}), 0.0);
    EXPECT_EQ(two_sided_p_value(z_between(Estimate{1.0, 0.0}, Estimate{2.0, 0.0})), 0.0);
    // Pooled share 1/2, so the standard error is sqrt(1/4 (1/100 + 1/100)).
    EXPECT_DOUBLE_EQ(z_between(Count{60, 100}, Count{40, 100}), 0.2 / std::sqrt(0.005));
    EXPECT_EQ(z_between(Count{0, 100}, Count{0, 200}), 0.0);
    EXPECT_DOUBLE_EQ(share_of(1, 4).standard_error, std::sqrt(3.0) / 8.0);
}

const std::string columns =
    "wavelength_nm,reflectance,reflectance_se,transmittance,transmittance_se,surface_reflectance\n";

TEST(ReferenceSpectrum, HeaderBecomesTheSample) {
    const ReferenceSpectrum spectrum = parse_reference_spectrum(
        "example", "# walk; edition printed; incidence 45 deg; changed from Table 1: sample=1 t_s=0.0017 r=30\n" +
                       columns + "400,0.1,0.002,0.5,0.003,0.05\n");
    EXPECT_EQ(spectrum.sample.edition, Edition::printed);
    EXPECT_EQ(spectrum.sample.layers, 2);
    EXPECT_EQ(spectrum.sample.base, (Base{Base::Kind::index, 1.0}));
    EXPECT_EQ(spectrum.sample.skin.stratum_corneum_thickness_cm, 0.0017);
    EXPECT_EQ(spectrum.sample.skin.fibril_radius_nm, 30.0);
    EXPECT_DOUBLE_EQ(spectrum.incidence_rad, std::numbers::pi / 4);
    ASSERT_EQ(spectrum.wavelengths_nm, std::vector<double>{400});
    EXPECT_EQ(spectrum.reflectance[0].standard_error, 0.002);
    EXPECT_EQ(spectrum.transmittance[0].value, 0.5);
}

TEST(ReferenceSpectrum, AnythingUnknownIsRefused) {
    const std::string row = "400,0.1,0.002,0.5,0.003,0.05\n";
    for (const std::string header : {"# walk; edition printed; incidence 0 deg; changed from Table 1: th_x=1\n",
                                     "# walk; edition other; incidence 0 deg; changed from Table 1: \n",
                                     "# walk; edition printed; changed from Table 1: \n"}) {
        EXPECT_THROW((void)parse_reference_spectrum("x", header + columns + row), std::runtime_error) << header;
    }
}

}  // namespace
}  // namespace skinfit::test
