#include <algorithm>
#include <regex>

#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

using Arguments = std::vector<std::string>;

const std::string good_spectrum = "400,0.2\n450,0.25\n500,0.3\n550,0.31\n600,0.45\n650,0.5\n700,0.52\n";

class BadInput : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        put("good.csv", good_spectrum);
    }

    /// Expects `<where>: <problem> (<why>); <what to do>` with `words` in it, exit code 2 and nothing else at all.
    void expect_refused(const Arguments& arguments, const std::string& words, Stdout where = Stdout::captured) {
        std::string command;
        for (const std::string& argument : arguments) command += argument + " ";
        SCOPED_TRACE("skinfit " + command);
        const std::size_t files = count_files();
        const Outcome outcome = run(arguments, where);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_EQ(outcome.out, "");
        static const std::regex form("error: .+: .+ \\(.+\\); .+\n");
        EXPECT_TRUE(std::regex_match(outcome.err, form)) << outcome.err;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        EXPECT_EQ(count_files(), files) << "a file was left behind";
    }

    void expect_spectrum_refused(const std::string& text, const std::string& words) {
        put("bad.csv", text);
        expect_refused({"fit", "bad.csv", "--set", "preset=paper", "--out", "result.txt"}, words);
    }

private:
    [[nodiscard]] std::size_t count_files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder()), {}));
    }
};

TEST_F(BadInput, Files) {
    expect_refused({"fit", "missing.csv"}, "missing.csv: cannot be read");
    expect_refused({"fit", "."}, "is a folder");
    expect_spectrum_refused("", "bad.csv: is empty");
    expect_spectrum_refused(std::string("\x7f"
                                        "ELF\0\1\2",
                                        7),
                            "bad.csv:1: ");
    expect_spectrum_refused("400,0.2\n450,abc\n500,0.3\n", "bad.csv:2: holds \"abc\"");
    expect_spectrum_refused("400,0.2\n450,inf\n500,0.3\n", "2 wavelengths in the window of the fit");  // missing
    expect_spectrum_refused("400,0.2\n450,-0.1\n500,0.3\n", "bad.csv:2: the value -0.1 at 450 nm is negative");
    expect_spectrum_refused("400,20\n450,170\n500,30\n", "1.7 at 450 nm exceeds 1.5");
    expect_spectrum_refused("400,0.2\n450,0.3\n", "2 wavelengths in the window of the fit for 5 free parameters");
    expect_spectrum_refused("800,0.2\n810,0.3\n820,0.3\n830,0.3\n840,0.3\n850,0.3\n",
                            "nothing of it lies in the window");
}

TEST_F(BadInput, Columns) {
    put("two.csv", "wavelength_nm,arm,leg\n400,0.2,0.3\n450,0.2,0.3\n");
    expect_refused({"fit", "two.csv"}, "arm");
    expect_refused({"fit", "two.csv", "--column", "arn"}, "arm");
    expect_refused({"fit", "two.csv", "--column", "3"}, "two.csv");
}

TEST_F(BadInput, Wavelengths) {
    expect_refused({"fit", "good.csv", "--set", "wavelength_max_nm=2000"}, "outside the tables");
    expect_refused({"fit", "good.csv", "--set", "wavelength_min_nm=600", "--set", "wavelength_max_nm=500"}, "exchange");
    expect_refused({"simulate", "--wavelengths", "100:200:10", "--out", "result.csv"},
                   "wavelength 100 nm: outside the tables (the pigments are tabulated from 250 to 820.26 nm); choose");
    expect_refused({"simulate", "--wavelengths", "1500", "--engine", "walk"}, "1500 nm");
    expect_refused({"simulate", "--wavelengths", "400:700"}, "--wavelengths: ");
}

