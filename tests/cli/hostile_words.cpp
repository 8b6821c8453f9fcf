#include <algorithm>
#include <cctype>
#include <chrono>

#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

/// Words of files and names of files are data: none of them moves a terminal's cursor or begins a line of a report.
class HostileWords : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        std::string wavelengths;
        std::string values;
        for (int nm = 400; nm <= 700; nm += 20) {
            wavelengths += (nm == 400 ? "" : ", ") + std::to_string(nm);
            values += (nm == 400 ? "0." : ", 0.") + std::to_string(nm - 200);
        }
        put("name.json", R"({"spectra": [{"name": "arm\nverdict: forged\u001b[2J\u202e", "instrument": "\u009b31m\nx",)"
                         R"( "wavelength_nm": [)" +
                             wavelengths + R"(], "value": [)" + values + "]}]}");
        std::string text =
            "# specimen: arm\x1b]0;title\x07\n# lamp: \xc2\x9b"
            "2J\nwavelength_nm,reflectance\n";
        for (int nm = 400; nm <= 700; nm += 20) text += std::to_string(nm) + ",0." + std::to_string(nm - 200) + "\n";
        put("words.csv", text);
        put("evil\nverdict: forged\x1b[31m.csv", text);
    }

    /// That `arguments` write nothing a terminal obeys, and no line that begins with "verdict: forged".
    void expect_plain(const std::vector<std::string>& arguments) const {
        const Outcome outcome = run(arguments);
        for (const std::string& text : {outcome.out, outcome.err}) {
            SCOPED_TRACE(text);
            EXPECT_TRUE(std::ranges::none_of(text, [](unsigned char c) { return std::iscntrl(c) != 0 && c != '\n'; }));
            EXPECT_EQ(text.find("\xc2\x9b"), std::string::npos);
            EXPECT_EQ(text.find("\xe2\x80\xae"), std::string::npos);
            EXPECT_EQ(("\n" + text).find("\nverdict: forged"), std::string::npos);
        }
        EXPECT_NE(outcome.exit_code, 3);
    }
};

TEST_F(HostileWords, AreShownInReports) {
    for (const std::string file : {"name.json", "words.csv", "evil\nverdict: forged\x1b[31m.csv"}) {
        expect_plain({"inspect", file});
        expect_plain({"convert", file});
        expect_plain({"convert", file, "--format", "json"});
        expect_plain({"fit", file, "--set", "engine=solver", "--set", "starts=1"});
        expect_plain({"fit", file, "--set", "engine=solver", "--set", "starts=1", "--format", "json"});
    }
}

TEST_F(HostileWords, AreShownInMessages) {
    expect_plain({"fit", "none\nerror: forged\x1b[31m.csv"});
    expect_plain({"fit", "words.csv", "--column", "a\nb\x1b"});
    expect_plain({"fit", "words.csv", "--set", "x\ny\x1b=1"});
    expect_plain({"fit", "words.csv", "--set", "instrument=\xff\xfe\nverdict: forged"});
    expect_plain({"describe", "a\nverdict: forged\x1b[2J"});
    expect_plain({"a\nverdict: forged\x1b[2J"});
}

TEST_F(HostileWords, OfStudiesAreRefusedOrShown) {
    put("study.json", R"({"inputs": ["words.csv"], "output": "out", "name": "n\nverdict: forged\u001b[2J"})");
    expect_plain({"study", "run", "study.json"});
    expect_plain({"study", "status", "study.json"});
    expect_plain({"study", "export", "study.json"});
    put("study.json", R"({"inputs": [{"files": "words.csv", "metadata": {"a\u001b": "b"}}], "output": "out"})");
    expect_plain({"study", "run", "study.json"});
}

/// A pattern that takes a backtracking engine for ever, or its whole stack.
TEST_F(HostileWords, AreMatchedInLinearTime) {
    std::string text = "wavelength_nm";
    for (const std::string& name : {std::string(40'000, 'a'), std::string("b1"), std::string("a1")}) text += "," + name;
    text += "\n";
    for (int nm = 400; nm <= 700; nm += 20) text += std::to_string(nm) + ",0.3,0.3,0.3\n";
    put("names.csv", text);
    for (const std::string pattern : {"(.*)", "(a+)+b", "^(a|a)*$"}) {
        put("study.json", R"({"inputs": [{"files": "names.csv", "names": {"pattern": ")" + pattern +
                              R"(", "fields": ["s"]}}], "output": "out_)" + std::to_string(pattern.size()) +
                              R"(", "fit": {"engine": "solver", "starts": 1}})");
        const Outcome outcome = run({"study", "run", "study.json"});
        EXPECT_LE(outcome.exit_code, 1) << outcome.err;
        EXPECT_EQ(outcome.signal, 0);
    }
}

}  // namespace
}  // namespace skinfit::test
