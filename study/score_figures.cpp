#include <fmt/format.h>

#include "study/figure_script.hpp"

namespace skinfit {
namespace {

std::string unit_square() {
    return "set xrange [0:1]\nset yrange [0:1]\nset size ratio -1\nset tics 0.2\n" +
           gnuplot_data("identity", {0.0, 1.0}, {0.0, 1.0});
}

std::string area_text(const RocArea& area) {
    return fmt::format("area {:.3f}, 95 %: {:.3f} to {:.3f}", area.value, area.interval_95.lower,
                       area.interval_95.upper);
}

std::string curve_data(const std::vector<OperatingPoint>& curve) {
    std::vector<std::vector<double>> rows;
    for (const OperatingPoint& point : curve) {
        rows.push_back({1.0 - point.specificity->share(), point.sensitivity->share()});
    }
    return gnuplot_table("curve", rows);
}

/// x, y, and the ends of both intervals.
std::vector<double> marked_row(const OperatingPoint& point) {
    const Bounds& specificity = point.specificity->interval_95;
    const Bounds& sensitivity = point.sensitivity->interval_95;
    return {1.0 - point.specificity->share(), point.sensitivity->share(), 1.0 - specificity.upper,
            1.0 - specificity.lower,          sensitivity.lower,          sensitivity.upper};
}

}  // namespace

StudyFigure roc_figure(const RocAnalysis& roc, const std::vector<OperatingPoint>& marked, const std::string& title) {
    const auto rows = static_cast<int>(2 + marked.size());
    std::string script = figure_head({.title = title, .x = "1 - specificity", .y = "sensitivity"}) + unit_square() +
                         legend_below(rows, square_figure);
    std::string plot = fmt::format("plot $identity with lines {} title 'chance'", reference_look());
    if (roc.area) {
        script += curve_data(roc.curve);
        plot += fmt::format(", $curve with lines {} title {}", line_look(0), gnuplot_string(area_text(*roc.area)));
    } else {
        script += fmt::format("set label {} at graph 0.5,0.5 center front\n", gnuplot_string(roc.why_no_area));
    }
    std::size_t colour = 1;
    for (const OperatingPoint& point : marked) {
        if (!point.sensitivity || !point.specificity) continue;
        script += gnuplot_table(fmt::format("marked{}", colour), {marked_row(point)});
        plot += fmt::format(
            ", $marked{} with xyerrorbars {} title {}", colour, point_look(colour),
            gnuplot_string(fmt::format("from {:.4g}: sensitivity {:.2f}, specificity {:.2f}", point.threshold,
                                       point.sensitivity->share(), point.specificity->share())));
        ++colour;
    }
    return {.script = script + plot + "\n", .size = square_figure};
}

StudyFigure calibration_figure(const CalibrationAnalysis& calibration, const std::string& title) {
    std::vector<std::vector<double>> rows;
    for (const CalibrationBin& bin : calibration.bins) {
        rows.push_back({bin.mean_probability, bin.observed.share(), bin.observed.interval_95.lower,
                        bin.observed.interval_95.upper});
    }
    std::string brier =
        fmt::format("Brier score {:.3f}, expected {:.3f}", calibration.brier_score, calibration.expected_brier_score);
    if (calibration.spiegelhalter_p_value)
        brier += ", Spiegelhalter's test " + p_value_text(*calibration.spiegelhalter_p_value);
    const std::string bars = fmt::format("share of positive cases and 95 % interval, {} cases", calibration.cases);
    const std::string script =
        figure_head({.title = title, .x = "predicted probability", .y = "observed share"}) + unit_square() +
        gnuplot_table("bins", rows) + legend_below(3, square_figure) +
        fmt::format("plot $identity with lines {} title 'calibrated', $bins with yerrorbars {} title {}, {}\n",
                    reference_look(), point_look(0), gnuplot_string(bars), legend_text(brier));
    return {.script = script, .size = square_figure};
}

}  // namespace skinfit
