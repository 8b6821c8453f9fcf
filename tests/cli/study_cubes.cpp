#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "measurements/spectral_cube.hpp"
#include "measurements/text_reader.hpp"
#include "tests/cli/study_test.hpp"
#include "tests/measurements/made_cube.hpp"

namespace skinfit::test {
namespace {

/// A cube of skin that is a little darker from pixel to pixel, large enough for several tiles.
class StudyCubes : public StudyTest {
protected:
    static constexpr std::size_t samples = 300;
    static constexpr std::size_t lines = 60;

    void SetUp() override {
        StudyTest::SetUp();
        const Spectrum skin =
            read_spectrum(std::filesystem::path(SKINFIT_SOURCE_DIR) / "measurements/data/ncsu_113.csv");
        constexpr std::size_t every = 8;
        MadeCube cube{.samples = samples, .lines = lines, .bands = 0, .interleave = "bip", .data_type = 4, .more = ""};
        std::vector<double> spectrum;
        std::string wavelengths;
        for (std::size_t i = 0; i < skin.value.size(); i += every) {
            spectrum.push_back(skin.value[i]);
            wavelengths += (wavelengths.empty() ? "" : ", ") + std::to_string(skin.wavelength_nm[i]);
        }
        cube.bands = spectrum.size();
        cube.more = "wavelength = {" + wavelengths + "}\nreflectance scale factor = 1\n";
        for (std::size_t pixel = 0; pixel < samples * lines; ++pixel) {
            const double shade = 1.0 - 0.3 * static_cast<double>(pixel) / (samples * lines);
            for (const double value : spectrum) cube.given.push_back(shade * value);
        }
        write_cube(folder() / "arm.hdr", cube);
    }

    [[nodiscard]] std::string map_bytes(const std::string& name) const {
        return read_file(folder() / name / "maps" / "arm_map.dat");
    }
};

TEST_F(StudyCubes, ACubeBecomesAMapWithPictures) {
    put_study("whole", R"([{"cube": "arm.hdr", "rectangle": "10,5,280,50"}])");
    EXPECT_LE(run({"study", "run", "whole.json"}).exit_code, 1);
    const SpectralCube source(folder() / "arm.hdr");
    const std::string header = read_file(folder() / "whole" / "maps" / "arm_map.hdr");
    EXPECT_NE(header.find("samples = 300"), std::string::npos);
    EXPECT_NE(header.find("melanosome_fraction_sigma"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder() / "whole" / "maps" / "arm_map_melanosome_fraction.png"));
    const Json status = Json::parse(run({"study", "status", "whole.json", "--format", "json"}).out);
    EXPECT_EQ(status["pixels"]["masked"], 300 * 60 - 280 * 50);
    EXPECT_EQ(status["maps"], 1);
    EXPECT_EQ(source.lines(), lines);
}

TEST_F(StudyCubes, KilledItGoesOnAndTheMapIsTheSame) {
    put_study("whole", R"(["spectra.csv", {"cube": "arm.hdr"}])");
    put_study("killed", R"(["spectra.csv", {"cube": "arm.hdr"}])");
    EXPECT_LE(run({"study", "run", "whole.json"}).exit_code, 1);
    int kills = 0;
    for (int milliseconds = 300; true; milliseconds += 700) {
        const StartedProgram program({skinfit_program(), "study", "run", "killed.json"}, folder());
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        program.kill();
        if (program.wait().signal != SIGKILL) break;
        ++kills;
    }
    EXPECT_GT(kills, 0);
    EXPECT_LE(run({"study", "run", "killed.json"}).exit_code, 1);
    Json killed = answers("killed");
    Json whole = answers("whole");
    for (Json* const json : {&killed, &whole}) (*json)["cubes"][0].erase("map");  // a path of its own
    EXPECT_TRUE(killed == whole);
    EXPECT_TRUE(map_bytes("killed") == map_bytes("whole"));
}

TEST_F(StudyCubes, WhatImagesCannotAdjustIsSaid) {
    put("radius.json", R"({"inputs": [{"cube": "arm.hdr"}], "fit": {"free": ["+fibril_radius_nm"]}, "output": "out"})");
    const Outcome outcome = run({"study", "run", "radius.json"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.out.find("arm.hdr: FAILED: free parameter fibril_radius_nm: cannot be adjusted in images (their "
                               "fits use the emulator of one geometry); fix it (\"free\": [\"-fibril_radius_nm\"])"),
              std::string::npos)
        << outcome.out;
}

TEST_F(StudyCubes, AMapThatIsLostIsMadeAgain) {
    put_study("whole", R"([{"cube": "arm.hdr"}])");
    EXPECT_LE(run({"study", "run", "whole.json"}).exit_code, 1);
    const std::string map = map_bytes("whole");
    std::filesystem::remove(folder() / "whole" / "maps" / "arm_map.dat");
    EXPECT_LE(run({"study", "run", "whole.json"}).exit_code, 1);
    EXPECT_TRUE(map_bytes("whole") == map);
}

TEST_F(StudyCubes, AFailingGnuplotCostsThePicturesAlone) {
    put_study("whole", R"([{"cube": "arm.hdr"}])");
    put_study("undrawn", R"([{"cube": "arm.hdr"}])");
    EXPECT_LE(run({"study", "run", "whole.json"}).exit_code, 1);
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", "/nowhere", 1);
    expect_refusal({"study", "run", "undrawn.json"}, "gnuplot cannot be run");
    put("gnuplot", "#!/bin/sh\nexit 1\n");
    std::filesystem::permissions(folder() / "gnuplot", std::filesystem::perms{0700});
    ::setenv("PATH", folder().c_str(), 1);
    const Outcome undrawn = run({"study", "run", "undrawn.json"});
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(undrawn.exit_code, 1);
    EXPECT_NE(undrawn.err.find("the map of arm.hdr is written, its pictures are not (plot: gnuplot failed"),
              std::string::npos)
        << undrawn.err;
    EXPECT_TRUE(map_bytes("undrawn") == map_bytes("whole"));
    EXPECT_LE(run({"study", "run", "undrawn.json"}).exit_code, 1);
    EXPECT_TRUE(std::filesystem::exists(folder() / "undrawn" / "maps" / "arm_map_status.png"));
}

TEST_F(StudyCubes, ACubeThatCannotBeReadStopsNothing) {
    put("broken.hdr", "ENVI\nsamples = 3\n");
    put_study("mixed", R"(["spectra.csv", {"cube": ["broken.hdr", "arm.hdr"]}])");
    const Outcome outcome = run({"study", "run", "mixed.json"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.out.find("broken.hdr: FAILED: "), std::string::npos) << outcome.out;
    const Json status = Json::parse(run({"study", "status", "mixed.json", "--format", "json"}).out);
    EXPECT_EQ(status["maps"], 1);
    EXPECT_EQ(status["pending"], 0);
}

}  // namespace
}  // namespace skinfit::test
