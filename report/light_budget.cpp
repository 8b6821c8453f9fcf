#include "report/light_budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "fit/gnuplot.hpp"

namespace skinfit {
namespace {

std::vector<double> spread(const std::vector<double>& wavelength_nm) {
    constexpr std::size_t most = 61;
    if (wavelength_nm.size() <= most) return wavelength_nm;
    std::vector<double> even;
    for (std::size_t i = 0; i < most; ++i) {
        const double share = static_cast<double>(i) / (most - 1);
        even.push_back(std::lerp(wavelength_nm.front(), wavelength_nm.back(), share));
    }
    return even;
}

std::string area_script(const std::vector<LightShares>& budget, const std::vector<LightFate>& fates) {
    std::string data;
    std::string plots;
    std::vector<double> bottom(budget.size(), 0.0);
    for (std::size_t k = 0; k < fates.size(); ++k) {
        std::vector<double> around_nm;
        std::vector<double> outline;
        for (std::size_t i = 0; i < budget.size(); ++i) {
            around_nm.push_back(budget[i].wavelength_nm);
            outline.push_back(bottom[i] + fates[k].share[i]);
        }
        for (std::size_t i = budget.size(); i-- > 0;) {
            around_nm.push_back(budget[i].wavelength_nm);
            outline.push_back(bottom[i]);
        }
        std::copy_n(outline.begin(), budget.size(), bottom.begin());
        data += gnuplot_data(fmt::format("fate{}", k), around_nm, outline);
        // The legend stands in the order of the areas, from above.
        plots = fmt::format(
            "$fate{} with filledcurves closed fillcolor rgb '{}' fillstyle solid border linecolor rgb '#ffffff' title "
            "{}{}{}",
            k, fates[k].colour, gnuplot_string(fates[k].name), k == 0 ? "" : ", ", plots);
    }
    return data + "plot " + plots + "\n";
}

}  // namespace

std::vector<LightShares> light_budget(const Experiment& experiment, const std::vector<double>& wavelength_nm) {
    const std::vector<double> stated_nm = spread(wavelength_nm);
    const std::vector<double> true_nm = true_wavelengths_nm(experiment, stated_nm);
    const AngularSolver solver = angular_solver(experiment);
    std::vector<LightShares> budget;
    for (std::size_t i = 0; i < stated_nm.size(); ++i) {
        const AngularResponse light = solver.shares(true_nm[i]);
        budget.push_back({.wavelength_nm = stated_nm[i],
                          .surface = light.surface.share,
                          .reflected = light.reflected.share,
                          .transmitted = light.transmitted.share,
                          .absorbed = light.absorbed});
    }
    return budget;
}

std::vector<LightFate> light_fates(const std::vector<LightShares>& budget) {
    constexpr std::array<std::string_view, layer_count> colours = {"#e8cf9c", "#7f5539", "#e07a6a", "#a4243b"};
    std::vector<LightFate> fates;
    const auto add = [&](const std::string& name, std::string_view colour, const auto& share_of) {
        LightFate fate{.name = name, .colour = std::string(colour), .share = {}};
        for (const LightShares& shares : budget) fate.share.push_back(share_of(shares));
        if (*std::ranges::max_element(fate.share) > 0.0) fates.push_back(std::move(fate));
    };
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
        add("absorbed: " + layer_in_words(layer), colours[layer],
            [layer](const LightShares& shares) { return shares.absorbed[layer]; });
    }
    add("transmitted", "#5b8db8", [](const LightShares& shares) { return shares.transmitted; });
    add("reflected from below", "#f1ece4", [](const LightShares& shares) { return shares.reflected; });
    add("reflected by the surface", "#b9c0c6", [](const LightShares& shares) { return shares.surface; });
    return fates;
}

std::string light_picture(const std::vector<LightShares>& budget) {
    return gnuplot_picture("set encoding utf8\n" + gnuplot_terminal("light.svg", {.width = 960, .height = 440}) +
                           fmt::format("set xrange [{}:{}]\nset yrange [0:1]\n", budget.front().wavelength_nm,
                                       budget.back().wavelength_nm) +
                           "set xlabel 'wavelength, nm'\nset ylabel 'share of the incident light'\n"
                           "set key outside right top Left reverse samplen 2 spacing 1.4\nset tics front\n" +
                           area_script(budget, light_fates(budget)));
}

}  // namespace skinfit
