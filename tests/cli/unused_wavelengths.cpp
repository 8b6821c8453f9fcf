#include <cmath>
#include <functional>

#include "core/json.hpp"
#include "tests/cli/study_test.hpp"
#include "tests/measurements/made_cube.hpp"

/// What a fit does not use decides nothing: neither whether it is refused, nor its unit, nor its verdict.
namespace skinfit::test {
namespace {

/// Lamp and detector of a fibre spectrometer begin at 360 nm; from 190 nm to there its file holds the ratio of two dark
/// signals.
const std::string fibre = SKINFIT_SOURCE_DIR "/tests/data/fibre_spectrometer.txt";
/// From 968 to 1012 nm this instrument measures with two detectors, at 1004.2 nm with both.
const std::string overlapping = SKINFIT_SOURCE_DIR "/tests/measurements/cases/overlapping_detectors/arm.sig";

/// A spectrum of made-up skin, in percent, with `text_outside` for the value and the uncertainty of each line outside
/// 400 to 700 nm.
std::string skin_with(const std::function<std::string(int nm)>& text_outside) {
    std::string text = "wavelength_nm,reflectance,sigma\n";
    for (int nm = 200; nm <= 1000; nm += 5) {
        if (nm < 400 || nm > 700) {
            text += std::to_string(nm) + "," + text_outside(nm) + "\n";
            continue;
        }
        const double green = std::exp(-std::pow((nm - 545) / 25.0, 2)) + std::exp(-std::pow((nm - 577) / 15.0, 2));
        text += std::to_string(nm) + "," + std::to_string(10 + 0.12 * (nm - 400) - 6 * green) + ",0.5\n";
    }
    return text;
}

class UnusedWavelengths : public StudyTest {
protected:
    [[nodiscard]] Json fitted(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "fit");
        arguments.insert(arguments.end(), {"--format", "json", "--set", "preset=paper", "--set", "engine=emulator"});
        const Outcome outcome = run(arguments);
        EXPECT_LE(outcome.exit_code, 1) << outcome.err;
        return outcome.exit_code <= 1 ? Json::parse(outcome.out) : Json();
    }