TEST_F(BadInput, KeysAndValues) {
    put("unknown.json", R"({"sead": 1})");
    put("large.json", R"({"parameters": {"melanosome_fraction": 2}})");
    put("broken.json", "{\"seed\": 1,\n}");
    expect_refused({"fit", "good.csv", "--config", "unknown.json"}, "did you mean \"seed\"?");
    expect_refused({"fit", "good.csv", "--config", "large.json"}, "melanosome_fraction: 2 ");
    expect_refused({"simulate", "--config", "broken.json"}, "broken.json:2: ");
    expect_refused({"config", "check", "broken.json"}, "broken.json:2: ");
    expect_refused({"config", "check", "missing.json"}, "missing.json: cannot be read");
    expect_refused({"fit", "good.csv", "--set", "melanosome=0.1"}, "did you mean \"melanosome_fraction\"?");
    expect_refused({"fit", "good.csv", "--set", "melanosome_fraction"}, "no \"=\"");
    expect_refused({"fit", "good.csv", "--set", "melanosome_fraction=2"}, "--set melanosome_fraction: 2 ");
    expect_refused({"fit", "good.csv", "--set", "edition=\xff"}, "--set edition: ");
    expect_refused({"fit", "good.csv", "--free", "melanin"}, "did you mean \"melanosome_fraction\"?");
    expect_refused({"fit", "good.csv", "--fix", "melanin"}, "--fix: ");
    expect_refused({"fit", "good.csv", "--fix", ""}, "argument 4 is empty");
    expect_refused({"simulate", "--seed", ""}, "argument 3 is empty");
    expect_refused({"fit", "good.csv", "--fix", "scale,"}, "--fix: a name is empty");
    expect_refused({"fit", "good.csv", "--out", "good.csv"}, "is a file that is read");
    expect_refused({"fit", "good.csv", "--config", "large.json", "--out", "large.json"}, "");
    expect_refused({"fit", "good.csv", "--set", "preset=paper", "--free", "fibril_radius_nm"}, "cannot be adjusted");
    expect_refused({"fit", "good.csv", "--free", "specular_fraction"}, "has no effect");
    expect_refused({"fit", "good.csv", "--set", "engine=walk"}, "set engine=solver");
    expect_refused({"fit", "good.csv", "--free", "fold_aspect_ratio"}, "has no effect");
    expect_refused({"fit", "good.csv", "--set", "dermal_bilirubin_g_per_l=20"}, "outside its bounds");
    expect_refused({"fit", "good.csv", "--set", "layers=2", "--set", "base=hypodermis"}, "base: hypodermis");
    expect_refused({"simulate", "--set", "base=air"}, "hypodermis, matched or a refractive index is needed");
    expect_refused({"fit", "good.csv", "--solver", "cere"}, "--solver: ");
    expect_refused({"fit", "good.csv", "--unit", "percents"}, "--unit: ");
    expect_refused({"simulate", "--engine", "path"}, "--engine: ");
    expect_refused({"simulate", "--rays", "10"}, "--rays: 10 ");
    expect_refused({"simulate", "--seed", "-1"}, "--seed: -1 ");
    expect_refused({"fit", "good.csv", "--set", "preset=paper", "--fix",
                    "melanosome_fraction,papillary_blood_fraction,reticular_blood_fraction,oxygen_saturation,"
                    "bilirubin_g_per_l"},
                   "free: no parameter is free");
}

