#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "core/text.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

using Words = std::vector<std::string>;

Words lines_of(const std::string& text) {
    Words lines;
    for (const std::string_view line : split_lines(text)) lines.emplace_back(line);
    return lines;
}

Words joined(Words words, const std::string& word) {
    words.push_back(word);
    return words;
}

/// Help, completion and manual, which all tell of the same commands.
class HelpRuns : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        for (const char* name : {"measurements", "configs"}) {
            std::filesystem::copy(std::filesystem::path(SKINFIT_SOURCE_DIR) / name, folder() / name,
                                  std::filesystem::copy_options::recursive);
        }
        std::filesystem::create_symlink(skinfit_program(), folder() / "skinfit");
        ::setenv("PATH", (folder().string() + ":" + std::getenv("PATH")).c_str(), 1);
    }

    [[nodiscard]] Outcome shell(const std::string& line, const std::string& name = "bash") const {
        return StartedProgram({name, "-c", line}, folder()).wait();
    }

    [[nodiscard]] std::string help_of(const Words& command) const {
        const Outcome help = run(joined(command, "--help"));
        EXPECT_EQ(help.exit_code, 0);
        return help.out;
    }

    /// The commands that can be run, each as its words.
    [[nodiscard]] std::vector<Words> commands(const Words& parent = {}) const {
        std::vector<Words> all;
        bool listed = false;
        for (const std::string& line : lines_of(help_of(parent))) {
            if (line == "Subcommands:") {
                listed = true;
            } else if (listed && line.starts_with("  ") && line[2] != ' ') {
                std::ranges::copy(commands(joined(parent, line.substr(2, line.find(' ', 2) - 2))),
                                  std::back_inserter(all));
            } else if (listed && line.empty()) {
                break;
            }
        }
        if (all.empty()) all.push_back(parent);
        return all;
    }

    [[nodiscard]] Words examples_of(const Words& command) const {
        Words examples;
        for (const std::string& line : lines_of(help_of(command))) {
            if (line.starts_with("  skinfit ")) examples.push_back(line.substr(2));
        }
        return examples;
    }

    [[nodiscard]] Words long_options_of(const Words& command) const {
        Words options;
        for (const std::string& line : lines_of(help_of(command))) {
            if (!line.starts_with("  -")) continue;
            const std::size_t begin = line.find("--");
            options.push_back(line.substr(begin, line.find_first_of(" ,", begin) - begin));
        }
        return options;
    }
};

TEST_F(HelpRuns, EveryCommandHasExamplesAndQuiet) {
    EXPECT_GE(commands().size(), 21U);
    for (const Words& command : commands()) {
        EXPECT_FALSE(examples_of(command).empty()) << command.back();
        const Words options = long_options_of(command);
        EXPECT_EQ(std::ranges::count(options, "--quiet"), 1) << command.back();
    }
}

TEST_F(HelpRuns, EveryCommandSaysItsExitCodesAndOptionsTheirLimits) {
    for (const Words& command : commands()) {
        const std::string help = help_of(command);
        EXPECT_NE(help.find("\nExit code 0: "), std::string::npos) << command.back();
        EXPECT_NE(help.find("2: bad input"), std::string::npos) << command.back();
        // CLI11's own words.
        for (const char* word : {"INT", "UINT", "FLOAT", "TEXT", "REQUIRED", "Excludes"}) {
            EXPECT_EQ(help.find(word), std::string::npos) << command.back() << ": " << word;
        }
    }
    const std::string fit = help_of({"fit"});
    EXPECT_NE(fit.find("--format text|json"), std::string::npos);
    EXPECT_NE(fit.find("(default: text)"), std::string::npos);
    EXPECT_NE(fit.find("(1 to 1024)"), std::string::npos);
    EXPECT_NE(help_of({"study", "power"}).find("(needed)"), std::string::npos);
    EXPECT_NE(help_of({"gonio"}).find("(0.5 to 90; default: 5)"), std::string::npos);
    EXPECT_EQ(help_of({"study", "run"}).find("\n\n\n"), std::string::npos);
    EXPECT_EQ(help_of({"study", "run"}).find("--jobs"), std::string::npos) << "the old name of --threads is not shown";
    EXPECT_NE(help_of({"study", "run"}).find("; not with --quiet"), std::string::npos);
}

TEST_F(HelpRuns, TheHelpIsShownByTheCommandHelpToo) {
    EXPECT_EQ(run({}).out, help_of({}));
    EXPECT_EQ(run({"help"}).out, help_of({}));
    for (const Words& command : commands()) {
        Words words = {"help"};
        words.insert(words.end(), command.begin(), command.end());
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.exit_code, 0);
        EXPECT_EQ(outcome.out, help_of(command));
        if (command.size() < 2) continue;
        EXPECT_EQ(run({command.front()}).out, help_of({command.front()})) << "a command that is not finished";
        EXPECT_EQ(run({"help", command.front()}).out, help_of({command.front()}));
    }
    EXPECT_EQ(run({}).exit_code, 0);
    expect_refusal({"help", "fitt"}, "did you mean `skinfit fit`?");
    expect_refusal({"help", "fit", "me"}, "one word too many");
    expect_refusal({"--quiet"}, "unknown option --quiet");
}

