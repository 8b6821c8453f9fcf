#include <nlohmann/json.hpp>

#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

class StudySimulateRuns : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        put("cohort.json", R"({
            // quickly simulated
            "name": "two", "wavelengths": "450:650:100",
            "population": {"melanosome_fraction": {"kind": "uniform", "lower": 0.01, "upper": 0.1}},
            "groups": [{"name": "a", "subjects": 3}, {"name": "b", "subjects": 2}],
            "labels": {"pale": {"parameter": "melanosome_fraction", "below": 0.2}}
        })");
    }
    [[nodiscard]] Outcome simulate(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments = {"study", "simulate", "cohort.json", "--output", "out"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    [[nodiscard]] std::string text(const std::string& name) const { return read_file(folder() / name); }
};

TEST_F(StudySimulateRuns, WritesFourFilesAndSaysWhatIsInThem) {
    const Outcome outcome = simulate();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("two: 5 subjects, 5 spectra at 3 wavelengths"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("pale: 5 of 5"), std::string::npos) << outcome.out;
    for (const char* name : {"spectra.csv", "manifest.csv", "cohort.json", "study.json"}) {
        EXPECT_TRUE(std::filesystem::exists(folder() / "out" / name)) << name;
    }
    const Outcome inspected = run({"inspect", "out/spectra.csv"});
    EXPECT_NE(inspected.out.find("a_0001"), std::string::npos) << inspected.out << inspected.err;
}

TEST_F(StudySimulateRuns, ReplacesAnEarlierCohortAndSaysSoButNothingForeign) {
    EXPECT_EQ(simulate().exit_code, 0);
    const std::string before = text("out/spectra.csv");
    const Outcome again = simulate({"--threads", "1"});
    EXPECT_EQ(again.err, "note: replaced the earlier cohort in out\n");
    EXPECT_EQ(text("out/spectra.csv"), before);
    put("out/mine.txt", "mine");
    const Outcome refused = simulate({"--seed", "2"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.out, "");
    EXPECT_NE(refused.err.find("--output out: holds mine.txt"), std::string::npos) << refused.err;
    EXPECT_EQ(text("out/spectra.csv"), before);
}

TEST_F(StudySimulateRuns, SeedAndEngineOfTheCommandAreThoseOfTheResolvedCohort) {
    EXPECT_EQ(simulate({"--seed", "7", "--engine", "emulator"}).exit_code, 0);
    const auto resolved = nlohmann::ordered_json::parse(text("out/cohort.json"));
    EXPECT_EQ(resolved["seed"], 7);
    EXPECT_EQ(resolved["model"]["engine"], "emulator");
    EXPECT_EQ(run({"study", "simulate", "out/cohort.json", "--output", "again"}).exit_code, 0);
    for (const char* name : {"/spectra.csv", "/manifest.csv", "/cohort.json", "/study.json"}) {
        EXPECT_EQ(text(std::string("again") + name), text(std::string("out") + name)) << name;
    }
}

TEST_F(StudySimulateRuns, BadInputIsRefusedBeforeAnythingIsMade) {
    const auto expect = [this](const std::vector<std::string>& arguments, const std::string& what) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(folder() / "out"));
    };
    expect({"study", "simulate", "cohort.json"}, "--output");
    expect({"study", "simulate", "absent.json", "--output", "out"}, "absent.json");
    expect({"study", "simulate", "cohort.json", "--output", "out", "--engine", "walk"}, "--engine");
    expect({"study", "simulate", "cohort.json", "--output", "out", "--seed", "-1"}, "--seed");
    expect({"study", "simulate", "cohort.json", "--output", "cohort.json"}, "no folder that can be written");
    put("list.json", "[1]");
    expect({"study", "simulate", "list.json", "--output", "out"}, "list.json: [1] is no object");
    put("cut.json", "{\"name\": ");
    expect({"study", "simulate", "cut.json", "--output", "out"}, "cut.json");
}

}  // namespace
}  // namespace skinfit::test
