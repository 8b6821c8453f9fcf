#include <gmock/gmock.h>

#include "core/json.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Files of different people, of one specimen, and a bad one.
class SeveralFiles : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        simulate("light.csv", "melanosome_fraction=0.02");
        simulate("dark.csv", "melanosome_fraction=0.12");
        put("bad.csv", "dear diary\n");
    }

    void simulate(const std::string& name, const std::string& setting,
                  const std::string& column = "reflectance") const {
        ASSERT_EQ(run({"simulate", "--set", "engine=solver", "--set", "base=matched", "--set", setting, "--wavelengths",
                       "400:700:20", "--out", "all.csv"})
                      .exit_code,
                  0);
        ASSERT_EQ(run({"convert", "all.csv", "--column", column, "--out", name}).exit_code, 0);
    }

    [[nodiscard]] Outcome fit(std::vector<std::string> arguments) const {
        const std::vector<std::string> quick = {"fit", "--set", "engine=emulator", "--set", "base=matched"};
        arguments.insert(arguments.begin(), quick.begin(), quick.end());
        return run(arguments);
    }

    [[nodiscard]] static double melanosomes(const Json& report) {
        return report["parameters"]["melanosome_fraction"]["value"].get<double>();
    }
    /// Whether the interval of the melanosomes holds `truth`.
    [[nodiscard]] static bool holds(const Json& report, double truth) {
        const Json& interval = report["parameters"]["melanosome_fraction"]["interval_95"];
        return interval[0].get<double>() <= truth && truth <= interval[1].get<double>();
    }
};

TEST_F(SeveralFiles, OfDifferentPeopleAreEachFittedByItself) {
    const Outcome table = fit({"light.csv", "dark.csv"});
    EXPECT_LE(table.exit_code, 1) << table.err;
    EXPECT_THAT(table.out, HasSubstr("2 spectra, each fitted by itself"));
    EXPECT_THAT(table.out, HasSubstr("  light.csv"));
    const Json list = Json::parse(fit({"light.csv", "dark.csv", "--format", "json"}).out);
    ASSERT_EQ(list.size(), 2U);
    for (const auto& [number, name] : {std::pair{0, "light.csv"}, std::pair{1, "dark.csv"}}) {
        Json alone = Json::parse(fit({name, "--format", "json"}).out);
        EXPECT_EQ(melanosomes(list[static_cast<std::size_t>(number)]), melanosomes(alone)) << name;
    }
    // Without noise each interval holds its truth, and not the other's.
    EXPECT_TRUE(holds(list[0], 0.02) && !holds(list[0], 0.12)) << list[0]["parameters"];
    EXPECT_TRUE(holds(list[1], 0.12) && !holds(list[1], 0.02)) << list[1]["parameters"];
}

TEST_F(SeveralFiles, ColumnsOfOneFileToo) {
    put("two.csv",
        "wavelength_nm,anna,bert\n400,0.1,0.2\n450,0.15,0.24\n500,0.2,0.3\n550,0.21,0.33\n600,0.3,0.4\n"
        "650,0.4,0.5\n700,0.45,0.56\n");
    EXPECT_THAT(fit({"two.csv", "--column", "anna", "--column", "bert"}).out, HasSubstr("two.csv anna"));
    EXPECT_THAT(fit({"two.csv", "--column", "anna", "--column", "bert", "--joint"}).out,
                HasSubstr("2 spectra, explained together"));
}

TEST_F(SeveralFiles, OneBadFileDoesNotLoseTheOthers) {
    const Outcome outcome = fit({"light.csv", "bad.csv", "missing.csv", "dark.csv", "--format", "json"});
    EXPECT_EQ(outcome.exit_code, 2) << "the worst";
    EXPECT_THAT(outcome.err, HasSubstr("error: bad.csv"));
    const Json list = Json::parse(outcome.out);
    ASSERT_EQ(list.size(), 4U);
    EXPECT_TRUE(holds(list[0], 0.02) && !holds(list[0], 0.12)) << list[0]["parameters"];
    EXPECT_EQ(list[1]["file"], "bad.csv");
    EXPECT_THAT(list[2]["error"].get<std::string>(), HasSubstr("missing.csv: cannot be read"));
    EXPECT_TRUE(holds(list[3], 0.12) && !holds(list[3], 0.02)) << list[3]["parameters"];
    EXPECT_THAT(fit({"light.csv", "bad.csv"}).out, HasSubstr("no result"));
}

TEST_F(SeveralFiles, OfOneSpecimenAreExplainedTogether) {
    const std::string together = "2 spectra, explained together";
    EXPECT_THAT(fit({"light.csv", "dark.csv", "--joint"}).out, HasSubstr(together));
    EXPECT_THAT(fit({"light.csv", "dark.csv", "--own", "melanosome_fraction"}).out, HasSubstr(together));
    const auto stating = [&](const std::string& from, const std::string& to, const std::string& specimen) {
        std::string text = read_file(folder() / from);
        const std::size_t at = text.find("# specimen: ");
        ASSERT_NE(at, std::string::npos) << text;
        put(to, text.replace(at, text.find('\n', at) - at, "# specimen: " + specimen));
    };
    stating("light.csv", "ear_1.csv", "ear");
    stating("dark.csv", "ear_2.csv", "ear");
    stating("dark.csv", "lip.csv", "lip");
    EXPECT_THAT(fit({"ear_1.csv", "ear_2.csv"}).out, HasSubstr(together));
    EXPECT_THAT(fit({"ear_1.csv", "lip.csv"}).out, Not(HasSubstr(together)));
}

TEST_F(SeveralFiles, WhatHoldsOneFitIsRefusedForSeveral) {
    for (const char* option : {"--report", "--plot", "--samples"}) {
        const Outcome outcome = fit({"light.csv", "dark.csv", option, "fit.svg", "--uncertainty", "posterior"});
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_THAT(outcome.err, HasSubstr("fit one at a time, add --joint"));
        EXPECT_FALSE(std::filesystem::exists(folder() / "fit.svg"));
    }
    EXPECT_LE(fit({"light.csv", "dark.csv", "--out", "fits.txt"}).exit_code, 1);
    EXPECT_THAT(read_file(folder() / "fits.txt"), HasSubstr("dark.csv"));
}

}  // namespace
}  // namespace skinfit::test
