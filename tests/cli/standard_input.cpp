#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

const std::string specimen = SKINFIT_SOURCE_DIR "/measurements/data/ncsu_113.csv";

class StandardInput : public CliTest {
protected:
    /// Runs a line of the shell, in which `skinfit` is the program.
    [[nodiscard]] Outcome shell(const std::string& line) const {
        return StartedProgram({"bash", "-c", "skinfit() { " + skinfit_program() + " \"$@\"; }; " + line}, folder())
            .wait();
    }

    static std::string without(std::string text, const std::string& part) {
        const std::size_t place = text.find(part);
        return place == std::string::npos ? text : text.erase(place, part.size());
    }
};

TEST_F(StandardInput, AFitOfItIsThatOfTheFile) {
    const std::string fit = " --set engine=emulator";
    const Outcome piped = shell("cat " + specimen + " | skinfit fit -" + fit);
    const Outcome named = shell("skinfit fit " + specimen + fit);
    EXPECT_EQ(piped.exit_code, named.exit_code);
    EXPECT_NE(piped.out.find("(standard input)"), std::string::npos) << piped.out;
    EXPECT_EQ(without(piped.out, "standard input"), without(named.out, specimen));
}

TEST_F(StandardInput, SeveralColumnsOfItAreFittedTogether) {
    put(
        "two.csv", "wavelength_nm,first reflectance,second reflectance\n" + [] {
            std::string rows;
            for (int nm = 400; nm <= 700; nm += 20) {
                rows += std::to_string(nm) + ",0." + std::to_string(nm / 4) + ",0." + std::to_string(nm / 4 + 7) + "\n";
            }
            return rows;
        }());
    const std::string columns = " --column 1 --column 2 --set engine=emulator --own papillary_blood_fraction";
    const Outcome piped = shell("skinfit fit - < two.csv" + columns);
    EXPECT_EQ(piped.exit_code, shell("skinfit fit two.csv" + columns).exit_code) << piped.err;
    EXPECT_LE(piped.exit_code, 1);
}

TEST_F(StandardInput, ItIsInspectedAndConverted) {
    EXPECT_EQ(shell("skinfit inspect - < " + specimen).exit_code, 0);
    EXPECT_EQ(shell("skinfit convert - --format json < " + specimen + " | skinfit convert - --format json").out,
              shell("skinfit convert " + specimen + " --format json").out);
}

TEST_F(StandardInput, WhatCannotBeReadIsRefused) {
    const auto expect_refused = [&](const std::string& line, const std::string& text) {
        const Outcome outcome = shell(line);
        EXPECT_EQ(outcome.exit_code, 2) << line;
        EXPECT_NE(outcome.err.find(text), std::string::npos) << line << "\n" << outcome.err;
    };
    expect_refused("skinfit fit - < /dev/null", "standard input");
    expect_refused("skinfit fit - <&-", "standard input: cannot be read");
    expect_refused("echo dear diary | skinfit fit -", "standard input");
    expect_refused("skinfit fit - - < " + specimen, "standard input twice");
    expect_refused("skinfit inspect - --reader envi < " + specimen, "cannot be an ENVI cube");
    expect_refused("skinfit fit " + specimen + " --out -", "--out -: is no file");
    expect_refused("head -c 100000 /dev/urandom | skinfit inspect -", "standard input");
}

}  // namespace
}  // namespace skinfit::test