    /// What a fit of `name`.csv finds, without what names the file.
    [[nodiscard]] Json parameters(const std::string& text) const {
        put("made.csv", text);
        const Json result = fitted({"made.csv"});
        EXPECT_EQ(result["findings"], Json::array());
        return result["parameters"];
    }
};

void expect_truth(const Json& result) {
    EXPECT_EQ(result["verdict"], "consistent") << result["reasons"];
    for (const auto& [name, truth] : {std::pair{"melanosome_fraction", 0.045},
                                      {"papillary_blood_fraction", 0.03},
                                      {"oxygen_saturation", 0.75},
                                      {"bilirubin_g_per_l", 0.4}}) {
        const Json& found = result["parameters"][name];
        EXPECT_LE(found["interval_95"][0].get<double>(), truth) << name;
        EXPECT_GE(found["interval_95"][1].get<double>(), truth) << name;
    }
}

TEST_F(UnusedWavelengths, OfAFibreSpectrometerDoNotRefuseTheFit) {
    const Json result = fitted({fibre});
    expect_truth(result);
    const Json& nm = result["wavelength_nm"];
    EXPECT_GE(nm.front().get<double>(), 400);
    EXPECT_LE(nm.back().get<double>(), 700);
    EXPECT_EQ(result["findings"], Json::array());
    const Json excluded = fitted({fibre, "--strict", "--set", "exclude_nm=[[100,399],[701,900]]"});
    EXPECT_EQ(excluded["parameters"], result["parameters"]);
}

TEST_F(UnusedWavelengths, AreExcludedWhereTheWindowHoldsThem) {
    expect_refusal({"fit", fibre, "--set", "wavelength_min_nm=300"}, "is negative");
    expect_refusal({"fit", fibre, "--set", "wavelength_min_nm=300"}, "exclude_nm");
    const Json result = fitted({fibre, "--set", "wavelength_min_nm=300", "--set", "exclude_nm=[[300,399.9]]"});
    EXPECT_EQ(result["parameters"], fitted({fibre})["parameters"]);
}

TEST_F(UnusedWavelengths, AreNotedByInspect) {
    const Outcome text = run({"inspect", fibre, "--strict"});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_EQ(text.out.find("WARNING"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("note outside_0_1: "), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("a fit from 400 to 700 nm does not see it in the readings that it uses"), std::string::npos)
        << text.out;
}

TEST_F(UnusedWavelengths, MayComeTwice) {
    const Json result = fitted({overlapping, "--column", "3"});
    expect_truth(result);
    put("far.csv", "400,0.2\n450,0.25\n500,0.3\n800,0.4\n550,0.27\n800,0.41\n");
    const Outcome inspected = run({"inspect", "far.csv"});
    EXPECT_EQ(inspected.exit_code, 0) << inspected.err;
    EXPECT_NE(inspected.out.find("note repeated_wavelengths: 1 wavelength is given again, the first 800 nm"),
              std::string::npos)
        << inspected.out;
    put("twice.csv", "400,0.2\n450,0.25\n500,0.3\n550,0.27\n600,0.4\n500,0.31\n");
    expect_refusal({"fit", "twice.csv"},
                   "twice.csv:6: repeats the wavelength 500 nm (line 3 has it already); keep one of the two or average "
                   "them");
    const Outcome twice = run({"inspect", "twice.csv"});
    EXPECT_NE(twice.out.find("WARNING repeated_wavelengths"), std::string::npos) << twice.out;
    EXPECT_NE(run({"convert", "twice.csv"}).out.find("500,0.3\n500,0.31\n"), std::string::npos);
}

TEST_F(UnusedWavelengths, DecideNothingWhateverTheyHold) {
    const Json sound = parameters(skin_with([](int nm) { return nm < 400 ? "9.5,0.5" : "47,0.5"; }));
    for (const std::string outside : {"-74.403,0.5", "1e6,0.5", "0,0", "0.001,-1", "0.2,", ",", "NaN,nan"}) {
        EXPECT_EQ(parameters(skin_with([&](int) { return outside; })), sound) << outside;
    }
    const Json spiked = parameters(skin_with([](int nm) { return nm % 10 == 0 ? "5,0.5" : "900,0.5"; }));
    EXPECT_EQ(spiked, sound);
}

TEST_F(UnusedWavelengths, DoNotFailASpectrumOfAStudy) {
    std::filesystem::copy_file(fibre, folder() / "fibre.txt");
    put("noisy.csv", skin_with([](int nm) { return nm % 10 == 0 ? "-5,0" : "900,-1"; }));
    put_study("study", R"(["fibre.txt", "noisy.csv"])");
    (void)run({"study", "run", "study.json"});
    const Json found = answers("study");
    ASSERT_EQ(found["spectra"].size(), 2U) << found;
    for (const Json& spectrum : found["spectra"]) {
        EXPECT_TRUE(spectrum["status"] == "fitted" || spectrum["status"] == "suspect") << spectrum;
    }
}

TEST_F(UnusedWavelengths, OfTwoSpectraDoNotKeepThemApart) {
    put("sound.csv", skin_with([](int) { return "20,0.5"; }));
    put("noisy.csv", skin_with([](int nm) { return nm % 10 == 0 ? "-900,0" : "900,-1"; }));
    const auto with = [&](const std::string& other) {
        return fitted({fibre, other, "--own", "melanosome_fraction"})["parameters"];
    };
    EXPECT_EQ(with("noisy.csv"), with("sound.csv"));
}

/// Bands at 400 to 700 nm, two at 350 nm and one at 900 nm with noise, with holes and with nothing but holes.
TEST_F(UnusedWavelengths, OfACubeRejectNoPixel) {
    MadeCube cube{.samples = 6, .lines = 4, .bands = 0, .interleave = "bip", .data_type = 4, .more = "wavelength = {"};
    std::vector<double> nm = {350, 350, 900, 910};
    for (int at = 400; at <= 700; at += 10) nm.push_back(at);
    cube.bands = nm.size();
    for (std::size_t i = 0; i < nm.size(); ++i) cube.more += (i == 0 ? "" : ", ") + std::to_string(nm[i]);
    cube.more += "}\nreflectance scale factor = 1\ndata ignore value = -1\n";
    for (std::size_t pixel = 0; pixel < cube.samples * cube.lines; ++pixel) {
        const double shade = 1 - 0.01 * static_cast<double>(pixel);
        for (const double at : nm) {
            const double green = std::exp(-std::pow((at - 545) / 25, 2)) + std::exp(-std::pow((at - 577) / 15, 2));
            const double skin = shade * (0.1 + 0.0012 * (at - 400) - 0.06 * green);
            const double noise = pixel % 2 == 0 ? -70 : 900;
            cube.given.push_back(at == 910 || (at == 900 && pixel % 3 == 0) ? -1 : at < 400 || at > 700 ? noise : skin);
        }
    }
    write_cube(folder() / "arm.hdr", cube);
    const Json mean = fitted({"arm.hdr"});
    EXPECT_EQ(mean["wavelength_nm"].size(), 31U);
    EXPECT_EQ(mean["findings"], Json::array());
    put_study("cubes", R"([{"cube": "arm.hdr"}])");
    (void)run({"study", "run", "cubes.json"});
    const Json status = Json::parse(run({"study", "status", "cubes.json", "--format", "json"}).out);
    EXPECT_EQ(status["pixels"]["rejected"], 0) << status;
    EXPECT_EQ(status["pixels"]["failed"], 0) << status;
    EXPECT_EQ(status["pixels"]["fitted"].get<int>() + status["pixels"]["suspect"].get<int>(), 24) << status;
}

}  // namespace
}  // namespace skinfit::test
