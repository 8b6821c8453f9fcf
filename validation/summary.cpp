#include <fmt/format.h>

#include "core/version.hpp"
#include "validation/figure_names.hpp"
#include "validation/figure_output.hpp"

namespace skinfit {
namespace {

/// One verdict and where it belongs.
struct Judgement {
    const Figure* figure;
    const FigurePanel* panel;
    Claim claim;
    FigureVariant variant;
    const ClaimFinding* finding;
};

/// Panel by panel and claim by claim, so that the variants of one claim stand together.
std::vector<Judgement> judgements(const FigureResult& result) {
    std::vector<Judgement> all;
    for (std::size_t p = 0; p < result.panels.size(); ++p) {
        const FigurePanel& panel = result.figure.panels[p];
        for (std::size_t c = 0; c < panel.claims.size(); ++c) {
            for (const VariantResult& variant : result.panels[p].variants) {
                all.push_back({&result.figure, &panel, panel.claims[c], variant.variant, &variant.findings[c]});
            }
        }
    }
    return all;
}

Json judgement_json(const Judgement& each) {
    const bool is_skipped = each.finding->verdict == ClaimVerdict::skipped;
    return {{"panel", each.panel->title},
            {"claim", info(each.claim).name},
            {"claim_text", info(each.claim).text},
            {"edition", name_of(each.variant.edition)},
            {"fibril_radius_nm", each.variant.fibril_radius_nm},
            {"verdict", name_of(each.finding->verdict)},
            {"number", is_skipped ? Json() : Json(each.finding->number)},
            {"measure", each.finding->measure},
            {"why", each.finding->why}};
}

}  // namespace

std::string summary_text(const std::vector<FigureResult>& results) {
    std::string text;
    for (const FigureResult& result : results) {
        text += fmt::format("{}\n", result.figure.title);
        const FigurePanel* panel = nullptr;
        const ClaimFinding* finding = nullptr;
        Claim claim{};
        for (const Judgement& each : judgements(result)) {
            if (finding == nullptr || each.panel != panel || each.claim != claim) {
                text += fmt::format("  {}: {}  [{}]\n", each.panel->title, info(each.claim).text,
                                    each.finding->measure.empty() ? "skipped" : each.finding->measure);
            }
            panel = each.panel;
            claim = each.claim;
            finding = each.finding;
            text += fmt::format(
                "    {:<8} r = {:<5} nm  {:<15} {:>9}  {}\n", name_of(each.variant.edition),
                each.variant.fibril_radius_nm, name_of(finding->verdict),
                finding->verdict == ClaimVerdict::skipped ? "-" : fmt::format("{:.4g}", finding->number), finding->why);
        }
        text += "\n";
    }
    return text;
}

Json summary_json(const std::vector<FigureResult>& results) {
    Json figures = Json::array();
    for (const FigureResult& result : results) {
        Json claims = Json::array();
        for (const Judgement& each : judgements(result)) claims.push_back(judgement_json(each));
        figures.push_back({{"figure", result.figure.number},
                           {"title", result.figure.title},
                           {"shows", result.figure.shows},
                           {"claims", claims},
                           {"sources", result.figure.sources},
                           {"messages", result.messages}});
    }
    return {{"version", version}, {"figures", figures}};
}

}  // namespace skinfit
