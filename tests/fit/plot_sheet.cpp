#include "fit/plot_sheet.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using PlotSheetTest = test::TemporaryFolder;

PlotSheet example() {
    const SheetPanel panel{
        .title = "it's a panel",
        .lines = {{.label = "model_1", .x = {1, 2, 3}, .y = {1, 2, 0.5}},
                  {.label = "measured", .x = {1, 3}, .y = {2, 2}, .style = LineStyle::reference}},
        .swatches = {{.colour = "#804020", .label = "dark"}, {.colour = "#f0e0d0", .label = "light"}}};
    const SheetRow row{.x_label = "x (nm)", .y_label = "y (1)", .x_low = 1, .x_high = 3, .panels = {panel, panel}};
    return {.title = "a sheet's `title`", .rows = {row, row}};
}

TEST_F(PlotSheetTest, AnSvgHoldsLabelsAndColours) {
    draw(example(), in_folder("a.svg"));
    const std::string svg = read_file(in_folder("a.svg"));
    for (const std::string part : {"a sheet's `title`", "it's a panel", "x (nm)", "y (1)", "dark", "light"}) {
        EXPECT_NE(svg.find(part), std::string::npos) << part;
    }
    EXPECT_NE(svg.find("128,  64,  32"), std::string::npos);  // the first patch
}

TEST_F(PlotSheetTest, TheLegendOfARowStandsOnce) {
    draw(example(), in_folder("a.svg"));
    const std::string svg = read_file(in_folder("a.svg"));
    std::size_t count = 0;
    for (std::size_t at = svg.find(">model_1<"); at != std::string::npos; at = svg.find(">model_1<", at + 1)) ++count;
    EXPECT_EQ(count, 2U);  // of two rows
}

TEST_F(PlotSheetTest, LevelLinesAreDrawnToo) {
    PlotSheet sheet = example();
    for (SheetRow& row : sheet.rows) {
        for (SheetPanel& panel : row.panels) panel.lines = {{.label = "zero", .x = {1, 2}, .y = {0, 0}}};
    }
    draw(sheet, in_folder("a.png"));
    EXPECT_TRUE(read_file(in_folder("a.png")).starts_with("\x89PNG"));
}

TEST_F(PlotSheetTest, RefusesOtherSuffixes) {
    EXPECT_THROW(draw(example(), in_folder("a.jpg")), InputError);
}

}  // namespace
}  // namespace skinfit
