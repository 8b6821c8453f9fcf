#include "study/indices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/colour.hpp"
#include "model/lab.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit {
namespace {

using test::grid_nm;

/// Brighter towards the red, as skin is.
Spectrum slope(double step_nm = 10) {
    Spectrum spectrum;
    spectrum.wavelength_nm = grid_nm(400, 700, step_nm);
    for (const double nm : spectrum.wavelength_nm) spectrum.value.push_back(0.2 + 0.4 * (nm - 400.0) / 300.0);
    return spectrum;
}

Spectrum flat(double value) {
    Spectrum spectrum = slope();
    std::ranges::fill(spectrum.value, value);
    return spectrum;
}

const IndexValue* named(const std::vector<IndexValue>& values, std::string_view name) {
    const auto found = std::ranges::find(values, name, &IndexValue::name);
    return found == values.end() ? nullptr : &*found;
}

double value_of_index(const Spectrum& spectrum, std::string_view name) {
    return named(indices_of(spectrum, 0.001), name)->value;
}

TEST(Indices, OfAFlatSpectrumAreClosedForms) {
    for (const double value : {0.05, 0.5, 1.0}) {
        EXPECT_NEAR(value_of_index(flat(value), "melanin_index"), 100.0 * std::log10(1.0 / value), 1e-12);
        EXPECT_NEAR(value_of_index(flat(value), "erythema_index"), 0.0, 1e-12);
    }
}

TEST(Indices, InterpolateBetweenReadings) {
    const double red = 0.2 + 0.4 * 255.0 / 300.0;
    const double green = 0.2 + 0.4 * 168.0 / 300.0;
    for (const double step_nm : {1.0, 10.0, 30.0}) {
        EXPECT_NEAR(value_of_index(slope(step_nm), "melanin_index"), -100.0 * std::log10(red), 1e-10);
        EXPECT_NEAR(value_of_index(slope(step_nm), "erythema_index"), 100.0 * std::log10(red / green), 1e-10);
    }
}

TEST(Indices, ScaleOfReflectanceShiftsMelaninAlone) {
    Spectrum half = slope();
    for (double& value : half.value) value /= 2.0;
    EXPECT_NEAR(value_of_index(half, "melanin_index") - value_of_index(slope(), "melanin_index"),
                100.0 * std::log10(2.0), 1e-11);
    EXPECT_NEAR(value_of_index(half, "erythema_index"), value_of_index(slope(), "erythema_index"), 1e-11);
}

TEST(Indices, TheAngleIsThatOfTheColour) {
    const Spectrum spectrum = slope();
    const SeenColour seen = colour_of({.wavelength_nm = spectrum.wavelength_nm, .value = spectrum.value}, {});
    const Lab lab = lab_from_xyz(seen.xyz, seen.white);
    EXPECT_NEAR(value_of_index(spectrum, "individual_typology_angle_deg"),
                std::atan((lab.l - 50.0) / lab.b) * 180.0 / std::acos(-1.0), 1e-12);
}

/// At readings exactly at 655 and 568 nm, the standard deviation is the relative one times 100 / ln 10.
TEST(Indices, SigmaIsThatOfErrorPropagation) {
    const Spectrum spectrum = slope(1);
    const double per_share = 100.0 / std::log(10.0);
    const double red = 0.002 / (0.2 + 0.4 * 255.0 / 300.0) * per_share;
    const double green = 0.002 / (0.2 + 0.4 * 168.0 / 300.0) * per_share;
    const std::vector<IndexValue> values = indices_of(spectrum, 0.002);
    EXPECT_NEAR(named(values, "melanin_index")->sigma, red, 1e-12);
    EXPECT_NEAR(named(values, "erythema_index")->sigma, std::hypot(red, green), 1e-12);
    const double angle = named(values, "individual_typology_angle_deg")->sigma;
    EXPECT_NEAR(named(indices_of(spectrum, 0.001), "individual_typology_angle_deg")->sigma, angle / 2.0, 1e-4 * angle);
}

/// Half way between two readings of the same noise, half of the variance remains.
TEST(Indices, BetweenReadingsNoiseAverages) {
    const std::vector<IndexValue> values = indices_of(slope(10), 0.002);  // 650 and 660 nm
    const double red = 0.2 + 0.4 * 255.0 / 300.0;
    EXPECT_NEAR(named(values, "melanin_index")->sigma, 0.002 / std::sqrt(2.0) / red * 100.0 / std::log(10.0), 1e-12);
}

TEST(Indices, AStatedUncertaintyTakesThePlaceOfTheNoise) {
    Spectrum spectrum = slope();
    spectrum.sigma.assign(spectrum.value.size(), 0.004);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(indices_of(spectrum, 0.001)[i].sigma, indices_of(slope(), 0.004)[i].sigma);
    }
}

