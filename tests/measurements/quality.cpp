#include "measurements/quality.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/input_error.hpp"
#include "measurements/quality_checks.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit {
namespace {

constexpr ModelledRange tables{.lowest_nm = 250, .highest_nm = 1000};

/// `shape` of the wavelength, every `step_nm`.
Spectrum made(const std::function<double(double)>& shape, double first_nm = 400, double last_nm = 740,
              double step_nm = 10) {
    Spectrum spectrum;
    spectrum.name = "made";
    spectrum.source = "made.csv";
    spectrum.unit_rule = "fraction: stated by a comment in the file";
    for (double at_nm = first_nm; at_nm <= last_nm; at_nm += step_nm) {
        spectrum.wavelength_nm.push_back(at_nm);
        spectrum.value.push_back(shape(at_nm));
    }
    return spectrum;
}

double bell(double at_nm, double centre_nm, double width_nm) {
    return std::exp(-0.5 * std::pow((at_nm - centre_nm) / width_nm, 2));
}

/// The surface, melanin's slope, the two bands of oxygenated blood and their Soret band.
double skin(double at_nm) {
    const double melanin = 0.5 * std::pow(at_nm / 700, -3.3);
    const double blood = 0.35 * (bell(at_nm, 542, 12) + bell(at_nm, 577, 10)) + 0.8 * bell(at_nm, 415, 18);
    return 0.04 + std::exp(-0.3 - melanin - blood);
}

std::vector<std::string> names(const std::vector<Finding>& findings) {
    std::vector<std::string> all;
    for (const Finding& finding : findings) all.push_back(finding.name);
    return all;
}

std::vector<std::string> names_on(const Spectrum& spectrum) {
    return names(quality_findings(std::vector{spectrum}, tables));
}

using Names = std::vector<std::string>;

TEST(QualityFindings, AreNoneOnSkin) {
    for (const double step_nm : {1.0, 2.0, 10.0}) EXPECT_EQ(names_on(made(skin, 400, 740, step_nm)), Names{});
    const std::filesystem::path data = std::filesystem::path(SKINFIT_SOURCE_DIR) / "measurements/data";
    EXPECT_EQ(names_on(read_spectrum(data / "ncsu_082.csv")), Names{});
    EXPECT_EQ(names_on(read_spectrum(data / "ncsu_113.csv")), Names{});
}

TEST(QualityFindings, AreNoneOnSkinWithNoise) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 100; ++i) {
        std::normal_distribution<double> noise(0, 0.006);
        EXPECT_EQ(names_on(made([&](double at_nm) { return skin(at_nm) + noise(random); }, 400, 740, 2)), Names{});
    }
}

TEST(QualityFindings, NameAWrongUnit) {
    Spectrum fractions = made([](double at_nm) { return skin(at_nm) / 100; });
    fractions.unit_rule = "percent: stated by the header";
    EXPECT_EQ(unit_conflict(fractions).value().remedy, "if these are fractions, say so with --unit fraction");
    const Spectrum percent = made([](double at_nm) { return skin(at_nm) * 100; });
    EXPECT_EQ(unit_conflict(percent).value().remedy, "if these are percent, say so with --unit percent");
    EXPECT_FALSE(unit_conflict(made(skin)));
    Spectrum counts = percent;
    counts.unit_rule = "percent: stated by the option";
    EXPECT_EQ(unit_conflict(counts).value().remedy, "if these are counts, divide them by those of the white reference");
}

TEST(QualityFindings, NameValuesThatNoShareOfLightHas) {
    const auto with = [](double at_500_nm) {
        return made([=](double at_nm) { return at_nm == 500 ? at_500_nm : skin(at_nm); });
    };
    EXPECT_EQ(outside_0_1(with(-0.01)).value().message, "1 of 35 values lie outside 0 to 1, as -0.01 at 500 nm does");
    EXPECT_EQ(outside_0_1(with(1.02)).value().message, "1 of 35 values lie outside 0 to 1, as 1.02 at 500 nm does");
    EXPECT_FALSE(outside_0_1(with(1)));
    EXPECT_FALSE(outside_0_1(with(0)));
}

