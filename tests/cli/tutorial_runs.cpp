#include <cstdlib>

#include "core/text.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

/// A block of the tutorial, between two fences.
struct Block {
    std::string kind;  ///< "sh": a command; empty: something to read
    std::vector<std::string> lines;
};

std::vector<Block> blocks_of(const std::string& text) {
    std::vector<Block> blocks;
    bool inside = false;
    for (const std::string_view line : split_lines(text)) {
        if (line.starts_with("```")) {
            if (!inside) blocks.push_back({.kind = std::string(line.substr(3)), .lines = {}});
            inside = !inside;
        } else if (inside) {
            blocks.back().lines.emplace_back(line);
        }
    }
    return blocks;
}

/// The first line of `shown` that does not stand in `printed` after those before it; a line "..." leaves some out.
std::string first_missing(const std::vector<std::string>& shown, const std::string& printed) {
    std::size_t at = 0;
    for (const std::string& line : shown) {
        if (line == "...") continue;
        const std::size_t found = ("\n" + printed).find("\n" + line + "\n", at);
        if (found == std::string::npos) return line;
        at = found + line.size();
    }
    return "";
}

class TutorialRuns : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        std::filesystem::create_directories(folder() / "measurements");
        std::filesystem::copy(SKINFIT_SOURCE_DIR "/measurements/data", folder() / "measurements" / "data",
                              std::filesystem::copy_options::recursive);
        const std::string program_folder = std::filesystem::path(skinfit_program()).parent_path().string();
        ::setenv("PATH", (program_folder + ":" + std::getenv("PATH")).c_str(), 1);
    }
};

TEST_F(TutorialRuns, EveryCommandPrintsWhatIsShownOfIt) {
    const std::vector<Block> blocks = blocks_of(read_file(SKINFIT_SOURCE_DIR "/docs/tutorial.md"));
    std::string printed;
    int commands = 0;
    for (const Block& block : blocks) {
        if (block.kind == "sh") {
            ASSERT_EQ(block.lines.size(), 1U);
            const Outcome outcome = StartedProgram({"bash", "-c", block.lines.front()}, folder()).wait();
            EXPECT_LE(outcome.exit_code, 1) << block.lines.front() << outcome.err;
            EXPECT_EQ(outcome.signal, 0);
            EXPECT_EQ(outcome.err, "");
            printed = outcome.out;
            ++commands;
        } else if (commands > 0) {
            EXPECT_EQ(first_missing(block.lines, printed), "") << printed;
        }
    }
    EXPECT_EQ(commands, 8);
    EXPECT_TRUE(std::filesystem::exists(folder() / "fit.html"));
    EXPECT_TRUE(std::filesystem::exists(folder() / "fit.png"));
}

TEST_F(TutorialRuns, AShownLineThatIsNotPrintedIsMissed) {
    EXPECT_EQ(first_missing({"a", "...", "c"}, "a\nb\nc\n"), "");
    EXPECT_EQ(first_missing({"c", "a"}, "a\nb\nc\n"), "a");
    EXPECT_EQ(first_missing({"b "}, "a\nb\nc\n"), "b ");
}

}  // namespace
}  // namespace skinfit::test
