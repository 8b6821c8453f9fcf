#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/plot_colours.hpp"
#include "study/figure_script.hpp"

namespace skinfit {
namespace {

/// Both ends of an axis.
struct PlotRange {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    [[nodiscard]] PlotRange with(double value) const { return {std::min(low, value), std::max(high, value)}; }
    [[nodiscard]] std::string script(char axis) const {
        const double margin = high > low ? 0.05 * (high - low) : 1.0;
        return fmt::format("set {}range [{}:{}]\n", axis, low - margin, high + margin);
    }
};

bool is_complete(const ReferencePair& pair) {
    return std::isfinite(pair.estimate) && std::isfinite(pair.reference);
}

std::string level_script(const IntervalEstimate& level, std::size_t colour) {
    return fmt::format(
        "set object rectangle from graph 0,first {} to graph 1,first {} behind fillcolor rgb '{}' fillstyle solid 0.15 "
        "noborder\n",
        level.interval_95.lower, level.interval_95.upper, plot_colours.at(colour));
}

std::string level_plot(const IntervalEstimate& level, std::size_t colour, const std::string& name,
                       const std::string& unit) {
    const std::string text = fmt::format("{} {:.3g}, 95 %: {:.3g} to {:.3g}", with_unit(name, unit), level.value,
                                         level.interval_95.lower, level.interval_95.upper);
    return fmt::format(", {} with lines {} title {}", level.value, line_look(colour), gnuplot_string(text));
}

}  // namespace

StudyFigure bland_altman_figure(const std::vector<ReferencePair>& pairs, const MethodAgreement& agreement,
                                const ComparedQuantity& quantity) {
    std::vector<std::vector<double>> rows;
    PlotRange x;
    PlotRange y =
        PlotRange().with(agreement.lower_limit.interval_95.lower).with(agreement.upper_limit.interval_95.upper);
    for (const ReferencePair& pair : pairs) {
        if (!is_complete(pair)) continue;
        rows.push_back({0.5 * (pair.estimate + pair.reference), pair.estimate - pair.reference});
        x = x.with(rows.back()[0]);
        y = y.with(rows.back()[1]);
    }
    const PictureSize size = {.width = wide_figure.width, .height = 520};
    const std::string script =
        figure_head({.title = fmt::format("{}: estimate - reference, {} pairs", quantity.name, agreement.pairs),
                     .x = with_unit("mean of estimate and reference", quantity.unit),
                     .y = with_unit("estimate - reference", quantity.unit)}) +
        gnuplot_table("pairs", rows) + legend_below(3, size) + x.script('x') + y.script('y') +
        level_script(agreement.bias, 0) + level_script(agreement.lower_limit, 1) +
        level_script(agreement.upper_limit, 1) + fmt::format("plot $pairs with points {} notitle", point_look(5)) +
        level_plot(agreement.upper_limit, 1, "upper limit of agreement", quantity.unit) +
        level_plot(agreement.bias, 0, "bias", quantity.unit) +
        level_plot(agreement.lower_limit, 1, "lower limit of agreement", quantity.unit) + "\n";
    return {.script = script, .size = size};
}

StudyFigure reference_figure(const std::vector<ReferencePair>& pairs, const MethodAgreement& agreement,
                             const ComparedQuantity& quantity) {
    std::vector<std::vector<double>> rows;
    PlotRange range;
    for (const ReferencePair& pair : pairs) {
        if (!is_complete(pair)) continue;
        rows.push_back({pair.reference, pair.estimate, pair.sigma.value_or(0.0)});
        range = range.with(pair.reference).with(pair.estimate);
    }
    std::string script = figure_head({.title = fmt::format("{}: {} pairs", quantity.name, agreement.pairs),
                                      .x = with_unit("reference", quantity.unit),
                                      .y = with_unit("estimate", quantity.unit)}) +
                         gnuplot_table("pairs", rows) + "set size ratio -1\n" + legend_below(4, square_figure) +
                         range.script('x') + range.script('y');
    const std::string points = agreement.claimed ? "estimates -/+ 1 sigma" : "estimates";
    script += fmt::format("plot x with lines {} title 'identity', $pairs with {} {} title {}", reference_look(),
                          agreement.claimed ? "yerrorbars" : "points", point_look(0), gnuplot_string(points));
    if (agreement.line) {
        const AgreementLine& line = *agreement.line;
        script +=
            fmt::format(", {} + {} * x with lines {} title {}", line.intercept.value, line.slope.value, line_look(3),
                        gnuplot_string(fmt::format("slope {:.3f}, 95 %: {:.3f} to {:.3f}", line.slope.value,
                                                   line.slope.interval_95.lower, line.slope.interval_95.upper)));
    }
    if (agreement.concordance && agreement.pearson) {
        script += ", " + legend_text(fmt::format("concordance {:.3f}, Pearson's r {:.3f}", agreement.concordance->value,
                                                 agreement.pearson->value));
    }
    return {.script = script + "\n", .size = square_figure};
}

}  // namespace skinfit
