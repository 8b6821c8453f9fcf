#include <fcntl.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>

#include <array>
#include <cstring>
#include <map>
#include <thread>

#include "core/json.hpp"
#include "tests/cli/study_test.hpp"
#include "tests/measurements/made_cube.hpp"

/// Each input is opened once, whatever is made of it, as the kernel counts.
namespace skinfit::test {
namespace {

const std::string specimen = SKINFIT_SOURCE_DIR "/measurements/data/ncsu_113.csv";
const std::string instrument = SKINFIT_SOURCE_DIR "/configs/instruments/ncsu_45_0.json";

using Opens = std::map<std::string, int>;

/// How often files of `folder` are opened while `work` is done.
template <class Work>
Opens opens_in(const std::filesystem::path& folder, Work work) {
    const int watcher = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    EXPECT_GE(::inotify_add_watch(watcher, folder.c_str(), IN_OPEN), 0);
    work();
    Opens opens;
    alignas(inotify_event) std::array<char, std::size_t{1} << 16U> buffer{};
    for (;;) {
        const ssize_t bytes = ::read(watcher, buffer.data(), buffer.size());
        if (bytes <= 0) break;
        for (const char* at = buffer.data(); at < buffer.data() + bytes;) {
            inotify_event event{};
            std::memcpy(&event, at, sizeof event);
            EXPECT_EQ(event.mask & IN_Q_OVERFLOW, 0U);
            if (event.len > 0) ++opens[at + sizeof event];
            at += sizeof event + event.len;
        }
    }
    ::close(watcher);
    return opens;
}

/// The inputs lie in a folder of their own, the outputs elsewhere.
class OneReading : public StudyTest {
protected:
    void SetUp() override {
        StudyTest::SetUp();
        std::filesystem::create_directory(folder() / "inputs");
        std::filesystem::copy_file(specimen, folder() / "inputs/skin.csv");
        std::filesystem::copy_file(instrument, folder() / "inputs/instrument.json");
        put("inputs/config.json", R"({"instrument": "inputs/instrument.json", "engine": "solver", "starts": 2})");
        put("inputs/two.csv",
            "wavelength_nm,first,second\n400,0.2,0.21\n450,0.25,0.24\n500,0.3,0.31\n550,0.28,0.27\n"
            "600,0.4,0.42\n650,0.45,0.44\n700,0.5,0.48\n");
    }

