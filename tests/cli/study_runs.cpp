#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "core/text.hpp"
#include "tests/cli/study_test.hpp"

namespace skinfit::test {
namespace {

class StudyRuns : public StudyTest {
protected:
    void run_to_its_end(const std::string& name, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments = {"study", "run", name + ".json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        ASSERT_LE(outcome.exit_code, 1) << outcome.err;
    }

    [[nodiscard]] Json status(const std::string& name) const {
        return Json::parse(run({"study", "status", name + ".json", "--format", "json"}).out);
    }

    [[nodiscard]] StartedProgram started(const std::string& name) const {
        return StartedProgram({skinfit_program(), "study", "run", name + ".json", "--threads", "1"}, folder());
    }
};

void sleep_ms(int milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

TEST_F(StudyRuns, EverySpectrumHasAnAnswer) {
    put_study("whole", R"(["spectra.csv"])");
    run_to_its_end("whole");
    const Json counts = status("whole");
    EXPECT_EQ(counts["pending"], 0);
    EXPECT_EQ(counts["fitted"].get<int>() + counts["suspect"].get<int>(), spectra);
}

TEST_F(StudyRuns, QuestionsThatTheFitsCannotAnswerAreRefused) {
    put_study("held", R"(["spectra.csv"])",
              R"("indicators": [{"name": "dim", "parameter": "scale", "below": 1, "source": "the example"}])");
    expect_refusal({"study", "run", "held.json"},
                   "held.json: indicator dim: scale is not adjusted by the fits (they hold it at one value, and say "
                   "nothing about it)");
    put_study("whole", R"(["spectra.csv"])");
    run_to_its_end("whole");
    const auto power_of = [](const std::string& quantity) {
        return std::vector<std::string>{"study", "power", "whole.json", "--quantity", quantity};
    };
    expect_refusal(power_of("bilirubin"), "did you mean \"bilirubin_g_per_l\"?");
    expect_refusal(power_of("scale"), "scale is not adjusted by the fits");
    std::vector<std::string> repeats = power_of("erythema_index");
    EXPECT_NE(run(repeats).out.find("that of repeats is unknown"), std::string::npos);
    repeats.insert(repeats.end(), {"--repeats", "3"});
    expect_refusal(repeats, "--repeats: 3 cannot be reckoned with");
}

TEST_F(StudyRuns, AnswersAreThoseOfFit) {
    put_study("whole", R"(["spectra.csv"])");
    run_to_its_end("whole");
    const Json third = answers("whole")["spectra"][2];
    const Outcome fit = run({"fit", "spectra.csv", "--column", "s3", "--set", "noise=0.01", "--set", "engine=emulator",
                             "--format", "json"});
    const Json alone = Json::parse(fit.out);
    EXPECT_EQ(third["chi2"], alone["chi2"]);
    EXPECT_EQ(third["verdict"], alone["verdict"]);
    for (const Json& each : third["parameters"]) {
        const Json& same = alone["parameters"][each["name"].get<std::string>()];
        EXPECT_EQ(each["value"], same["value"]) << each["name"];
        EXPECT_EQ(each["sigma"], same["sigma"]) << each["name"];
        EXPECT_EQ(each["interval_95"], same["interval_95"]) << each["name"];
    }
}

TEST_F(StudyRuns, ThreadsDoNotMatter) {
    put_study("one", R"(["spectra.csv"])");
    put_study("three", R"(["spectra.csv"])");
    run_to_its_end("one", {"--jobs", "1"});
    run_to_its_end("three", {"--threads", "3"});
    EXPECT_TRUE(answers("one") == answers("three"));
}

TEST_F(StudyRuns, KilledAtAnyMomentItGoesOnWhereItWas) {
    put_study("whole", R"(["spectra.csv"])");
    run_to_its_end("whole");
    const Json expected = answers("whole");
    std::mt19937 random(1);
    constexpr int rounds = 5;
    int kills = 0;
    for (int round = 0; round < rounds; ++round) {
        const std::string name = fmt::format("killed_{}", round);
        put_study(name, R"(["spectra.csv"])");
        for (int milliseconds = 20; true; milliseconds += 100) {
            const StartedProgram program = started(name);
            sleep_ms(milliseconds + static_cast<int>(random() % 100));
            program.kill();
            if (program.wait().signal != SIGKILL) break;  // it had ended before
            ++kills;
        }
        run_to_its_end(name);
        EXPECT_TRUE(answers(name) == expected) << name;
    }
    EXPECT_GT(kills, rounds);
}

TEST_F(StudyRuns, FinishedWorkIsNotRepeated) {
    put_study("whole", R"(["spectra.csv"])");
    run_to_its_end("whole");
    const Outcome exported = run({"study", "export", "whole.json"});
    run_to_its_end("whole");
    EXPECT_EQ(run({"study", "export", "whole.json"}).out, exported.out);  // seconds too
}

TEST_F(StudyRuns, ChangedInputsAndSettingsAreFittedAgain) {
    put_study("whole", R"(["spectra.csv"])");
    run_to_its_end("whole");
    std::string text = spectra_text(spectra);
    text.replace(text.find("\ns2,"), 4, "\ns2,0.5,");  // shifts the values of one row
    const std::size_t row_end = text.find('\n', text.find("\ns2,") + 1);
    text.erase(text.rfind(',', row_end), row_end - text.rfind(',', row_end));
    put("spectra.csv", text);
    const Outcome again = run({"study", "run", "whole.json"});
    EXPECT_NE(again.err.find("1 spectra have changed"), std::string::npos) << again.err;
    put("whole.json", R"({"inputs": ["spectra.csv"], "fit": {"noise": 0.02}, "output": "whole"})");
    const Outcome other = run({"study", "run", "whole.json"});
    EXPECT_NE(other.err.find(fmt::format("settings have changed: {} spectra", spectra)), std::string::npos)
        << other.err;
}

TEST_F(StudyRuns, TheReportSaysWhichNoiseWasTaken) {
    put("stated.json", R"({"inputs": ["spectra.csv"], "fit": {"noise": 0.02}, "output": "stated"})");
    put("bare.json", R"({"inputs": ["spectra.csv"], "output": "bare"})");
    for (const auto& [name, noise] : {std::pair("stated", "as the files state it, else 0.02<"),
                                      std::pair("bare", "as the files state it, else 0.003<")}) {
        const std::string file = fmt::format("{}.json", name);
        EXPECT_LE(run({"study", "run", file}).exit_code, 1);
        EXPECT_LE(run({"study", "report", file}).exit_code, 1);
        const std::string page = read_file(folder() / name / "report.html");
        EXPECT_NE(page.find(fmt::format("<dt>noise</dt><dd>{}", noise)), std::string::npos) << name;
    }
}

TEST_F(StudyRuns, ASecondRunOfTheSameStudyIsRefused) {
    put_study("whole", R"(["spectra.csv"])");
    const StartedProgram first = started("whole");
    Outcome second{};
    // As soon as the first has its ledger.
    while (!std::filesystem::exists(folder() / "whole" / "ledger.sqlite")) sleep_ms(1);
    second = run({"study", "run", "whole.json"});
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_NE(second.err.find("is in use"), std::string::npos) << second.err;
    EXPECT_LE(first.wait().exit_code, 1);
}

TEST_F(StudyRuns, InterruptedItStoresWhatHasBegun) {
    put_study("whole", R"(["spectra.csv"])");
    const StartedProgram program = started("whole");
    while (!std::filesystem::exists(folder() / "whole" / "ledger.sqlite-wal")) sleep_ms(1);
    sleep_ms(50);
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.signal, 0);
    EXPECT_EQ(outcome.exit_code, 128 + SIGINT);
    EXPECT_NE(outcome.err.find("stopped; run it again to go on"), std::string::npos) << outcome.err;
}

TEST_F(StudyRuns, OneBadFileDoesNotStopTheOthers) {
    put("bad.csv", "not a spectrum\n");
    put("flat.csv", "wavelength_nm,reflectance\n400,0.3\n500,0.3\n600,0.3\n700,0.3\n");
    put_study("mixed", R"(["spectra.csv", "bad.csv", "missing.csv", "flat.csv"])");
    const Outcome outcome = run({"study", "run", "mixed.json"});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    const Json counts = status("mixed");
    EXPECT_EQ(counts["fitted"].get<int>() + counts["suspect"].get<int>(), spectra);
    EXPECT_EQ(counts["failed"].get<int>() + counts["rejected"].get<int>(), 3);
    for (const Json& each : answers("mixed")["spectra"]) {
        const bool has_reason = !each["reason"].get<std::string>().empty();
        EXPECT_TRUE(has_reason || each["status"] == "fitted") << each["spectrum"];
    }
}

TEST_F(StudyRuns, PartsMergedAreTheWhole) {
    put_study("whole", R"(["spectra.csv"])");
    put_study("parts", R"(["spectra.csv"])");
    run_to_its_end("whole");
    std::vector<std::string> merge = {"study", "merge", "parts.json"};
    for (int part = 1; part <= 3; ++part) {
        const std::string ledger = fmt::format("part_{}.sqlite", part);
        run_to_its_end("parts", {"--part", fmt::format("{}/3", part), "--ledger", ledger});
        merge.push_back(ledger);
    }
    EXPECT_LE(run(merge).exit_code, 1);
    EXPECT_TRUE(answers("parts") == answers("whole"));
    EXPECT_EQ(run({"study", "run", "parts.json", "--part", "1/3"}).exit_code, 2);  // a ledger of its own is needed
}

TEST_F(StudyRuns, DuplicatesAreRejectedByName) {
    put("again.csv", spectra_text(2));
    put_study("twice", R"(["spectra.csv", "again.csv"])");
    EXPECT_EQ(run({"study", "run", "twice.json"}).exit_code, 1);
    EXPECT_EQ(status("twice")["rejected"], 2);
    const Json last = answers("twice")["spectra"].back();
    EXPECT_TRUE(last["reason"].get<std::string>().starts_with("duplicate: ")) << last["reason"];
}

TEST_F(StudyRuns, ADamagedLedgerIsLeftAlone) {
    put_study("whole", R"(["spectra.csv"])");
    std::filesystem::create_directories(folder() / "whole");
    put("whole/ledger.sqlite", std::string(8192, 'x'));
    const Outcome outcome = run({"study", "run", "whole.json"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("is no ledger"), std::string::npos) << outcome.err;
    EXPECT_EQ(read_file(folder() / "whole" / "ledger.sqlite"), std::string(8192, 'x'));
}

TEST_F(StudyRuns, WithoutARunThereIsNothingToShow) {
    put_study("whole", R"(["spectra.csv"])");
    for (const std::string what : {"status", "export", "report"}) {
        const Outcome outcome = run({"study", what, "whole.json"});
        EXPECT_EQ(outcome.exit_code, 2) << what;
        EXPECT_NE(outcome.err.find("skinfit study run"), std::string::npos) << outcome.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder() / "whole"));
}

TEST_F(StudyRuns, ProcessesOfAnMpiJobShareTheWork) {
    if (SKINFIT_TEST_MPIRUN[0] == '\0') GTEST_SKIP() << "built without MPI (-DSKINFIT_MPI=ON)";
    put_study("one", R"(["spectra.csv"])");
    put_study("several", R"(["spectra.csv"])");
    run_to_its_end("one");
    const StartedProgram job({SKINFIT_TEST_MPIRUN, "--allow-run-as-root", "--oversubscribe", "-n", "3",
                              skinfit_program(), "study", "run", "several.json", "--threads", "1"},
                             folder());
    const Outcome outcome = job.wait();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(answers("several") == answers("one"));
}

}  // namespace
}  // namespace skinfit::test