TEST(QualityFindings, NameAnOffsetWhereTheSurfaceAloneIsBrighter) {
    Spectrum spectrum = made([](double at_nm) { return skin(at_nm) - 0.08; });
    EXPECT_TRUE(offset(spectrum));
    spectrum.geometry.specular = Specular::excluded;
    EXPECT_FALSE(offset(spectrum));
    spectrum.geometry.specular = Specular::included;
    EXPECT_TRUE(offset(spectrum));
    spectrum.quantity = Quantity::transmittance;
    EXPECT_FALSE(offset(spectrum));
}

TEST(QualityFindings, NameASpectrumThatIsDarkEverywhere) {
    const auto times = [](double share) {
        return made([=](double at_nm) { return share * (skin(at_nm) - 0.04) + 0.04; });
    };
    EXPECT_EQ(names_on(times(0.08)), Names{"dark_everywhere"});
    EXPECT_FALSE(dark_everywhere(times(0.15)));
    const Spectrum blue = made([](double at_nm) { return 0.1 * (skin(at_nm) - 0.04) + 0.04; }, 400, 500);
    EXPECT_FALSE(dark_everywhere(blue)) << "dark skin is dark there";
}

TEST(QualityFindings, CountMissingValues) {
    Spectrum spectrum = made(skin);
    spectrum.missing_nm = {405, 415, 425, 435};
    EXPECT_EQ(missing_values(spectrum).value().message, "4 of 39 wavelengths have no value");
    EXPECT_EQ(missing_values(spectrum).value().severity, Severity::warning);
    spectrum.missing_nm.pop_back();
    EXPECT_EQ(missing_values(spectrum).value().severity, Severity::note);
}

TEST(QualityFindings, NoteWavelengthsThatTheModelDoesNotKnow) {
    EXPECT_FALSE(outside_tables(made(skin, 400, 1000), tables));
    EXPECT_EQ(outside_tables(made(skin, 400, 1010), tables).value().severity, Severity::note);
    EXPECT_EQ(outside_tables(made(skin, 1010, 1100), tables).value().severity, Severity::warning);
}

TEST(QualityFindings, NameSpikesOfEitherSignOnAnyGrid) {
    for (const double step_nm : {2.0, 5.0, 10.0}) {
        for (const double height : {0.05, -0.05}) {
            const Spectrum spectrum =
                made([=](double at_nm) { return skin(at_nm) + (at_nm == 650 ? height : 0.0); }, 400, 740, step_nm);
            EXPECT_EQ(names_on(spectrum), Names{"spikes"});
            EXPECT_NE(spikes(spectrum).value().message.find("at 650 nm"), std::string::npos);
        }
    }
}

TEST(QualityFindings, NameTheEndAtWhichASpectrumCollapses) {
    const auto red = [](double rest) {
        return made(
            [=](double at_nm) { return skin(at_nm) * (at_nm <= 720 ? 1 : 1 - (1 - rest) * (at_nm - 720) / 20); });
    };
    EXPECT_EQ(names_on(red(0.45)), Names{"collapse_at_end"});
    EXPECT_EQ(names_on(red(0.6)), Names{"falling_end"});
    EXPECT_EQ(names_on(red(0.8)), Names{});
    const auto blue = [](double rest) {
        return made(
            [=](double at_nm) { return skin(at_nm) * (at_nm >= 420 ? 1 : 1 - (1 - rest) * (420 - at_nm) / 20); });
    };
    EXPECT_NE(collapse_at_end(blue(0.2)).value().message.find("at its end, 400 nm"), std::string::npos);
    EXPECT_FALSE(collapse_at_end(blue(0.5)));
}

TEST(QualityFindings, NameAClippedTop) {
    const Spectrum clipped = made([](double at_nm) { return std::min(0.4, skin(at_nm)); });
    EXPECT_EQ(names_on(clipped), Names{"saturation"});
    const Spectrum rounded = made([](double at_nm) { return std::round(100 * skin(at_nm)) / 100; }, 400, 740, 1);
    EXPECT_FALSE(saturation(rounded)) << "a maximum that is flat because its numbers are coarse";
}

