#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "core/text.hpp"
#include "validation/figure_output.hpp"
#include "validation/figure_run.hpp"
#include "validation/shipped.hpp"

namespace skinfit {
namespace {

Figure figure_of(int number) {
    for (const Figure& figure : shipped_figures()) {
        if (figure.number == number) return figure;
    }
    throw std::out_of_range(std::to_string(number));
}

const FigureOptions quick = {.rays = 2000, .seed = {}, .shared_folder = "/nowhere"};

TEST(ForwardValidation, EveryFigureGivesEveryCurveAndVerdict) {
    for (const Figure& figure : shipped_figures()) {
        const FigureResult result = run_figure(figure, quick);
        ASSERT_EQ(result.panels.size(), figure.panels.size());
        for (std::size_t p = 0; p < figure.panels.size(); ++p) {
            ASSERT_EQ(result.panels[p].variants.size(), figure.variants.size());
            for (const VariantResult& variant : result.panels[p].variants) {
                EXPECT_EQ(variant.spectra.size() + variant.lobes.size(), figure.panels[p].series.size());
                EXPECT_EQ(variant.findings.size(), figure.panels[p].claims.size());
            }
        }
        const PlotSheet sheet = figure_sheet(result);
        ASSERT_EQ(sheet.rows.size(), figure.panels.size());
        for (const SheetRow& row : sheet.rows) EXPECT_EQ(row.panels.size(), figure.variants.size());
    }
}

TEST(ForwardValidation, TheSameSeedGivesTheSameBytes) {
    const Figure figure = figure_of(7);
    ASSERT_EQ(figure.kind, FigureKind::goniophotometer);
    EXPECT_EQ(figure_csv(run_figure(figure, quick)), figure_csv(run_figure(figure, quick)));
    FigureOptions other = quick;
    other.seed = 2;
    EXPECT_NE(figure_csv(run_figure(figure, quick)), figure_csv(run_figure(figure, other)));
}

TEST(ForwardValidation, AnAbsentMeasurementIsSaidAndSkipped) {
    const Figure figure = shipped_figures().back();
    ASSERT_EQ(figure.number, 10);
    const FigureResult result = run_figure(figure, quick);
    ASSERT_EQ(result.messages.size(), 1U);
    EXPECT_NE(result.messages[0].find("eyelid_transmittance_bierman_2011.txt"), std::string::npos);
    const std::vector<ClaimFinding>& findings = result.panels[0].variants[0].findings;
    EXPECT_EQ(std::ranges::count(findings, ClaimVerdict::skipped, &ClaimFinding::verdict), 2);
    EXPECT_NE(summary_text({result}).find("skipped"), std::string::npos);
    EXPECT_TRUE(summary_json({result})["figures"][0]["claims"][4]["number"].is_null());
}

TEST(ForwardValidation, TablesHaveARowPerPointAndStateEverySource) {
    const Figure figure = figure_of(5);
    const std::string table = figure_csv(run_figure(figure, quick));
    std::size_t rows = 0;
    std::size_t sources = 0;
    for (const std::string_view line : split_lines(table)) {
        rows += line.empty() || line.starts_with('#') ? 0 : 1;
        sources +=
            line.find(": paper: ") != std::string_view::npos || line.find(": chosen: ") != std::string_view::npos;
    }
    EXPECT_EQ(rows, 1 + 2U * 4U * 5U * 61U);  // the header; panels, variants, series, wavelengths
    EXPECT_EQ(sources, figure.sources.size());
}

}  // namespace
}  // namespace skinfit
