#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <set>
#include <thread>

#include "core/file_replacement.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Arguments = std::vector<std::string>;
using Codes = std::set<int>;

const std::string specimen = SKINFIT_SOURCE_DIR "/measurements/data/ncsu_113.csv";

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Full disks, limits of the shell, signals, links, and a gnuplot that fails.
class HostileSurroundings : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        ::setenv("SKINFIT_CACHE_DIR", cache().c_str(), 1);
        path_ = std::getenv("PATH");
    }
    void TearDown() override {
        ::setenv("PATH", path_.c_str(), 1);
        CliTest::TearDown();
    }

    /// A shell script in place of gnuplot, outside the folder of the test.
    void put_gnuplot(const std::string& script) const {
        const fs::path tools = folder().parent_path() / "tools";
        fs::create_directories(tools);
        write_file_atomically(tools / "gnuplot", "#!/bin/sh\n" + script + "\n");
        fs::permissions(tools / "gnuplot", fs::perms{0700});
        ::setenv("PATH", (tools.string() + ":" + path_).c_str(), 1);
    }
    /// No program at all is found.
    static void take_gnuplot_away() { ::setenv("PATH", "/nowhere", 1); }

    /// Run by a shell that first does `before`, such as setting a limit.
    [[nodiscard]] Outcome run_after(const std::string& before, const Arguments& arguments) const {
        Arguments words = {"/bin/bash", "-c", before + R"(; exec "$0" "$@")", skinfit_program()};
        words.insert(words.end(), arguments.begin(), arguments.end());
        return StartedProgram(words, folder()).wait();
    }
    [[nodiscard]] fs::path cache() const { return folder().parent_path() / "cache"; }
    [[nodiscard]] int half_written() const {
        int count = 0;
        if (!fs::exists(cache())) return count;
        for (const auto& entry : fs::directory_iterator(cache())) count += is_partial(entry.path()) ? 1 : 0;
        return count;
    }
    [[nodiscard]] static std::size_t files_in(const fs::path& path) {
        if (!fs::exists(path)) return 0;
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), {}));
    }

    const Arguments fit = {"fit", specimen, "--set", "engine=emulator"};
    const Arguments quick = {"simulate", "--wavelengths", "400:700:5", "--engine", "solver"};

    static Arguments joined(Arguments first, const Arguments& second) {
        first.insert(first.end(), second.begin(), second.end());
        return first;
    }

private:
    std::string path_;
};

TEST_F(HostileSurroundings, WithoutGnuplotPicturesAreRefusedBeforeTheWork) {
    take_gnuplot_away();
    put("study.json", R"({"inputs": ["x.csv"], "output": "out"})");
    for (const Arguments& arguments :
         {joined(fit, {"--plot", "a.png"}), joined(fit, {"--report", "a.html"}),
          Arguments{"inspect", specimen, "--plot", "a.svg"}, Arguments{"sensitivity", "--plot", "a.svg"},
          Arguments{"validate", "forward", "--output", "."}, Arguments{"validate", "inverse", "--output", "."},
          Arguments{"bench", "--scaling", "."}}) {
        expect_refusal(arguments, "gnuplot cannot be run (No such file or directory)");
    }
    EXPECT_EQ(files_in(cache()), 0U);
    EXPECT_LE(run(fit).exit_code, 1) << "what draws nothing needs none";
}