TEST_F(BadInput, SlipsAndContradictions) {
    put("twice.json", R"({"seed": 1, "parameters": {"scale": 1}, "seed": 2})");
    put("misplaced.json", R"({"melanosome_fraction": 0.1})");
    put("start.json", R"({"parameters": {"dermal_bilirubin_g_per_l": 20}})");
    put("outside.json", R"({"wavelengths": "400:900:10"})");
    expect_refused({"config", "check", "twice.json"}, "gives \"seed\" twice");
    expect_refused({"config", "check", "misplaced.json"}, R"(write "parameters": {"melanosome_fraction": ...})");
    expect_refused({"config", "check", "start.json"}, "dermal_bilirubin_g_per_l: starts at 20, outside its bounds");
    expect_refused({"config", "check", "outside.json"}, "wavelengths: 400 to 900 nm reaches outside the tables");
    expect_refused({"fit", "good.csv", "--free", "scale", "--fix", "offset,scale"}, "--fix offset,scale: names a");
    expect_refused({"fit", "good.csv", "--solver", "ceres", "--solver", "ceres"}, "given more than once");
    expect_refused({"fit", "good.csv", "--set", "free=scale"}, "free: frees only scale, nothing of the skin");
    expect_refused({"fit", "good.csv", "--set", "preset=paper", "--free", "scale", "--fix",
                    "melanosome_fraction,papillary_blood_fraction,reticular_blood_fraction,oxygen_saturation,"
                    "bilirubin_g_per_l"},
                   "free: frees only scale");
    put("instrument_alone.json", R"({"free": ["scale", "offset"]})");
    expect_refused({"config", "check", "instrument_alone.json"}, "frees only scale, offset, nothing of the skin");
    expect_refused({"fit", "good.csv", "--config", "instrument_alone.json"}, "adds to it");
    expect_refused({"validate", "inverse", "--spectra", "1", "--config", "instrument_alone.json"}, "frees only scale");
    put("study.json", R"({"inputs": ["good.csv"], "fit": {"free": ["scale"]}, "output": "results"})");
    expect_refused({"study", "run", "study.json"}, "study.json.fit.free: frees only scale");
    expect_refused({"fit", "good.csv", "--own", "scale", "--fix", "scale"}, "--fix scale: names a parameter of");
    expect_refused({"simulate", "--set", "melanin=0.1"}, "did you mean \"melanosome_fraction\"?");
    expect_refused({"simulate", "--melanin", "0.1"}, "did you mean --set melanosome_fraction=...?");
    expect_refused({"simulate", "--oxygen_saturation", "0.1"}, "did you mean --set oxygen_saturation=...?");
    expect_refused({"design", "sto2"}, "did you mean oxygen_saturation?");
    expect_refused({"fit", "good.csv", "--set", "xyzzy=1"}, "see `skinfit config show`");
    expect_refused({"simulate", "--set", "layers=4.5"}, "2 or 4 is needed");
    expect_refused({"simulate", "--set", "scale=1e400"}, "beyond the range of double precision");
    expect_refused({"simulate", "--seed", "9007199254740992"}, "give a whole number from 0 to 9007199254740991");
    expect_spectrum_refused("# incidence: 45\n" + good_spectrum, "bad.csv:1: unknown key \"incidence\"");
    expect_refused({"fit", "good.csv", "--set", "wavelength_min_nm=600", "--set", "wavelength_max_nm=500"},
                   "exchange them");
    put("printed.csv", "# edition: printed\n" + good_spectrum);
    put("revised.csv", "# edition: revised\n" + good_spectrum);
    expect_refused({"fit", "--joint", "printed.csv", "revised.csv"}, "state different editions, layers or bases");
    expect_spectrum_refused("# Edition: printed\n" + good_spectrum, "bad.csv:1: unknown key \"Edition\"");
    expect_spectrum_refused("# Base: air\n" + good_spectrum, "write base: ... as the key");
    expect_spectrum_refused("# bandpass_shape: triangular\n# bandpass_width_nm: 100.1\n" + good_spectrum,
                            "bad.csv:2: bandpass_width_nm is \"100.1\" (it must be at most 100 nm)");
    expect_spectrum_refused("# layers: 3\n" + good_spectrum, "bad.csv:1: layers: 3 cannot be used");
    expect_spectrum_refused("# edition: printed\n# edition: revised\n" + good_spectrum, "is given again");
}

