#include <fmt/format.h>

#include <cmath>

#include "core/version.hpp"
#include "fit/report.hpp"
#include "validation/transport_summary.hpp"

namespace skinfit {
namespace {

std::string wanted_words(const JudgedFigure& figure) {
    const Bounds& wanted = figure.wanted;
    if (!std::isfinite(wanted.lower) && !std::isfinite(wanted.upper)) return "";
    std::string words = fmt::format("{:.3g} to {:.3g}", wanted.lower, wanted.upper);
    if (!std::isfinite(wanted.lower)) words = fmt::format("<= {:.3g}", wanted.upper);
    if (!std::isfinite(wanted.upper)) words = fmt::format(">= {:.3g}", wanted.lower);
    return words + (figure.passes() ? "" : "  FAILS");
}

Json limit_json(double limit) {
    return std::isfinite(limit) ? Json(limit) : Json();
}

}  // namespace

std::string transport_text(const TransportSummary& summary) {
    std::string text = fmt::format(
        "verdict: {}\n{} spectra of another physics than the model's, cohort {}: {} consistent, {} suspect, {} failed\n"
        "The fits do not know what made the spectra: photons in plane layers that scatter by Henyey and Greenstein, "
        "with\n"
        "another melanin and another skin. Only what means the same in both is compared.\n\n",
        passes(summary) ? "passes" : "FAILS", summary.spectra, summary.cohort, summary.consistent,
        summary.spectra - summary.consistent - summary.failed, summary.failed);
    text += fmt::format("{:<30}{:<24}{:<19}{:>5}{:>10}{:>20}  {}\n", "quantity", "figure", "spectra", "n", "found",
                        "95 % interval", "wanted");
    for (const JudgedFigure& figure : summary.figures) {
        const Bounds& interval = figure.found.interval_95;
        const bool has_interval = interval.lower < interval.upper;
        text += fmt::format("{:<30}{:<24}{:<19}{:>5}{:>10.3g}{:>20}  {}\n", figure.quantity, figure.figure,
                            figure.spectra, figure.count, figure.found.value,
                            has_interval ? fmt::format("{:.3g} to {:.3g}", interval.lower, interval.upper) : "",
                            wanted_words(figure));
    }
    return text +
           "constant_error: of always answering the middle truth; regression_error: of a linear regression of log(1/R) "
           "on\n"
           "these very skins, 500 to 650 nm, each left out of its own. area: bilirubin above 0.01 g/L against none.\n"
           "mean_ratio: of estimate and truth, by logarithms. A figure fails where its whole 95 % interval lies beyond "
           "what\n"
           "is wanted. Dermal hemoglobin weighs each depth z of the dermis by exp(-z / 0.03 cm), here and there.\n";
}

Json transport_json(const TransportSummary& summary) {
    Json figures = Json::array();
    for (const JudgedFigure& figure : summary.figures) {
        figures.push_back({{"name", figure.quantity},
                           {"figure", figure.figure},
                           {"spectra", figure.spectra},
                           {"count", figure.count},
                           {"value", figure.found.value},
                           {"interval_95", {figure.found.interval_95.lower, figure.found.interval_95.upper}},
                           {"wanted", {limit_json(figure.wanted.lower), limit_json(figure.wanted.upper)}},
                           {"passes", figure.passes()}});
    }
    return {{"version", version},       {"passes", passes(summary)},  {"knows_model", false},
            {"cohort", summary.cohort}, {"spectra", summary.spectra}, {"consistent", summary.consistent},
            {"failed", summary.failed}, {"figures", figures}};
}

std::string transport_csv(const TransportStudy& study) {
    std::string text = "spectrum,verdict,name,truth,estimate,lower,upper\n";
    for (const TransportFit& fit : study.fits) {
        for (std::size_t place = 0; place < shared_quantity_count; ++place) {
            text += fmt::format("{},{},{},{}", fit.name, name_of(fit.verdict), shared_quantity_names[place],
                                fit.truth[place]);
            const auto& estimate = fit.estimate[place];
            text += estimate ? fmt::format(",{}", estimate->value) : ",";
            const bool has_interval = estimate && estimate->interval_95;
            text += has_interval ? fmt::format(",{},{}\n", estimate->interval_95->lower, estimate->interval_95->upper)
                                 : ",,\n";
        }
    }
    return text;
}

}  // namespace skinfit
