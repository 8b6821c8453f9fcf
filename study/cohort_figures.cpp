#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "fit/plot_colours.hpp"
#include "study/figure_script.hpp"

namespace skinfit {
namespace {

std::string tic_script(char axis, const std::vector<std::string>& names) {
    std::string script = fmt::format("set {}tics (", axis);
    for (std::size_t i = 0; i < names.size(); ++i) {
        script += fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_string(names[i]), i + 1);
    }
    return script + ")\n";
}

std::vector<double> numbers_of(const ValueGroup& group) {
    std::vector<double> numbers;
    std::ranges::copy_if(group.values, std::back_inserter(numbers), [](double value) { return std::isfinite(value); });
    return numbers;
}

/// A logarithmic axis with tics at 1, 2 and 5 of every decade from that of `low` to `high`, both above 0.
std::string logarithmic(char axis, double low, double high) {
    std::string script = fmt::format("set logscale {0}\nset {0}tics (", axis);
    const auto first = static_cast<int>(std::floor(std::log10(low)));
    for (int decade = first; std::pow(10.0, decade) <= high; ++decade) {
        const double unit = std::pow(10.0, decade);
        script += fmt::format("{}{:g}, {:g}, {:g}", decade == first ? "" : ", ", unit, 2.0 * unit, 5.0 * unit);
    }
    return script + fmt::format(")\nset {}range [{}:{}]\n", axis, low, high);
}

/// Numbers of subjects, evenly spread on a logarithmic scale.
std::vector<std::size_t> subject_numbers(std::size_t most) {
    constexpr double per_factor_e = 12.0;
    std::vector<std::size_t> numbers;
    const auto steps = static_cast<std::size_t>(std::ceil(per_factor_e * std::log(static_cast<double>(most) / 2.0)));
    for (std::size_t step = 0; step <= steps; ++step) {
        const double share = static_cast<double>(step) / static_cast<double>(steps);
        const auto number =
            static_cast<std::size_t>(std::lround(2.0 * std::pow(static_cast<double>(most) / 2.0, share)));
        if (numbers.empty() || number > numbers.back()) numbers.push_back(number);
    }
    return numbers;
}

}  // namespace

StudyFigure repeatability_figure(const std::vector<NamedScatter>& parameters, const std::string& title) {
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows;
    for (const NamedScatter& parameter : parameters) {
        names.push_back(parameter.name);
        const IntervalEstimate& ratio = parameter.claimed.ratio;
        rows.push_back(
            {ratio.value, static_cast<double>(names.size()), ratio.interval_95.lower, ratio.interval_95.upper});
    }
    constexpr int row_height = 32;
    constexpr int around_rows = 165;
    const auto count = static_cast<int>(names.size());
    const PictureSize size = {.width = wide_figure.width, .height = around_rows + count * row_height};
    const std::string script =
        figure_head({.title = title, .x = "within-specimen standard deviation / claimed sigma", .y = ""}) +
        tic_script('y', names) + gnuplot_table("ratios", rows) +
        gnuplot_table("one", {{1.0, 0.5}, {1.0, count + 0.5}}) + legend_below(2, size) +
        fmt::format("set yrange [{}:0.5]\nset logscale x 2\n", count + 0.5) +
        fmt::format(
            "plot $one with lines {} title 'as claimed', $ratios with xerrorbars {} title 'found, with 95 % "
            "interval'\n",
            reference_look(), point_look(0));
    return {.script = script, .size = size};
}

StudyFigure group_figure(const std::vector<ValueGroup>& groups, const ComparedQuantity& quantity) {
    std::string script = figure_head({.title = quantity.name, .x = "", .y = with_unit(quantity.name, quantity.unit)});
    std::vector<std::string> names;
    std::string plot;
    for (const ValueGroup& group : groups) {
        const std::vector<double> numbers = numbers_of(group);
        names.push_back(fmt::format("{}, n = {}", group.name, numbers.size()));
        if (numbers.empty()) continue;
        const std::size_t place = names.size();
        script += gnuplot_data(fmt::format("group{}", place), numbers, numbers);
        plot += fmt::format(
            "{0} $group{1} using ({1}):1 with boxplot linewidth 1.5 linecolor rgb '#000000' notitle, "
            "$group{1} using ({1}):1 with points {2} notitle",
            plot.empty() ? "plot" : ",", place, point_look((place - 1) % plot_colours.size()));
    }
    assert(!plot.empty());
    script += tic_script('x', names) + fmt::format("set xrange [0.4:{}]\n", static_cast<double>(names.size()) + 0.6);
    script += "set style boxplot nooutliers\nset style fill empty\nset boxwidth 0.5\nset jitter spread 0.5\n";
    return {.script = script + plot + "\n", .size = wide_figure};
}

StudyFigure power_figure(const std::vector<NamedDesign>& designs, double power, std::size_t most_subjects,
                         const ComparedQuantity& quantity) {
    assert(!designs.empty() && most_subjects > 2);
    std::string script =
        figure_head({.title = fmt::format("{}: difference found in {:g} % of studies", quantity.name, 100.0 * power),
                     .x = "subjects per group",
                     .y = with_unit("true difference of group means", quantity.unit)});
    std::string plot = "plot ";
    double low = std::numeric_limits<double>::infinity();
    double high = 0.0;
    for (std::size_t i = 0; i < designs.size(); ++i) {
        std::vector<std::vector<double>> rows;
        for (const std::size_t subjects : subject_numbers(most_subjects)) {
            const std::optional<double> difference = detectable_difference(designs[i].design, subjects, power);
            assert(difference);
            rows.push_back({static_cast<double>(subjects), difference.value_or(0.0)});
            low = std::min(low, rows.back()[1]);
            high = std::max(high, rows.back()[1]);
        }
        script += gnuplot_table(fmt::format("design{}", i), rows);
        plot += fmt::format("{}$design{} with lines {} title {}", i == 0 ? "" : ", ", i, line_look(i),
                            gnuplot_string(designs[i].name));
    }
    script += logarithmic('x', 2.0, static_cast<double>(most_subjects)) + logarithmic('y', 0.9 * low, 1.1 * high);
    return {.script = script + "set key right top\n" + plot + "\n", .size = wide_figure};
}

}  // namespace skinfit
