#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/file.hpp"
#include "core/text.hpp"
#include "model/constants.hpp"
#include "tests/support/reference_spectrum.hpp"
#include "tests/support/statistics.hpp"
#include "transport/skin_spectra.hpp"

/// Against spectra that another Monte Carlo of the same physics has made, in ../shared/transport. Its spectra share one
/// trace per wavelength, whose error all of them have in common: what is compared is their mean.
namespace skinfit {
namespace {

constexpr double reference_error = 0.0006;  // of a trace, the highest that the files state
constexpr std::uint64_t photons = 60'000;
constexpr std::size_t first_wavelength = 6;  // columns before it: name, melanin, two of blood, saturation, bilirubin

struct ReferenceSet {
    std::vector<LayeredSkin> skins;
    std::vector<double> wavelengths_nm;
    std::vector<std::vector<double>> spectra;
};

std::vector<double> numbers(const std::vector<std::string_view>& fields, std::size_t first) {
    std::vector<double> values;
    for (std::size_t i = first; i < fields.size(); ++i) values.push_back(parse_number(fields[i]).value());
    return values;
}

LayeredSkin described(const std::vector<double>& truth) {
    LayeredSkin skin;
    skin.scattering = {46.0, 1.42};
    skin.melanosome_fraction = truth[0];
    skin.papillary_blood_fraction = truth[1];
    skin.reticular_blood_fraction = truth[2];
    skin.oxygen_saturation = truth[3];
    skin.dermal_bilirubin_g_per_l = truth[4];
    return skin;
}

ReferenceSet read_set(const std::filesystem::path& path) {
    ReferenceSet set;
    const std::string text = read_file(path);
    for (const std::string_view line : split_lines(text)) {
        if (line.starts_with('#') || line.empty()) continue;
        const std::vector<std::string_view> fields = split(line, ',');
        if (set.wavelengths_nm.empty()) {
            set.wavelengths_nm = numbers(fields, first_wavelength);
            continue;
        }
        const std::vector<double> values = numbers(fields, 1);
        set.skins.push_back(described(values));
        set.spectra.emplace_back(values.begin() + first_wavelength - 1, values.end());
    }
    return set;
}

/// The z, at every tenth wavelength, of the mean deviation from the set.
std::vector<double> z_of_means(const ReferenceSet& set, const SkinTransportOptions& options, double white_noise) {
    std::vector<std::size_t> columns;
    std::vector<double> wavelengths_nm;
    for (std::size_t i = 0; i < set.wavelengths_nm.size(); i += 10) {
        columns.push_back(i);
        wavelengths_nm.push_back(set.wavelengths_nm[i]);
    }
    const SkinReadings readings = skin_spectra(set.skins, wavelengths_nm, options);
    const auto count = static_cast<double>(set.skins.size());
    std::vector<double> z;
    for (std::size_t w = 0; w < columns.size(); ++w) {
        double deviation = 0.0;
        double own_error = 0.0;  // all skins share the trace: their errors add up
        for (std::size_t skin = 0; skin < set.skins.size(); ++skin) {
            deviation += (readings[skin][0][w].value - set.spectra[skin][columns[w]]) / count;
            own_error += readings[skin][0][w].standard_error / count;
        }
        z.push_back(deviation / std::hypot(own_error, reference_error, white_noise / std::sqrt(count)));
    }
    return z;
}

class TransportReferences : public testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(folder_)) GTEST_SKIP() << "../shared is absent";
    }
    const std::filesystem::path folder_ = test::shared_folder() / "transport";
};

TEST_F(TransportReferences, ASphereReadsTheSame) {
    ReferenceSet set = read_set(folder_ / "factorial_sphere_noisefree.csv");
    EXPECT_GT(test::family_wise_p_value(z_of_means(set, {.photons = photons}, 0.0)), test::passing_p_value);
    for (LayeredSkin& skin : set.skins) skin.stratum_corneum_refractive_index = 1.4;
    EXPECT_LT(test::family_wise_p_value(z_of_means(set, {.photons = photons}, 0.0)), test::passing_p_value)
        << "another index of the stratum corneum passes";
}

TEST_F(TransportReferences, ASmallPortReadsTheSame) {
    const ReferenceSet set = read_set(folder_ / "factorial_port8mm_noisefree.csv");
    const auto options = [](double diameter_cm) {
        const double radius = diameter_cm / 2;
        return SkinTransportOptions{.gatherings = {{.spot_radius_cm = radius, .port_radius_cm = radius}},
                                    .photons = photons};
    };
    EXPECT_GT(test::family_wise_p_value(z_of_means(set, options(0.8), 0.0)), test::passing_p_value);
    EXPECT_LT(test::family_wise_p_value(z_of_means(set, options(0.6), 0.0)), test::passing_p_value)
        << "a smaller port passes";
}

TEST_F(TransportReferences, AViewAlongTheNormalReadsTheSame) {
    const ReferenceSet set = read_set(folder_ / "factorial_45_0_noise003.csv");
    const auto options = [](double cone_deg) {
        return SkinTransportOptions{
            .incidence_rad = 45 * rad_per_deg,
            .gatherings = {{.viewing_cone_rad = cone_deg * rad_per_deg, .specular = Specular::excluded}},
            .photons = photons};
    };
    EXPECT_GT(test::family_wise_p_value(z_of_means(set, options(25), 0.003)), test::passing_p_value);
    EXPECT_LT(test::family_wise_p_value(z_of_means(set, options(80), 0.003)), test::passing_p_value)
        << "a view from all sides passes";
}

}  // namespace
}  // namespace skinfit