TEST(QualityFindings, DoubtWhatHasNoHemoglobin) {
    const auto leaf = [](double at_nm) {
        return 0.05 + 0.1 * bell(at_nm, 550, 30) + 0.45 / (1 + std::exp((715 - at_nm) / 10));
    };
    for (const std::function<double(double)>& thing : std::vector<std::function<double(double)>>{
             [](double) { return 0.18; }, [](double at_nm) { return 0.9 + at_nm * 1e-5; }, leaf,
             [](double at_nm) { return 0.05 + std::exp(-2 * std::pow(at_nm / 500, -3.3)); }}) {
        EXPECT_EQ(names_on(made(thing)), Names{"no_hemoglobin"});
    }
    EXPECT_FALSE(no_hemoglobin(made(leaf, 400, 600))) << "not to be judged without the red";
}

TEST(QualityFindings, CompareTheStatedNoiseWithRepeats) {
    Spectrum spectrum = made(skin);
    const auto shifted = [&](double by) {
        std::vector<double> values = spectrum.value;
        for (double& value : values) value += by;
        return values;
    };
    spectrum.repeats = {shifted(-0.01), shifted(0), shifted(0.01)};  // their mean is uncertain by 0.01 / sqrt(3)
    spectrum.sigma.assign(spectrum.value.size(), 0.0058);
    EXPECT_EQ(names_on(spectrum), Names{});
    spectrum.sigma.assign(spectrum.value.size(), 0.002);
    EXPECT_EQ(names_on(spectrum), Names{"noise_against_repeats"});
    spectrum.sigma.assign(spectrum.value.size(), 0.2);
    EXPECT_EQ(names_on(spectrum), Names{"noise_against_repeats"});
}

TEST(QualityFindings, NameEveryMemberOfAGroupOfDuplicates) {
    std::vector<Spectrum> set(4, made(skin));
    set[1] = made([](double at_nm) { return 0.9 * skin(at_nm); });
    for (std::size_t i = 0; i < set.size(); ++i) set[i].name = std::to_string(i);
    const std::vector<Finding> findings = duplicates(set);
    ASSERT_EQ(findings.size(), 3U);
    EXPECT_EQ(findings[0].spectrum, "0");
    EXPECT_EQ(findings[1].spectrum, "2");
    EXPECT_EQ(findings[2].spectrum, "3");
    EXPECT_EQ(findings[2].message, "has the same values as 2");
}

TEST(QualityFindings, AddReflectanceAndTransmittanceOfOneSpecimen) {
    std::vector<Spectrum> pair(2, made(skin));
    pair[0].name = "ear reflectance";
    pair[0].quantity = Quantity::reflectance;
    pair[1].name = "Ear transmittance [%]";
    pair[1].quantity = Quantity::transmittance;
    EXPECT_EQ(names(reflectance_plus_transmittance(pair)), Names{"reflectance_plus_transmittance"});
    pair[1].name = "lid transmittance";
    EXPECT_EQ(names(reflectance_plus_transmittance(pair)), Names{});
    pair[1].name = "ear transmittance";
    for (double& value : pair[1].value) value *= 0.3;
    EXPECT_EQ(names(reflectance_plus_transmittance(pair)), Names{});
}

TEST(QualityFindings, AreErrorsWhereWarningsAreRefused) {
    EXPECT_NO_THROW(refuse_warnings(quality_findings(std::vector{made(skin, 400, 1010)}, tables), "file.csv"));
    try {
        refuse_warnings(quality_findings(std::vector{made([](double) { return 0.05; })}, tables), "file.csv");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(
            error.what(),
            "file.csv: made: dark_everywhere: nowhere above 0.05, which it reaches at 400 nm; skin exceeds 0.09 "
            "(--strict makes it an error, the first of 2); check the white standard, the contact with "
            "the skin and that the lamp was on");
    }
}

}  // namespace
}  // namespace skinfit
