#include "measurements/spectrum_writer.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>

#include "measurements/spectrum_file.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit {
namespace {

using Numbers = std::vector<double>;

/// A made-up spectrum with everything in it, its numbers with digits down to the last bit.
Spectrum complete(const std::string& name, std::mt19937_64& random) {
    Spectrum spectrum;
    spectrum.name = name;
    spectrum.quantity = Quantity::transmittance;
    spectrum.geometry = {.incidence_deg = 8.1, .specular = Specular::included, .viewing_cone_deg = 1.0 / 3};
    spectrum.instrument = "made up, \"model 1\"";
    spectrum.site = "left arm: inside";
    spectrum.aperture_mm = 2.0 / 3;
    spectrum.bandpass = {.shape = BandpassShape::gaussian, .width_nm = 10.0 / 3};
    spectrum.sigma_source = "from 3 repeats";
    spectrum.notes = {{.line = 1, .key = "operator", .value = "A, B"}, {.line = 2, .key = "operator", .value = "C"}};
    for (int i = 0; i < 20; ++i) {
        const auto share = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
        spectrum.wavelength_nm.push_back(400 + 1e3 / 3 * i);
        spectrum.value.push_back(i == 0 ? 5e-324 : share());
        spectrum.sigma.push_back(i == 1 ? 1e300 : share());
    }
    return spectrum;
}

void expect_same(const Spectrum& a, const Spectrum& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.wavelength_nm, b.wavelength_nm);
    EXPECT_EQ(a.value, b.value);
    EXPECT_EQ(a.sigma, b.sigma);
    EXPECT_EQ(a.sigma_source, b.sigma_source);
    EXPECT_EQ(a.quantity, b.quantity);
    EXPECT_EQ(a.geometry.incidence_deg, b.geometry.incidence_deg);
    EXPECT_EQ(a.geometry.specular, b.geometry.specular);
    EXPECT_EQ(a.geometry.viewing_cone_deg, b.geometry.viewing_cone_deg);
    EXPECT_EQ(a.instrument, b.instrument);
    EXPECT_EQ(a.site, b.site);
    EXPECT_EQ(a.aperture_mm, b.aperture_mm);
    ASSERT_EQ(a.bandpass.has_value(), b.bandpass.has_value());
    if (a.bandpass) {
        EXPECT_EQ(a.bandpass->shape, b.bandpass->shape);
        EXPECT_EQ(a.bandpass->width_nm, b.bandpass->width_nm);
    }
    EXPECT_EQ(a.missing_nm, b.missing_nm);
    ASSERT_EQ(a.notes.size(), b.notes.size());
    for (std::size_t i = 0; i < a.notes.size(); ++i) {
        EXPECT_EQ(a.notes[i].key, b.notes[i].key);
        EXPECT_EQ(a.notes[i].value, b.notes[i].value);
    }
}

void expect_round_trip(const std::vector<Spectrum>& spectra, const std::string& text) {
    const SpectrumFile file = parse_spectra(text, "f");
    ASSERT_EQ(file.spectra.size(), spectra.size()) << text;
    for (std::size_t i = 0; i < spectra.size(); ++i) expect_same(spectra[i], file.spectra[i]);
}

std::string refusal(const std::vector<Spectrum>& spectra) {
    return test::refusal_of([&] { (void)spectra_csv(spectra, "f"); });
}

TEST(SpectrumWriter, OneSpectrumReadsBackToTheLastBit) {
    std::mt19937_64 random(1);
    const std::vector<Spectrum> one{complete("arm, \"left\"; # 1", random)};
    expect_round_trip(one, spectra_csv(one, "f"));
    expect_round_trip(one, spectra_json(one));
}

TEST(SpectrumWriter, SeveralReadBackToTheLastBit) {
    std::mt19937_64 random(2);
    std::vector<Spectrum> several{complete("a", random), complete("b, \"x\" # y", random), complete("3 %", random),
                                  complete("2", random)};
    several[1].sigma.clear();
    several[1].sigma_source.clear();
    expect_round_trip(several, spectra_csv(several, "f"));
    expect_round_trip(several, spectra_json(several));
}

TEST(SpectrumWriter, MissingValuesAreEmptyCells) {
    std::mt19937_64 random(3);
    std::vector<Spectrum> several{complete("a", random), complete("b", random)};
    several[0].missing_nm = {several[0].wavelength_nm[7]};
    for (Numbers* numbers : {&several[0].wavelength_nm, &several[0].value, &several[0].sigma}) {
        numbers->erase(numbers->begin() + 7);
    }
    expect_round_trip(several, spectra_csv(several, "f"));
    expect_round_trip(several, spectra_json(several));
}

TEST(SpectrumWriter, JsonHoldsSpectraOfDifferentGridsAndRepeats) {
    std::mt19937_64 random(4);
    std::vector<Spectrum> several{complete("a", random), complete("a", random)};
    for (double& nm : several[1].wavelength_nm) nm += 0.1;
    several[1].geometry.specular = Specular::excluded;
    several[1].repeats = {several[1].value, several[0].value};
    expect_round_trip(several, spectra_json(several));
    EXPECT_EQ(parse_spectra(spectra_json(several), "f").spectra[1].repeats, several[1].repeats);
}

TEST(SpectrumWriter, CsvRefusesWhatItsColumnsCannotHold) {
    std::mt19937_64 random(5);
    const std::string remedy = "write them with --format json, or choose some of them with --column";
    std::vector<Spectrum> several{complete("a", random), complete("b", random)};
    several[1].wavelength_nm[0] = 399;
    EXPECT_EQ(refusal(several),
              "f: \"b\" has other wavelengths than \"a\" (the lines of a table have one wavelength each); " + remedy);
    several[1] = complete("b", random);
    several[1].site = "right arm";
    EXPECT_EQ(
        refusal(several),
        "f: \"b\" is described otherwise than \"a\" (the comments of a table hold for all of its columns); " + remedy);
    for (const std::string name : {"a", "", "a_sigma", "sigma", " b", "b\nc", "reflectance"}) {
        several[1] = complete("b", random);
        several[1].name = name;
        EXPECT_EQ(refusal(several),
                  "f: its names or comments cannot stand in a table of text (names must be different, on one line, and "
                  "not say anything about unit or quantity); " +
                      remedy)
            << name;
    }
}

}  // namespace
}  // namespace skinfit