TEST_F(HostileSurroundings, AFailingGnuplotCostsThePictureAlone) {
    const Outcome plain = run(fit);
    put_gnuplot("echo 'no such font' >&2; exit 1");
    const Outcome drawn = run(joined(fit, {"--plot", "a.png", "--report", "a.html"}));
    EXPECT_EQ(drawn.out, plain.out);
    EXPECT_EQ(drawn.exit_code, 1);
    EXPECT_TRUE(holds(drawn.err, "warning: a.png: not written: plot: gnuplot failed (no such font)")) << drawn.err;
    EXPECT_TRUE(holds(drawn.err, "warning: a.html: not written: plot: gnuplot failed (no such font)")) << drawn.err;
    EXPECT_FALSE(holds(drawn.err, "nothing was written"));
    const Outcome written = run(joined(fit, {"--plot", "a.png", "--out", "fit.txt"}));
    EXPECT_EQ(written.exit_code, 1);
    EXPECT_EQ(read_file(folder() / "fit.txt"), plain.out);
    // A result without a doubt, and a picture that is missing, are 1 too.
    const Outcome sensitivity = run({"sensitivity", "--wavelengths", "500,600", "--plot", "a.svg"});
    EXPECT_EQ(sensitivity.exit_code, 1);
    EXPECT_TRUE(holds(sensitivity.out, "500,")) << sensitivity.out;
    const Outcome inspected = run({"inspect", specimen, "--plot", "a.svg"});
    EXPECT_EQ(inspected.exit_code, 1);
    EXPECT_FALSE(inspected.out.empty());
    const Outcome figures = run({"validate", "forward", "--figures", "4", "--output", "figures"});
    EXPECT_EQ(figures.exit_code, 1) << figures.err;
    EXPECT_TRUE(fs::exists(folder() / "figures" / "summary.json"));
    EXPECT_TRUE(fs::exists(folder() / "figures" / "figure_4.csv"));
}

TEST_F(HostileSurroundings, OneSignalEndsAHangingPictureAndKeepsTheResult) {
    const Outcome plain = run(fit);
    const fs::path mark = folder().parent_path() / "hangs";
    // Moved there whole: a mark that is seen has its number.
    const std::string written = mark.string() + ".new";
    put_gnuplot("echo $$ > " + written + "; mv " + written + " " + mark.string() + "; sleep 1000");
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        fs::remove(mark);
        const StartedProgram program(
            joined({skinfit_program()}, joined(fit, {"--report", "a.html", "--plot", "a.png", "--out", "fit.txt"})),
            folder());
        while (!fs::exists(mark)) std::this_thread::sleep_for(1ms);
        program.send(signal);
        const Outcome outcome = program.wait();
        EXPECT_EQ(outcome.exit_code, 128 + signal);
        EXPECT_EQ(read_file(folder() / "fit.txt"), plain.out);
        EXPECT_TRUE(holds(outcome.err, "warning: a.html: not written")) << outcome.err;
        EXPECT_TRUE(holds(outcome.err, "warning: a.png: not written")) << outcome.err;
        EXPECT_EQ(files_in(folder()), 1U);
        EXPECT_NE(::kill(std::stoi(read_file(mark)), 0), 0) << "gnuplot still runs";
    }
}

TEST_F(HostileSurroundings, AResultThatCannotBeWrittenIsShown) {
    const Outcome plain = run(quick);
    const Outcome limited = run_after("ulimit -f 1", joined(quick, {"--out", "skin.csv"}));
    EXPECT_EQ(limited.exit_code, 2);
    EXPECT_EQ(limited.signal, 0);
    EXPECT_TRUE(holds(limited.err, "error: skin.csv: cannot be written (File too large)")) << limited.err;
    // The captured output lies in a file of the same limit.
    EXPECT_TRUE(plain.out.starts_with(limited.out) && limited.out.size() >= 1024) << limited.out;
    EXPECT_EQ(files_in(folder()), 0U);
    const Outcome full = run(joined(fit, {"--out", "/dev/full", "--plot", "a.svg"}));
    EXPECT_EQ(full.exit_code, 2);
    EXPECT_EQ(full.out, run(fit).out);
    EXPECT_TRUE(fs::exists(folder() / "a.svg"));
}