TEST_F(HelpRuns, EveryExampleWorks) {
    // These wait for a person or take minutes; those that write where the user's own files are, too.
    const auto is_left_out = [](const std::string& example) {
        for (const char* part : {"explore", "bench", "validate", "~/", "man -l"}) {
            if (example.find(part) != std::string::npos) return true;
        }
        return false;
    };
    // Some show what others have made: a study is run before it is reported.
    ASSERT_LE(shell("skinfit study run configs/study_example.json").exit_code, 1);
    ASSERT_LE(shell("skinfit study run configs/study_example.json --part 1/2 --ledger part_1.sqlite").exit_code, 1);
    for (const Words& command : commands()) {
        for (const std::string& example : examples_of(command)) {
            if (is_left_out(example)) continue;
            const Outcome outcome = shell(example);
            EXPECT_EQ(outcome.signal, 0) << example;
            EXPECT_LE(outcome.exit_code, 1) << example << "\n" << outcome.err;
            EXPECT_NE(outcome.exit_code, -1) << example;
        }
    }
}

TEST_F(HelpRuns, BashCompletesEveryCommandAndOption) {
    const std::string completes =
        "source <(skinfit completion bash); compopt() { :; }; try() { COMP_WORDS=(skinfit \"$@\"); COMP_CWORD=$#; "
        "_skinfit; echo \" ${COMPREPLY[*]} \"; }; ";
    for (const Words& command : commands()) {
        std::string words;
        for (const std::string& word : command) words += word + " ";
        const Outcome parent = shell(completes + "try " + words.substr(0, words.size() - 2));
        EXPECT_NE(parent.out.find(" " + command.back() + " "), std::string::npos) << words << parent.out << parent.err;
        for (const std::string& option : long_options_of(command)) {
            const Outcome outcome = shell(completes + "try " + words + option.substr(0, option.size() - 1));
            EXPECT_NE(outcome.out.find(" " + option + " "), std::string::npos) << words << option << outcome.err;
        }
    }
    EXPECT_EQ(shell(completes + "try fit --uncertainty p").out, " profile posterior \n");
    EXPECT_EQ(shell(completes + "try fit --free oxy").out, " oxygen_saturation \n");
    EXPECT_EQ(shell(completes + "try fit --set discr").out, " discrepancy= \n");
    EXPECT_EQ(shell(completes + "try fit measure").out, " measurements \n");
    EXPECT_EQ(shell(completes + "try fit --free oxygen_saturation,bil").out, " oxygen_saturation,bilirubin_g_per_l \n");
    EXPECT_EQ(shell(completes + "try fit --format = j").out, " json \n");
    EXPECT_EQ(shell(completes + "try fit --set engine = m").out, "  \n");
    EXPECT_EQ(shell(completes + "try study run --outp").out, "  \n");
}

TEST_F(HelpRuns, FishCompletes) {
    if (shell("command -v fish").exit_code != 0) GTEST_SKIP() << "no fish on this machine";
    const auto completed = [&](const std::string& line) {
        return shell("skinfit completion fish | source; complete -C '" + line + "' | string replace -r '\\t.*' ''",
                     "fish")
            .out;
    };
    EXPECT_EQ(completed("skinfit st"), "study\n");
    EXPECT_EQ(completed("skinfit study m"), "merge\n");
    EXPECT_EQ(completed("skinfit study merge --verb"), "--verbose\n");
    EXPECT_EQ(completed("skinfit fit --uncertainty p"), "posterior\nprofile\n");
    EXPECT_EQ(completed("skinfit fit --free oxy"), "oxygen_saturation\n");
    EXPECT_EQ(completed("skinfit fit measure"), "measurements/\n");
    EXPECT_EQ(completed("skinfit fit benc"), "");  // commands are not offered twice
}

TEST_F(HelpRuns, ZshCompletes) {
    if (shell("command -v zsh").exit_code != 0) GTEST_SKIP() << "no zsh on this machine";
    put("complete.zsh", R"(
zmodload zsh/zpty
zpty shell zsh -f -i
# What is typed before the shell reads letter by letter, is not completed: the prompt says that it does. Nothing that is
# typed, and so shown, looks like it.
zpty -w shell 'autoload -U compinit; compinit -u -d zcompdump; source <(skinfit completion zsh); PS1="re""ady> "'
zpty -r shell out '*ready> *'
zpty -w -n shell $'skinfit study me\t --verb\t <'
zpty -r shell out '*verb*<*'
print -r -- $out
zpty -d shell
)");
    EXPECT_EQ(shell("skinfit completion zsh | zsh -n").exit_code, 0);
    const std::string shown = shell("timeout 30 zsh complete.zsh").out;
    EXPECT_NE(shown.find("merge"), std::string::npos) << shown;
    EXPECT_NE(shown.find("--verbose"), std::string::npos) << shown;
}

TEST_F(HelpRuns, TheManualHoldsEveryCommandAndOption) {
    const Outcome page = shell("skinfit manual | groff -man -ww -Tascii -P-c -P-b -P-u");
    EXPECT_EQ(page.err, "");
    std::string text = page.out;
    for (const Words& command : commands()) {
        std::string heading = "   skinfit";
        for (const std::string& word : command) heading += " " + word;
        const std::size_t begin = text.find(heading + "\n");
        ASSERT_NE(begin, std::string::npos) << heading;
        const std::string section = text.substr(begin, text.find("\n   skinfit ", begin + 1) - begin);
        for (const std::string& option : long_options_of(command)) {
            if (option == "--help") continue;
            EXPECT_NE(section.find("       " + option), std::string::npos) << heading << " " << option;
        }
    }
}

}  // namespace
}  // namespace skinfit::test
