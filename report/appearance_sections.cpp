#include <fmt/format.h>

#include <algorithm>

#include "report/fit_sections.hpp"
#include "report/fitted_experiment.hpp"
#include "report/html_figure.hpp"
#include "report/html_table.hpp"
#include "report/light_budget.hpp"
#include "report/spectrum_colour.hpp"

namespace skinfit {
namespace {

std::string coordinates(const SpectrumColour& colour) {
    return fmt::format("{}{}", colour.hex, colour.is_in_gamut ? "" : ", cut: no display shows it");
}

std::vector<Html> colour_row(const std::string& name, const SpectrumColour& colour) {
    const auto cell = [](double value) { return escaped(fmt::format("{:.2f}", value)); };
    const std::optional<double> angle = colour.individual_typology_angle_deg;
    return {escaped(name),
            cell(colour.lab.l),
            cell(colour.lab.a),
            cell(colour.lab.b),
            escaped(angle ? fmt::format("{:.1f}", *angle) : "-"),
            escaped(angle ? name_of(skin_colour(*angle)) : "-")};
}

Html colour_of_spectrum(const FittedSpectrum& spectrum) {
    const std::string why_not = why_without_colour(spectrum);
    if (!why_not.empty()) return paragraph(fmt::format("{} has no colour here: {}.", spectrum.name, why_not));
    const FittedColour colours = fitted_colour(spectrum);
    const HtmlTable table{.caption = fmt::format("{}: CIELAB and individual typology angle", spectrum.name),
                          .columns = {{.name = "", .cells = Cells::text},
                                      {.name = "L*"},
                                      {.name = "a*"},
                                      {.name = "b*"},
                                      {.name = "ITA", .unit = "degrees"},
                                      {.name = "class", .cells = Cells::text}},
                          .rows = {colour_row("measured", colours.measured), colour_row("modelled", colours.modelled)}};
    return element("p", swatch(colours.measured.hex, "measured, " + coordinates(colours.measured)) +
                            swatch(colours.modelled.hex, "modelled, " + coordinates(colours.modelled))) +
           Html{"\n"} + html_table(table) +
           paragraph(fmt::format("CIEDE2000 between the two: {:.2f}; about 1 is just seen.", colours.ciede2000));
}

/// The budget of some spectra that share it.
struct SharedBudget {
    std::string names;
    std::vector<LightShares> budget;
};

std::vector<SharedBudget> budgets(const FitResult& result) {
    std::vector<SharedBudget> all;
    for (std::size_t k = 0; k < result.spectra.size(); ++k) {
        const FittedSpectrum& spectrum = result.spectra[k];
        std::vector<LightShares> budget = light_budget(fitted_experiment(result, k), spectrum.wavelength_nm);
        const auto same = std::ranges::find(all, budget, &SharedBudget::budget);
        if (same == all.end()) {
            all.push_back({.names = spectrum.name, .budget = std::move(budget)});
        } else {
            same->names += ", " + spectrum.name;
        }
    }
    return all;
}

Html budget_table(const std::vector<LightShares>& budget) {
    const std::vector<LightFate> fates = light_fates(budget);
    HtmlTable table{.caption = "", .columns = {{.name = "wavelength", .unit = "nm"}}, .rows = {}};
    for (const LightFate& fate : fates) table.columns.push_back({.name = fate.name});
    for (std::size_t i = 0; i < budget.size(); ++i) {
        std::vector<Html> row = {escaped(fmt::format("{:g}", budget[i].wavelength_nm))};
        for (const LightFate& fate : fates) row.push_back(escaped(fmt::format("{:.4f}", fate.share[i])));
        table.rows.push_back(std::move(row));
    }
    return html_table(table);
}

}  // namespace

HtmlSection colour_section(const FitResult& result) {
    HtmlSection section{
        .title = "Colour",
        .body = paragraph("As seen in daylight (D65) by the observer of 1931 [CIE15]; swatches are sRGB "
                          "[IEC61966], the difference is CIEDE2000 [SHARMA05], the angle and its classes "
                          "are those of [CHARDON91]. Beyond its ends a spectrum holds its value."),
        .starts_page = true};
    for (const FittedSpectrum& spectrum : result.spectra) section.body += colour_of_spectrum(spectrum);
    return section;
}

HtmlSection light_section(const FitResult& result) {
    HtmlSection section{
        .title = "Where the light goes",
        .body = paragraph("At the fitted values, by the angular solver: shares of the incident light, into "
                          "all directions and whatever the instrument sees of them, without its bandpass, "
                          "scale and offset. They add up to 1.")};
    for (const SharedBudget& each : budgets(result)) {
        section.body += html_figure({.picture = light_picture(each.budget),
                                     .alternative = fmt::format(
                                         "Shares of the light that are reflected, transmitted and absorbed in "
                                         "each layer, from {:g} to {:g} nm, stacked",
                                         each.budget.front().wavelength_nm, each.budget.back().wavelength_nm),
                                     .caption = each.names}) +
                        folded("The shares as a table", budget_table(each.budget));
    }
    return section;
}

}  // namespace skinfit