TEST_F(BadInput, Outputs) {
    const Arguments quick = {"simulate", "--wavelengths", "500", "--rays", "1000", "--no-cache"};
    const auto with_out = [&quick](const std::string& out) {
        Arguments arguments = quick;
        arguments.insert(arguments.end(), {"--out", out});
        return arguments;
    };
    expect_refused(with_out("missing/result.csv"), "missing/result.csv: cannot be written");
    expect_refused(with_out("."), "it is a folder");
    expect_refused({"fit", "good.csv", "--out", "missing/result.txt"}, "missing/result.txt: cannot be written");
    expect_refused(quick, "standard output: cannot be written", Stdout::full_device);
    expect_refused({"config", "show"}, "standard output: cannot be written", Stdout::full_device);
    expect_refused({"config", "schema"}, "standard output: cannot be written", Stdout::full_device);
    expect_refused({"--help"}, "standard output: cannot be written", Stdout::full_device);
}

TEST_F(BadInput, CommandLines) {
    expect_refused({"fitt"}, "did you mean `skinfit fit`?");
    expect_refused({"--sed", "1"}, "unknown option --sed");
    expect_refused({"config", "shw"}, "did you mean `skinfit config show`?");
    expect_refused({"fit"}, "FILE is missing (`skinfit fit` needs it); give it");
    expect_refused({"fit", "good.csv", "other.csv", "--joint"}, "other.csv: cannot be read");
    expect_refused({"simulate", "good.csv"}, "\"good.csv\" is one word too many");
    expect_refused({"fit", "good.csv", "--sett", "a=b"}, "did you mean --set?");
    expect_refused({"fit", "good.csv", "--cross_check"}, "did you mean --cross-check?");
    expect_refused({"fit", "good.csv", "--format=xml"},
                   "--format: \"xml\" cannot be used (one of text, json is needed); give one of these");
    expect_refused({"fit", "good.csv", "--config"}, "--config is given without a value");
    expect_refused({"simulate", "--quiet=perhaps"}, "--quiet is given a value (it takes none); leave the value out");
    expect_refused({"study", "run", "a.json", "--quiet", "--verbose"}, "leave one of them out");
    expect_refused({"simulate", "--colum", "x"}, "unknown option --colum");
    expect_refused({"--quiet", "simulate"}, "--quiet stands before the command (it belongs to `skinfit simulate`)");
}

TEST_F(BadInput, ValuesBeyondTheLimitsOfAnOption) {
    const std::string threads = "give a whole number from 1 to 1024\n";
    expect_refused({"simulate", "--threads", "0"}, "--threads: 0 cannot be used (out of range); " + threads);
    expect_refused({"simulate", "--threads", "-1"}, "--threads: -1 cannot be used (out of range); " + threads);
    expect_refused({"simulate", "--threads", "2.5"},
                   "--threads: 2.5 cannot be used (a whole number is needed); " + threads);
    expect_refused({"simulate", "--threads", "2x"},
                   "--threads: \"2x\" cannot be used (a number is needed); " + threads);
    expect_refused({"study", "run", "a.json", "--jobs", "0"}, "--jobs: 0 cannot be used (out of range); " + threads);
    const std::string step = "give a number from 0.5 to 90\n";
    expect_refused({"gonio", "--polar-step", "100"}, "--polar-step: 100 cannot be used (out of range); " + step);
    expect_refused({"gonio", "--polar-step", "nan"}, "--polar-step: ");
    expect_refused({"gonio", "--part", "inside"}, "one of total, surface, subsurface is needed");
    expect_refused({"gonio", "--rays", "x"}, "--rays: \"x\" cannot be used (a number is needed)");
    expect_refused({"completion", "tcsh"}, "SHELL: \"tcsh\" cannot be used (one of bash, zsh, fish is needed)");
    expect_refused({"study", "run", "a.json", "--part", "3/2"}, "--part 3/2: is no share of a study");
}

TEST_F(BadInput, APageNeedsItsFileAndItsPort) {
    expect_refused({"explore", "missing.csv"}, "missing.csv");
    expect_refused({"explore", "--port", "70000"}, "--port");
    expect_refused({"explore", "--port", "1x"}, "--port");
    put("bad.csv", "dear diary\n");
    expect_refused({"explore", "bad.csv"}, "bad.csv");
}

}  // namespace
}  // namespace skinfit::test
