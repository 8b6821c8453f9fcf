#include <sys/stat.h>

#include "measurements/spectrum_file.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

class ConvertRuns : public CliTest {
protected:
    [[nodiscard]] std::string text(const std::string& name) const { return read_file(folder() / name); }
};

TEST_F(ConvertRuns, EveryFormBecomesTheSameCsv) {
    put("wide.txt", "Wavelength [nm]\ta\tb\n400\t0.1\t0.2\n410\t0.3\t0.4\n420\t0.5\t0.6\n");
    put("rows.csv", "id,400,410,420\na,0.1,0.3,0.5\nb,0.2,0.4,0.6\n");
    put("list.json", R"([{"name": "a", "start": 400, "step": 10, "values": [0.1, 0.3, 0.5]},
                         {"name": "b", "start": 400, "step": 10, "values": [0.2, 0.4, 0.6]}])");
    const std::string expected = "# unit: fraction\nwavelength_nm,a,b\n400,0.1,0.2\n410,0.3,0.4\n420,0.5,0.6\n";
    for (const std::string name : {"wide.txt", "rows.csv", "list.json"}) {
        const Outcome outcome = run({"convert", name});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.out, expected) << name;
    }
    EXPECT_EQ(run({"convert", "wide.txt", "--out", "all.json"}).exit_code, 0);
    EXPECT_EQ(run({"convert", "all.json"}).out, expected) << "there and back";
}

TEST_F(ConvertRuns, ColumnsMayBeChosen) {
    put("rows.csv", "id,400,410,420\na,0.1,0.3,0.5\nb,0.2,0.4,0.6\nc,0.2,0.4,0.7\n");
    EXPECT_EQ(run({"convert", "rows.csv", "--column", "c", "--column", "a"}).out,
              "# unit: fraction\nwavelength_nm,c,a\n400,0.2,0.1\n410,0.4,0.3\n420,0.7,0.5\n");
    EXPECT_EQ(run({"convert", "rows.csv", "--column", "b"}).out,
              "# unit: fraction\n# specimen: b\nwavelength_nm,value\n400,0.2\n410,0.4\n420,0.6\n");
}

TEST_F(ConvertRuns, DifferentWavelengthsNeedJson) {
    put("list.json", R"([{"name": "a", "start": 400, "step": 10, "values": [0.1, 0.3]},
                         {"name": "b", "start": 405, "step": 10, "values": [0.2, 0.4]}])");
    const Outcome refused = run({"convert", "list.json", "--out", "all.csv"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("\"b\" has other wavelengths than \"a\""), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("--format json"), std::string::npos) << refused.err;
    EXPECT_EQ(run({"convert", "list.json", "--format", "json", "--out", "all"}).exit_code, 0);
    EXPECT_EQ(read_spectra(folder() / "all").spectra[1].wavelength_nm, (std::vector<double>{405, 415}));
}

TEST_F(ConvertRuns, FitReadsEveryForm) {
    put("rows.csv", "id,450,500,550,600,650,700\n7,0.2,0.25,0.24,0.4,0.45,0.47\n9,0.3,0.3,0.3,0.4,0.5,0.5\n");
    const Outcome all = run({"fit", "rows.csv"});
    EXPECT_EQ(all.exit_code, 2);
    EXPECT_NE(all.err.find("rows.csv: has 2 spectra (7, 9); choose one with --column"), std::string::npos) << all.err;
    const Outcome one = run({"fit", "rows.csv", "--column", "9", "--set", "engine=solver"});
    EXPECT_LE(one.exit_code, 1) << one.err;
    EXPECT_EQ(run({"fit", "rows.csv", "--column", "450", "--reader", "columns"}).exit_code, 2);
}

TEST_F(ConvertRuns, WhatCannotBeReadIsRefused) {
    ASSERT_EQ(::mkfifo((folder() / "pipe.csv").c_str(), 0600), 0);
    std::filesystem::create_symlink("loop.csv", folder() / "loop.csv");
    put("book.csv", "PK\x03\x04 and so on");
    for (const auto& [name, words] : {std::pair{"pipe.csv", "is a pipe into which nobody writes"},
                                      {"loop.csv", "Too many levels of symbolic links"},
                                      {"book.csv", "is a zip archive"},
                                      {".", "is a folder"}}) {
        for (const std::string command : {"convert", "fit"}) {
            const Outcome outcome = run({command, name});
            EXPECT_EQ(outcome.exit_code, 2) << name;
            EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        }
    }
}

}  // namespace
}  // namespace skinfit::test
