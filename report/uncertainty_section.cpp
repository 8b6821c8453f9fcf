#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/fit_sections.hpp"
#include "report/html_figure.hpp"
#include "report/html_table.hpp"
#include "report/posterior_picture.hpp"
#include "report/profile_picture.hpp"

namespace skinfit {
namespace {

/// White at 0, blue at 1, red at -1; dark text is readable on all of it.
std::string correlation_colour(double correlation) {
    const double size = std::min(std::abs(correlation), 1.0);
    const auto shade = [size](double full) { return static_cast<int>(std::lround(255.0 + size * (full - 255.0))); };
    return correlation > 0.0 ? fmt::format("#{:02x}{:02x}{:02x}", shade(120), shade(170), shade(225))
                             : fmt::format("#{:02x}{:02x}{:02x}", shade(240), shade(150), shade(125));
}

Html correlation_map(const FitResult& result) {
    HtmlTable table{.caption = "Correlations of the free parameters; columns are numbered as rows",
                    .columns = {{.name = "parameter", .cells = Cells::text}},
                    .rows = {}};
    for (std::size_t a = 0; a < result.free.size(); ++a) {
        table.columns.push_back({.name = fmt::format("{}", a + 1)});
        std::vector<Html> row = {escaped(fmt::format("{} {}", a + 1, result.free[a].name))};
        for (std::size_t b = 0; b < result.free.size(); ++b) {
            const double value = result.correlation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
            row.push_back(element("span", escaped(fmt::format("{:+.2f}", value)),
                                  {{"class", "shade"}, {"style", "background-color:" + correlation_colour(value)}}));
        }
        table.rows.push_back(std::move(row));
    }
    return html_table(table);
}

Html kind(const FitResult& result) {
    std::string text = "Intervals come from the covariance, the model linearised at the minimum.";
    if (result.profile) {
        text = fmt::format("Intervals come from the profile likelihood, {} evaluations; they are right at bounds.",
                           result.profile->evaluations);
    }
    if (result.posterior) text = "Intervals come from the posterior, with equal tails.";
    if (result.inflation) {
        text += fmt::format(
            " Sigmas are those of {}; were the whole misfit noise, they would be {:.2g} times as large (sqrt(chi2 / "
            "degrees of freedom)).",
            result.configuration.discrepancy ? "noise and discrepancy together" : "the stated noise",
            *result.inflation);
    }
    return paragraph(text);
}

Html directions(const Identifiability& found) {
    HtmlTable table{.caption =
                        "What the spectrum can tell, best known first: by how many sigmas of noise it changes where "
                        "parameters change by one standard deviation of what was known before, their priors or bounds",
                    .columns = {{.name = "direction", .cells = Cells::text},
                                {.name = "sigmas of noise"},
                                {.name = "remark", .cells = Cells::text}},
                    .rows = {}};
    for (const Direction& direction : found.directions) {
        table.rows.push_back({escaped(in_words(direction, found.names)),
                              escaped(fmt::format("{:.3g}", direction.singular_value)),
                              escaped(direction.is_weak() ? "WEAK" : "")});
    }
    return html_table(table);
}

Html shrinkage(const Identifiability& found) {
    HtmlTable table{.caption = "How much of the variance known before the spectrum takes away",
                    .columns = {{.name = "parameter", .cells = Cells::text}, {.name = "share", .unit = "%"}},
                    .rows = {}};
    for (std::size_t i = 0; i < found.names.size(); ++i) {
        table.rows.push_back({escaped(found.names[i]), escaped(fmt::format("{:.1f}", 100.0 * found.shrinkage[i]))});
    }
    return html_table(table);
}

Html profiles(const FitResult& result) {
    return subheading("Profiles") +
           html_figure(
               {.picture = profile_picture(result),
                .alternative = "The rise of the cost along each free parameter, with the ends of the 95 % interval",
                .caption =
                    "How much the cost (chi2, and what priors add) rises above its minimum when one parameter is "
                    "held and the others are adjusted again. Dots: evaluated; the line meets their rises and "
                    "slopes. A value belongs to the interval up to the threshold, which is lower near a bound. "
                    "Where the line leaves that of the covariance, a parabola but for a prior, the covariance "
                    "misjudges the interval; a parameter without sigma has none."});
}

Html posterior(const FitResult& result) {
    const Posterior& sampled = *result.posterior;
    HtmlTable table{
        .caption = fmt::format(
            "Posterior: {} chains of {} draws, steps that went astray (divergences): {}, {} evaluations. R-hat: "
            "1 where the chains agree; effective draws: how many independent ones tell as much",
            sampled.chains, sampled.draws.cols() / sampled.chains, sampled.divergences, sampled.evaluations),
        .columns = {{.name = "parameter", .cells = Cells::text},
                    {.name = "median"},
                    {.name = "deviation"},
                    {.name = "R-hat"},
                    {.name = "effective draws: bulk"},
                    {.name = "tails"}},
        .rows = {}};
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const Marginal& row = sampled.marginals[i];
        table.rows.push_back({escaped(result.free[i].name), escaped(fmt::format("{:.4g}", row.median)),
                              escaped(fmt::format("{:.2g}", row.sigma)), escaped(fmt::format("{:.3f}", row.r_hat)),
                              escaped(fmt::format("{:.0f}", row.bulk_effective_size)),
                              escaped(fmt::format("{:.0f}", row.tail_effective_size))});
    }
    Html part = subheading("Posterior") + html_table(table);
    const std::string picture = posterior_picture(result);
    if (picture.empty()) return part;
    return part +
           html_figure({.picture = picture,
                        .alternative = "Histograms of the posterior's draws, one for each free parameter",
                        .caption = "Draws of each parameter; dashed: the ends of the 95 % interval, red: the best "
                                   "fit."});
}

}  // namespace

HtmlSection uncertainty_section(const FitResult& result) {
    HtmlSection section{.title = "How sure", .body = kind(result) + correlation_map(result)};
    if (result.profile) section.body += profiles(result);
    if (result.posterior) section.body += posterior(result);
    section.body += directions(result.identifiability) + shrinkage(result.identifiability);
    return section;
}

}  // namespace skinfit