    /// Runs the program and counts what it opens of the inputs.
    [[nodiscard]] Opens opens_of(const std::vector<std::string>& arguments) const {
        return opens_in(folder() / "inputs", [&] {
            const Outcome outcome = run(arguments);
            EXPECT_LE(outcome.exit_code, 1) << outcome.err;
            EXPECT_GE(outcome.exit_code, 0) << outcome.err;
        });
    }
};

TEST_F(OneReading, OfEachInputByAFitAndAllItsReports) {
    const Opens once = {{"skin.csv", 1}, {"config.json", 1}, {"instrument.json", 1}};
    const std::vector<std::string> fit = {"fit", "inputs/skin.csv", "--config", "inputs/config.json"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = fit;
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    };
    EXPECT_EQ(opens_of(fit), once);
    EXPECT_EQ(opens_of(with({"--format", "json", "--out", "a.json", "--report", "a.html", "--plot", "a.svg",
                             "--cross-check", "--uncertainty", "profile"})),
              once);
    EXPECT_EQ(opens_of(with({"inputs/two.csv", "--column", "1", "--column", "2", "--own", "melanosome_fraction"})),
              (Opens{{"skin.csv", 1}, {"two.csv", 1}, {"config.json", 1}, {"instrument.json", 1}}));
    EXPECT_EQ(opens_of({"fit", "inputs/two.csv", "--column", "1", "--column", "2", "--config", "inputs/config.json"}),
              (Opens{{"two.csv", 1}, {"config.json", 1}, {"instrument.json", 1}}));
}

TEST_F(OneReading, ByTheOtherCommands) {
    EXPECT_EQ(opens_of({"inspect", "inputs/skin.csv", "--plot", "a.svg"}), (Opens{{"skin.csv", 1}}));
    EXPECT_EQ(opens_of({"convert", "inputs/two.csv", "--column", "1", "--column", "2", "--out", "a.json"}),
              (Opens{{"two.csv", 1}}));
    for (const std::string command : {"simulate", "sensitivity"}) {
        EXPECT_EQ(opens_of({command, "--config", "inputs/config.json", "--out", "a.csv"}),
                  (Opens{{"config.json", 1}, {"instrument.json", 1}}))
            << command;
    }
}

TEST_F(OneReading, ByAStudy) {
    std::filesystem::rename(folder() / "spectra.csv", folder() / "inputs/spectra.csv");
    put("inputs/manifest.csv", "file,spectrum,subject\nskin.csv,,a\n");
    put("inputs/study.json", R"({"inputs": ["spectra.csv", {"manifest": "manifest.csv"}], "fit": "config.json",
 "output": "../out"})");
    put("inputs/config.json", R"({"instrument": "inputs/instrument.json", "engine": "solver", "starts": 2})");
    EXPECT_EQ(opens_of({"study", "run", "inputs/study.json", "--threads", "2"}), (Opens{{"study.json", 1},
                                                                                        {"manifest.csv", 1},
                                                                                        {"spectra.csv", 1},
                                                                                        {"skin.csv", 1},
                                                                                        {"config.json", 1},
                                                                                        {"instrument.json", 1}}));
}

/// The data of a cube are too many to be kept: they are opened for each part, the header is read once.
TEST_F(OneReading, OfTheHeaderOfACube) {
    MadeCube cube{.samples = 3, .lines = 2, .bands = 8, .interleave = "bip", .data_type = 4, .more = ""};
    cube.more = "wavelength = {400, 450, 500, 550, 600, 640, 670, 700}\nreflectance scale factor = 1\n";
    for (std::size_t pixel = 0; pixel < cube.samples * cube.lines; ++pixel) {
        for (const double value : {0.2, 0.25, 0.3, 0.28, 0.4, 0.44, 0.46, 0.5}) {
            cube.given.push_back(value * (1 - 0.01 * static_cast<double>(pixel)));
        }
    }
    write_cube(folder() / "inputs/arm.hdr", cube);
    for (const std::string name : {"inputs/arm.hdr", "inputs/arm.dat"}) {
        EXPECT_EQ(opens_of({"fit", name, "--set", "engine=emulator", "--out", "a.txt"})["arm.hdr"], 1) << name;
        EXPECT_EQ(opens_of({"inspect", name})["arm.hdr"], 1) << name;
    }
    put_study("cubes", R"([{"cube": "inputs/arm.hdr"}])");
    EXPECT_EQ(opens_of({"study", "run", "cubes.json"})["arm.hdr"], 1);
}

/// Runs a line of the shell, in which `skinfit` is the program.
Outcome shell(const std::string& line, const std::filesystem::path& folder) {
    return StartedProgram({"bash", "-c", "skinfit() { " + skinfit_program() + " \"$@\"; }; " + line}, folder).wait();
}

TEST_F(OneReading, IsEnoughForPipes) {
    const std::string named = "skinfit fit inputs/skin.csv --config inputs/config.json --format json";
    const std::string piped =
        "skinfit fit <(cat inputs/skin.csv) --config <(sed s,inputs/instrument.json,$(echo /dev/fd/9), "
        "inputs/config.json) --format json --report a.html --cross-check 9< <(cat inputs/instrument.json)";
    const Outcome by_name = shell(named, folder());
    const Outcome by_pipe = shell(piped, folder());
    ASSERT_LE(by_pipe.exit_code, 1) << by_pipe.err;
    EXPECT_EQ(by_pipe.exit_code, by_name.exit_code);
    EXPECT_EQ(Json::parse(by_pipe.out)["parameters"], Json::parse(by_name.out)["parameters"]);
    for (const std::string command : {"inspect", "convert"}) {
        const Outcome outcome = shell("skinfit " + command + " <(cat inputs/skin.csv)", folder());
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    EXPECT_EQ(shell("skinfit config check <(echo '{}')", folder()).exit_code, 0);
    EXPECT_EQ(shell("skinfit inspect <(sleep 6; cat inputs/skin.csv)", folder()).exit_code, 0) << "slow, but there";
    EXPECT_EQ(shell("skinfit inspect /dev/stdin < inputs/skin.csv", folder()).exit_code, 0);
}

TEST_F(OneReading, OfANamedPipeThatIsServedOnce) {
    const std::filesystem::path pipe = folder() / "pipe.csv";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::jthread writer([&] {
        const std::string text = read_file(specimen);
        const int descriptor = ::open(pipe.c_str(), O_WRONLY | O_CLOEXEC);
        EXPECT_EQ(::write(descriptor, text.data(), text.size()), static_cast<ssize_t>(text.size()));
        ::close(descriptor);
    });
    const Outcome outcome = run({"fit", "pipe.csv", "--set", "engine=emulator", "--report", "a.html"});
    EXPECT_LE(outcome.exit_code, 1) << outcome.err;
    EXPECT_GE(outcome.exit_code, 0);
}

/// What is edited while the fit runs changes neither the fit nor its report.
TEST_F(OneReading, HoldsWhateverIsEditedMeanwhile) {
    const std::vector<std::string> fit = {"fit",   "inputs/skin.csv", "--config", "inputs/config.json", "--format",
                                          "json",  "--report",        "a.html",   "--uncertainty",      "profile",
                                          "--set", "starts=1"};
    const Json before = Json::parse(run(fit).out);
    std::vector<std::string> words = {skinfit_program()};
    words.insert(words.end(), fit.begin(), fit.end());
    const int watcher = ::inotify_init1(IN_CLOEXEC);
    ASSERT_GE(::inotify_add_watch(watcher, (folder() / "inputs").c_str(), IN_CLOSE_NOWRITE), 0);
    const StartedProgram program(words, folder());
    // Once the spectrum has been read, which comes last, everything is spoilt.
    for (bool is_read = false; !is_read;) {
        alignas(inotify_event) std::array<char, 4096> buffer{};
        pollfd waiting{.fd = watcher, .events = POLLIN, .revents = 0};
        ASSERT_EQ(::poll(&waiting, 1, 60'000), 1);
        const ssize_t bytes = ::read(watcher, buffer.data(), buffer.size());
        is_read = std::string(buffer.data(), static_cast<std::size_t>(bytes)).find("skin.csv") != std::string::npos;
    }
    for (const std::string name : {"skin.csv", "config.json", "instrument.json"}) put("inputs/" + name, "spoilt");
    ::close(watcher);
    const Outcome outcome = program.wait();
    ASSERT_LE(outcome.exit_code, 1) << outcome.err;
    const Json after = Json::parse(outcome.out);
    EXPECT_EQ(after["parameters"], before["parameters"]);
    EXPECT_EQ(after["configuration"], before["configuration"]);
}

}  // namespace
}  // namespace skinfit::test