TEST(Indices, AreThoseThatTheSpectrumHas) {
    EXPECT_EQ(indices_of(slope(), 0.001).size(), 3U);
    Spectrum spectrum = slope();
    spectrum.quantity = Quantity::transmittance;
    EXPECT_TRUE(indices_of(spectrum, 0.001).empty());
    spectrum = slope();
    spectrum.wavelength_nm.resize(26);  // to 650 nm
    spectrum.value.resize(26);
    EXPECT_TRUE(indices_of(spectrum, 0.001).empty());
    spectrum = slope();
    spectrum.wavelength_nm = grid_nm(430, 730, 10);
    EXPECT_EQ(indices_of(spectrum, 0.001).size(), 2U);  // not from 420 nm
    spectrum = slope();
    spectrum.value[25] = spectrum.value[26] = 0.0;  // at 650 and 660 nm
    EXPECT_FALSE(named(indices_of(spectrum, 0.001), "melanin_index"));
    EXPECT_FALSE(named(indices_of(spectrum, 0.001), "erythema_index"));
    spectrum = slope();
    std::ranges::reverse(spectrum.value);  // bluish
    EXPECT_FALSE(named(indices_of(spectrum, 0.001), "individual_typology_angle_deg"));
    EXPECT_TRUE(named(indices_of(spectrum, 0.001), "melanin_index"));
}

TEST(Indices, ReachToTheEndsExactly) {
    Spectrum spectrum;
    spectrum.wavelength_nm = {568, 655};
    spectrum.value = {0.3, 0.6};
    const std::vector<IndexValue> values = indices_of(spectrum, 0.001);
    ASSERT_EQ(values.size(), 2U);
    EXPECT_NEAR(values[1].value, 100.0 * std::log10(2.0), 1e-12);
}

/// The scatter of the indices of noisy spectra is what their sigmas say: chi-square of (n - 1) variance / sigma^2.
TEST(Indices, ScatterAsTheirSigmasSay) {
    constexpr std::size_t spectra = 2000;
    constexpr double noise = 0.001;
    const Spectrum truth = slope();
    const std::vector<IndexValue> claimed = indices_of(truth, noise);
    const std::vector<double> normal = test::normal_numbers(11, spectra * truth.value.size());
    for (const IndexValue& index : claimed) {
        double sum = 0.0;
        double squares = 0.0;
        for (std::size_t k = 0; k < spectra; ++k) {
            Spectrum noisy = truth;
            for (std::size_t i = 0; i < noisy.value.size(); ++i) {
                noisy.value[i] += noise * normal[k * noisy.value.size() + i];
            }
            const double z = (value_of_index(noisy, index.name) - index.value) / index.sigma;
            sum += z;
            squares += z * z;
        }
        const auto n = static_cast<double>(spectra);
        const double statistic = squares - sum * sum / n;
        const auto p_value = [n](double chi_square) {
            const double above = test::chi_square_p_value(chi_square, n - 1.0);
            return 2.0 * std::min(above, 1.0 - above);
        };
        EXPECT_GT(p_value(statistic), test::passing_p_value) << index.name << " " << statistic / n;
        EXPECT_LT(p_value(statistic * 1.25), test::passing_p_value) << "12 % of sigma would show";
    }
}

}  // namespace
}  // namespace skinfit
