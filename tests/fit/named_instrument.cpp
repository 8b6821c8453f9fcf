#include "fit/named_instrument.hpp"

#include <gtest/gtest.h>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "fit/configuration_json.hpp"
#include "fit/problem.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using InstrumentFile = test::TemporaryFolder;

std::string refusal(const std::string& text) {
    return test::refusal_of([&] { (void)parse_instrument(text, "i.json"); });
}

const std::string bare = R"({"description": "d", "incidence_deg": null, "specular": null, "viewing_cone_deg": null,
 "aperture_mm": null, "bandpass": null, "wavelength_nm": null, "noise": null, "sources": {}})";

std::string with(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

TEST(NamedInstruments, ThatComeWithTheProgramStateASourceForEverything) {
    const std::vector<std::string> names = instrument_names();
    EXPECT_EQ(names.size(), 5U);
    for (const std::string& name : names) {
        const NamedInstrument instrument = find_instrument(name, "instrument");  // refuses what has no source
        EXPECT_TRUE(instrument.geometry.incidence_deg) << name;
        EXPECT_TRUE(instrument.geometry.specular) << name;
    }
}

TEST(NamedInstruments, FillInWhatIsNotSet) {
    Configuration configuration =
        configured_by_assignment(default_configuration(), "instrument=konica_minolta_cm_2600d");
    configuration = configured_by_assignment(configuration, "specular=excluded");
    Spectrum spectrum;
    spectrum.geometry.incidence_deg = 45;
    const ResolvedConfiguration complete = resolved(configuration, spectrum);
    EXPECT_EQ(complete.incidence_deg, 8.0) << "what is set counts before what the file states";
    EXPECT_EQ(complete.specular, Specular::excluded);
    EXPECT_EQ(complete.bandpass.shape, BandpassShape::triangular);
    EXPECT_EQ(complete.bandpass.width_nm, 10.0);
}

TEST_F(InstrumentFile, HasTheNoiseWhereNoneIsSet) {
    std::string text = with(bare, R"("noise": null)", R"("noise": 0.02)");
    text = with(text, R"("sources": {})", R"("sources": {"noise": "a test"})");
    write_file_atomically(in_folder("i.json"), text);
    Configuration configuration = default_configuration();
    configuration.instrument = find_instrument(in_folder("i.json").string(), "instrument");
    write_file_atomically(in_folder("i.json"), "edited meanwhile");
    EXPECT_EQ(resolved(configuration, Spectrum{}).noise, 0.02);
    configuration.noise = default_noise;
    EXPECT_EQ(resolved(configuration, Spectrum{}).noise, default_noise) << "what is set counts, whatever it is";
    EXPECT_EQ(resolved(default_configuration(), Spectrum{}).noise, default_noise);
}

TEST(NamedInstruments, OfAFileCountAfterWhatTheFileStates) {
    Spectrum spectrum;
    spectrum.instrument = "konica_minolta_cm_2600d";
    spectrum.geometry.specular = Specular::excluded;
    spectrum.bandpass = {.shape = BandpassShape::gaussian, .width_nm = 4};
    const ResolvedConfiguration complete = resolved(default_configuration(), spectrum);
    EXPECT_EQ(complete.instrument, "konica_minolta_cm_2600d");
    EXPECT_EQ(complete.specular, Specular::excluded);
    EXPECT_EQ(complete.bandpass.width_nm, 4.0);
    EXPECT_EQ(complete.incidence_deg, 8.0);
    spectrum.instrument = "some other device";
    EXPECT_EQ(resolved(default_configuration(), spectrum).instrument, "");
}

TEST(NamedInstruments, AreRefusedWithoutASourceOrWithUnknownKeys) {
    EXPECT_EQ(refusal(bare), "");
    EXPECT_EQ(
        refusal(with(bare, "\"incidence_deg\": null", "\"incidence_deg\": 8")),
        "i.json.sources: no \"incidence_deg\" (what is stated needs a source); say where it is from, or state null");
    EXPECT_NE(refusal(with(bare, "\"noise\": null, ", "")).find("i.json: no \"noise\""), std::string::npos);
    EXPECT_NE(refusal(with(bare, "\"noise\"", "\"nose\"")).find("did you mean \"noise\"?"), std::string::npos);
    try {
        (void)configured_by_assignment(default_configuration(), "instrument=cm_2600");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "--set instrument: there is no instrument \"cm_2600\" (it is neither a file nor one of those that "
                     "come with the program); give a JSON file, or one of issa_sphere, konica_minolta_cm_2600d, "
                     "ncsu_45_0, nist_sphere, xrite_i1pro");
    }
}

}  // namespace
}  // namespace skinfit
