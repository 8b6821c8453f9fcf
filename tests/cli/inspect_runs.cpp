#include "core/json.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

const std::string specimen = SKINFIT_SOURCE_DIR "/measurements/data/ncsu_113.csv";

class InspectRuns : public CliTest {
protected:
    [[nodiscard]] std::string output_of(const std::vector<std::string>& arguments) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return outcome.out;
    }
};

/// Grey paper.
const std::string grey =
    "wavelength_nm,reflectance\n500,0.3\n510,0.3\n520,0.3\n530,0.3\n540,0.31\n550,0.3\n560,0.3\n"
    "570,0.3\n580,0.3\n590,0.3\n600,0.3\n610,0.3\n620,0.3\n630,0.3\n";

TEST_F(InspectRuns, ShowWhatAGoodFileHolds) {
    const std::string text = output_of({"inspect", specimen});
    EXPECT_NE(text.find("1 spectrum, read as columns"), std::string::npos);
    EXPECT_NE(text.find("wavelengths: 69 from 390 to 730 nm, every 5 nm"), std::string::npos);
    EXPECT_NE(text.find("measurement: reflectance, incidence 45 deg, specular excluded"), std::string::npos);
    EXPECT_TRUE(text.ends_with("\nfindings: none\n")) << text;
    const Json json = Json::parse(output_of({"inspect", specimen, "--format", "json", "--strict"}));
    EXPECT_EQ(json["spectra"], 1);
    EXPECT_EQ(json["names"].size(), 1U);
    EXPECT_EQ(json["wavelength_nm"]["step"], 5.0);
    EXPECT_EQ(json["findings"], Json::array());
}

TEST_F(InspectRuns, StrictRefusesAfterShowing) {
    put("grey.csv", grey);
    EXPECT_NE(output_of({"inspect", "grey.csv"}).find("WARNING no_hemoglobin: "), std::string::npos);
    const Outcome outcome = run({"inspect", "grey.csv", "--strict", "--format", "json"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(Json::parse(outcome.out)["findings"][0]["name"], "no_hemoglobin");
    EXPECT_TRUE(outcome.err.starts_with("error: grey.csv: grey: no_hemoglobin: ")) << outcome.err;
}

TEST_F(InspectRuns, DrawThePictureAskedFor) {
    (void)output_of({"inspect", specimen, "--plot", "spectra.svg"});
    EXPECT_NE(read_file(folder() / "spectra.svg").find("<svg"), std::string::npos);
    const Outcome outcome = run({"inspect", specimen, "--plot", "spectra.bmp"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("unknown suffix \".bmp\" of a plot"), std::string::npos);
}

TEST_F(InspectRuns, TheUnitAndTheReaderCanBeStated) {
    put("percent.csv", "nm,values\n400,10\n410,20\n420,30\n");
    const Json percent = Json::parse(output_of({"inspect", "percent.csv", "--format", "json"}));
    EXPECT_EQ(percent["values"]["largest"], 0.3);
    const Json fraction = Json::parse(output_of({"inspect", "percent.csv", "--unit", "fraction", "--format", "json"}));
    EXPECT_EQ(fraction["findings"][0]["name"], "unit_conflict");
    const Outcome outcome = run({"inspect", "percent.csv", "--reader", "colums"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("did you mean columns?"), std::string::npos) << outcome.err;
}

TEST_F(InspectRuns, FitsCarryTheFindingsAndStrictOnesStopBefore) {
    put("grey.csv", grey);
    const std::vector<std::string> fit = {"fit", "grey.csv", "--set", "rays=2000", "--set", "noise=0.1"};
    std::vector<std::string> arguments = fit;
    const Outcome text = run(arguments);
    EXPECT_EQ(text.exit_code, 1);
    EXPECT_NE(text.out.find("SPECTRUM IN DOUBT: no_hemoglobin"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("findings:\n  WARNING no_hemoglobin: "), std::string::npos) << text.out;
    arguments.insert(arguments.end(), {"--format", "json"});
    EXPECT_EQ(Json::parse(run(arguments).out)["findings"][0]["name"], "no_hemoglobin");
    arguments.emplace_back("--strict");
    const Outcome strict = run(arguments);
    EXPECT_EQ(strict.exit_code, 2);
    EXPECT_EQ(strict.out, "");
}

}  // namespace
}  // namespace skinfit::test