TEST_F(HostileSurroundings, LimitsOfTheShellAreAnsweredInWords) {
    const Outcome plain = run(quick);
    for (const char* const stack : {"ulimit -s 64", "ulimit -s 256"}) {
        for (const Arguments& arguments :
             {quick, Arguments{"fit", specimen, "--set", "engine=solver", "--set", "starts=2"},
              Arguments{"inspect", specimen}, Arguments{"--help"}}) {
            const Outcome outcome = run_after(stack, arguments);
            EXPECT_EQ(outcome.signal, 0) << stack << " " << arguments.front() << outcome.err;
            EXPECT_LE(outcome.exit_code, 1) << stack << " " << arguments.front() << outcome.err;
        }
        EXPECT_EQ(run_after(stack, quick).out, plain.out);
    }
    const Outcome slow = run_after("ulimit -S -t 1", {"simulate", "--engine", "walk", "--rays", "100000000"});
    EXPECT_EQ(slow.exit_code, 128 + SIGXCPU);
    EXPECT_TRUE(holds(slow.err, "interrupted; ")) << slow.err;
}

TEST_F(HostileSurroundings, LinksAreNeitherFollowedNorReplaced) {
    put("victim", "kept");
    fs::create_symlink("victim", folder() / "link.csv");
    fs::create_symlink("victim", folder() / "link.svg");
    expect_refusal(joined(quick, {"--out", "link.csv"}), "link.csv: cannot be written (it is a link");
    expect_refusal(joined(fit, {"--samples", "link.csv", "--uncertainty", "posterior"}), "it is a link");
    expect_refusal(joined(fit, {"--report", "link.csv"}), "it is a link");
    expect_refusal(joined(fit, {"--plot", "link.svg"}), "it is a link");
    expect_refusal({"sensitivity", "--plot", "link.svg"}, "it is a link");
    expect_refusal({"inspect", specimen, "--plot", "link.svg"}, "it is a link");
    expect_refusal({"convert", specimen, "--out", "link.csv"}, "it is a link");
    expect_refusal({"bench", "--out", "link.csv"}, "it is a link");
    EXPECT_TRUE(fs::is_symlink(folder() / "link.csv") && fs::is_symlink(folder() / "link.svg"));
    EXPECT_EQ(read_file(folder() / "victim"), "kept");
}

TEST_F(HostileSurroundings, AFileKeepsItsPermissions) {
    put("skin.csv", "old");
    fs::permissions(folder() / "skin.csv", fs::perms{0600});
    EXPECT_EQ(run(joined(quick, {"--out", "skin.csv"})).exit_code, 0);
    EXPECT_EQ(fs::status(folder() / "skin.csv").permissions(), fs::perms{0600});
}

TEST_F(HostileSurroundings, SignalsLeaveNothingHalfWrittenInTheCache) {
    int seed = 1;
    // Ends a recording as soon as it is being written.
    const auto hit_while_it_writes = [&](int signal) {
        const StartedProgram program({skinfit_program(), "simulate", "--rays", "20000", "--wavelengths", "400:700:5",
                                      "--seed", std::to_string(++seed)},
                                     folder());
        while (files_in(cache()) == 0) std::this_thread::sleep_for(100us);
        program.send(signal);
        const Outcome outcome = program.wait();
        return outcome.signal != 0 ? outcome.signal : outcome.exit_code;
    };
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        EXPECT_TRUE((Codes{0, 128 + signal}).contains(hit_while_it_writes(signal)));
        EXPECT_EQ(half_written(), 0);
        fs::remove_all(cache());
    }
    constexpr int most_tries = 20;  // one may just have ended
    for (int i = 0; i < most_tries && half_written() == 0; ++i) {
        fs::remove_all(cache());
        (void)hit_while_it_writes(SIGKILL);
    }
    EXPECT_EQ(half_written(), 1);
    EXPECT_EQ(run({"simulate", "--rays", "1000", "--wavelengths", "500"}).exit_code, 0);
    EXPECT_EQ(half_written(), 0);
}

TEST_F(HostileSurroundings, APipeInTheCacheHangsNothing) {
    const Arguments record = {"simulate", "--rays", "1000", "--wavelengths", "500"};
    const Outcome plain = run(record);
    const fs::path file = fs::directory_iterator(cache())->path();
    fs::remove(file);
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    const Outcome outcome = run(record);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out, plain.out);
    EXPECT_TRUE(holds(outcome.err, "no ordinary file")) << outcome.err;
}

}  // namespace
}  // namespace skinfit::test
