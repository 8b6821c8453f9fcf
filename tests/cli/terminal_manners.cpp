#include <csignal>
#include <cstdlib>

#include "tests/cli/cli_test.hpp"
#include "tests/cli/terminal_run.hpp"

namespace skinfit::test {
namespace {

const std::string specimen = SKINFIT_SOURCE_DIR "/measurements/data/ncsu_113.csv";

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Of a terminal that knows colours, with no wish against them.
class TerminalManners : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        ::setenv("TERM", "xterm-256color", 1);
        ::unsetenv("NO_COLOR");
    }
    /// Some seconds of work.
    const std::vector<std::string> slow = {"simulate", "--engine", "walk", "--rays", "400000", "--threads", "1"};
    const std::vector<std::string> endless = {"simulate", "--engine", "walk", "--rays", "100000000"};
    const std::vector<std::string> fit = {"fit", specimen, "--set", "preset=paper", "--set", "engine=emulator"};
    static constexpr const char* colour = "\x1b[3";
    static constexpr const char* bar = "[#";
};

TEST_F(TerminalManners, TheVerdictIsColouredOnATerminalOnly) {
    EXPECT_TRUE(holds(run_on_terminal(fit, folder()).out, "verdict: \x1b[31mSUSPECT\x1b[0m"));
    const Outcome captured = run(fit);
    EXPECT_TRUE(holds(captured.out, "verdict: SUSPECT\n")) << captured.out;
    EXPECT_FALSE(holds(captured.out, "\x1b"));
}

TEST_F(TerminalManners, NoColorIsHeeded) {
    ::setenv("NO_COLOR", "1", 1);
    EXPECT_TRUE(holds(run_on_terminal(fit, folder()).out, "verdict: SUSPECT\r\n"));
    const Outcome refused = run_on_terminal({"fit", "missing.csv"}, folder());
    EXPECT_TRUE(holds(refused.out, "error: missing.csv: cannot be read")) << refused.out;
    EXPECT_FALSE(holds(refused.out, colour));
    ::unsetenv("NO_COLOR");
    EXPECT_TRUE(holds(run_on_terminal({"fit", "missing.csv"}, folder()).out, colour));
    ::setenv("TERM", "dumb", 1);
    EXPECT_FALSE(holds(run_on_terminal({"fit", "missing.csv"}, folder()).out, "\x1b"));
}

TEST_F(TerminalManners, WhatTakesSecondsShowsABarAndTakesItAway) {
    const Outcome outcome = run_on_terminal(slow, folder());
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(holds(outcome.out, bar)) << outcome.out;
    EXPECT_TRUE(holds(outcome.out, " left"));
    // The result stands on lines of its own.
    EXPECT_TRUE(holds(outcome.out, "\r\x1b[K# ")) << outcome.out;
}

TEST_F(TerminalManners, WhatIsQuickOrQuietShowsNone) {
    EXPECT_FALSE(holds(run_on_terminal({"simulate", "--rays", "1000"}, folder()).out, "\x1b"));
    std::vector<std::string> quiet = slow;
    quiet.emplace_back("--quiet");
    EXPECT_FALSE(holds(run_on_terminal(quiet, folder()).out, "\x1b"));
    EXPECT_EQ(run(slow).err, "");
}

TEST_F(TerminalManners, MessagesThatCannotBeWrittenDoNotChangeTheExitCode) {
    for (const char* stderr_goes : {"2>&-", "2>/dev/full", "<&- >&- 2>&-"}) {
        const Outcome outcome =
            StartedProgram({"bash", "-c", skinfit_program() + " fit missing.csv " + stderr_goes}, folder()).wait();
        EXPECT_EQ(outcome.exit_code, 2) << stderr_goes;
    }
}

TEST_F(TerminalManners, AClosedTerminalStopsAFitThatStillKeepsItsResult) {
    const Outcome outcome = run_on_terminal({"fit", specimen, "--set", "engine=solver", "--set", "starts=1",
                                             "--uncertainty", "posterior", "--threads", "1", "--out", "fit.txt"},
                                            folder(), "estimating the uncertainty", At::close);
    EXPECT_EQ(outcome.signal, 0);
    EXPECT_EQ(outcome.exit_code, 128 + SIGHUP);
    EXPECT_TRUE(holds(read_file(folder() / "fit.txt"), "INTERRUPTED"));
}

TEST_F(TerminalManners, CtrlCEndsACommandAndSaysWhatIsLost) {
    std::vector<std::string> arguments = endless;
    arguments.insert(arguments.end(), {"--out", "skin.csv"});
    const Outcome outcome = run_on_terminal(arguments, folder(), "following rays");
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_TRUE(holds(outcome.out, "interrupted; what was not written yet is lost")) << outcome.out;
    EXPECT_TRUE(std::filesystem::is_empty(folder()));
}

TEST_F(TerminalManners, CtrlCEndsAFitWithoutAResult) {
    const Outcome outcome = run_on_terminal(
        {"fit", specimen, "--set", "engine=solver", "--out", "fit.txt", "--set", "starts=100", "--threads", "1"},
        folder(), "[");
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_TRUE(holds(outcome.out, "interrupted; there is no result yet, and nothing was written")) << outcome.out;
    EXPECT_TRUE(std::filesystem::is_empty(folder()));
}

TEST_F(TerminalManners, CtrlCKeepsAFitWhoseIntervalsAreNotFinished) {
    const Outcome outcome = run_on_terminal({"fit", specimen, "--set", "engine=solver", "--set", "starts=1",
                                             "--uncertainty", "posterior", "--samples", "draws.csv", "--threads", "1"},
                                            folder(), "estimating the uncertainty");
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_TRUE(holds(outcome.out, "INTERRUPTED")) << outcome.out;
    EXPECT_TRUE(holds(outcome.out, "intervals: covariance")) << outcome.out;
    EXPECT_TRUE(holds(outcome.out, "draws.csv: not written")) << outcome.out;
}

TEST_F(TerminalManners, CtrlCKeepsWhatAValidationHasDone) {
    const Outcome outcome = run_on_terminal({"validate", "inverse", "--spectra", "100000", "--intervals", "covariance"},
                                            folder(), " spectra/s");
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_TRUE(holds(outcome.out, "of 100000 spectra asked for only these")) << outcome.out;
    EXPECT_TRUE(std::filesystem::exists(folder() / "inverse_validation" / "recovery.csv"));
}

}  // namespace
}  // namespace skinfit::test
