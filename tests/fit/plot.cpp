#include "fit/plot.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using PlotTest = test::TemporaryFolder;

/// The message of the InputError that drawing `plot` at `path` throws, or nothing.
std::string refusal(const Plot& plot, const std::filesystem::path& path) {
    return test::refusal_of([&] { draw(plot, path); });
}

const Plot example = {.title = R"(a `date` title's "$HOME" \n)",
                      .x_label = "x_axis (nm)",
                      .y_label = "y^2 {axis} @ & < (1)",
                      .lines = {{.label = "melanosome_fraction = 1", .x = {1, 2, 3}, .y = {1, -1, 0.5}},
                                {.label = "it's\nEND\nexit 1", .x = {1, 3}, .y = {0, 1e-3}}}};

TEST_F(PlotTest, ALabelMayBeginWithAnApostrophe) {
    Plot quoted = example;
    quoted.title = "'quoted'";
    draw(quoted, in_folder("a.svg"));
    EXPECT_NE(read_file(in_folder("a.svg")).find("\u2019quoted'"), std::string::npos);
}

TEST_F(PlotTest, AnSvgHoldsItsLabelsAsTheyAre) {
    draw(example, in_folder("a.svg"));
    const std::string svg = read_file(in_folder("a.svg"));
    for (const std::string label : {R"(a `date` title's "$HOME" \n)", "x_axis (nm)", "y^2 {axis} @ &amp; &lt; (1)",
                                    "melanosome_fraction = 1", "it's END exit 1"}) {
        EXPECT_NE(svg.find(label), std::string::npos) << label;
    }
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST_F(PlotTest, EachSuffixGivesItsForm) {
    draw(example, in_folder("a.png"));
    EXPECT_TRUE(read_file(in_folder("a.png")).starts_with("\x89PNG"));
    draw(example, in_folder("a.pdf"));
    EXPECT_TRUE(read_file(in_folder("a.pdf")).starts_with("%PDF"));
    EXPECT_EQ(entries(), 2);
}

TEST_F(PlotTest, TheNameOfTheFileIsNoProgram) {
    const std::string name = "it's `touch b` $(touch c).svg";
    draw(example, in_folder(name));
    EXPECT_TRUE(std::filesystem::exists(in_folder(name)));
    EXPECT_EQ(entries(), 1);
}

TEST_F(PlotTest, ASinglePointIsDrawn) {
    draw({.title = "t", .x_label = "x", .y_label = "y", .lines = {{.label = "l", .x = {1}, .y = {0}}}},
         in_folder("a.svg"));
    EXPECT_EQ(entries(), 1);
}

TEST_F(PlotTest, RefusesOtherSuffixes) {
    for (const std::string name : {"a", "a.jpg", "a.PNG", ".svg"}) {
        EXPECT_NE(refusal(example, in_folder(name)).find("unknown suffix"), std::string::npos) << name;
    }
    EXPECT_EQ(entries(), 0);
}

TEST_F(PlotTest, RefusesAMissingFolderAndLeavesNothing) {
    const std::string message = refusal(example, in_folder("missing/a.svg"));
    EXPECT_NE(message.find("cannot be written (No such file or directory)"), std::string::npos) << message;
    EXPECT_EQ(entries(), 0);
}

TEST_F(PlotTest, SaysThatGnuplotIsMissing) {
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", in_folder("").c_str(), 1);
    const std::string message = refusal(example, in_folder("a.svg"));
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_NE(message.find("gnuplot cannot be run (No such file or directory)"), std::string::npos) << message;
    EXPECT_EQ(entries(), 0);
}

}  // namespace
}  // namespace skinfit
