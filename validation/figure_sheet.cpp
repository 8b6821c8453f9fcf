#include <fmt/format.h>

#include <algorithm>

#include "fit/wavelength_sets.hpp"
#include "validation/figure_names.hpp"
#include "validation/figure_output.hpp"

namespace skinfit {
namespace {

std::string title_of(const FigurePanel& panel, const FigureVariant& variant) {
    return fmt::format("{}: {}, r = {} nm", panel.title, name_of(variant.edition), variant.fibril_radius_nm);
}

double middle_deg(const AngularCurve& curve, std::size_t step) {
    return 0.5 * (curve.edge_deg(step) + curve.edge_deg(step + 1));
}

/// From the horizon behind the light over the normal to the horizon away from it.
SheetLine in_plane(const AngularCurve& curve) {
    SheetLine line{.label = curve.name, .x = {}, .y = {}};
    for (std::size_t i = curve.backward.size(); i-- > 0;) {
        line.x.push_back(-middle_deg(curve, i));
        line.y.push_back(curve.backward[i].per_sr);
    }
    for (std::size_t i = 0; i < curve.forward.size(); ++i) {
        line.x.push_back(middle_deg(curve, i));
        line.y.push_back(curve.forward[i].per_sr);
    }
    return line;
}

SheetLine rings(const AngularCurve& curve) {
    SheetLine line{.label = curve.name, .x = {}, .y = {}};
    for (std::size_t i = 0; i < curve.ring.size(); ++i) {
        line.x.push_back(middle_deg(curve, i));
        line.y.push_back(curve.ring[i].per_sr);
    }
    return line;
}

/// The rendered colours, each with the coordinate that the panel's claim is about.
std::vector<Swatch> swatches(const FigurePanel& panel, const VariantResult& result) {
    std::vector<Swatch> patches;
    if (!panel.has_swatches) return patches;
    const bool is_yellow = std::ranges::find(panel.claims, Claim::yellower_in_order) != panel.claims.end();
    for (const RenderedColour& colour : result.colours) {
        patches.push_back(
            {.colour = colour.srgb,
             .label = is_yellow ? fmt::format("b* {:.1f}", colour.lab.b) : fmt::format("a* {:.1f}", colour.lab.a)});
    }
    return patches;
}

SheetPanel sheet_panel(const FigurePanel& panel, const VariantResult& result, const std::optional<Spectrum>& measured) {
    SheetPanel drawn{.title = title_of(panel, result.variant), .lines = {}, .swatches = swatches(panel, result)};
    for (const SpectralCurve& curve : result.spectra) {
        drawn.lines.push_back({.label = curve.name, .x = curve.wavelength_nm, .y = curve.value});
    }
    for (const AngularCurve& curve : result.lobes) {
        drawn.lines.push_back(panel.light == FigureLight::transmitted ? rings(curve) : in_plane(curve));
    }
    if (measured) {
        SheetLine line{.label = "measured", .x = {}, .y = {}, .style = LineStyle::reference};
        const std::vector<double>& computed_nm = result.spectra.front().wavelength_nm;
        for (std::size_t i = 0; i < measured->wavelength_nm.size(); ++i) {
            const double at_nm = measured->wavelength_nm[i];
            if (at_nm < computed_nm.front() || at_nm > computed_nm.back()) continue;
            line.x.push_back(at_nm);
            line.y.push_back(measured->value[i]);
        }
        if (!line.x.empty()) drawn.lines.push_back(std::move(line));
    }
    return drawn;
}

std::string y_label(const Figure& figure, const FigurePanel& panel) {
    if (figure.kind == FigureKind::extinction) return "extinction (per cm per g/L)";
    if (figure.kind == FigureKind::spectrum) return fmt::format("{} (fraction)", quantity_name(figure.kind, panel));
    switch (panel.light) {
        case FigureLight::transmitted:
            return "BTDF (1/sr)";
        case FigureLight::subsurface:
            return "subsurface BRDF (1/sr)";
        default:
            return "BRDF (1/sr)";
    }
}

/// A row without panels.
SheetRow axes(const Figure& figure, const FigurePanel& panel) {
    SheetRow row{
        .x_label = "wavelength (nm)", .y_label = y_label(figure, panel), .x_low = 0, .x_high = 0, .panels = {}};
    if (figure.kind != FigureKind::goniophotometer) {
        const std::vector<double> wavelengths_nm =
            parse_wavelengths(panel.series.front().configuration.wavelengths, "wavelengths");
        row.x_low = wavelengths_nm.front();
        row.x_high = wavelengths_nm.back();
    } else if (panel.light == FigureLight::transmitted) {
        row.x_label = "angle to the normal below (degrees)";
        row.x_high = 90.0;
    } else {
        row.x_label = "angle to the normal, forward > 0 (degrees)";
        row.x_low = -90.0;
        row.x_high = 90.0;
    }
    return row;
}

}  // namespace

PlotSheet figure_sheet(const FigureResult& result) {
    PlotSheet sheet{.title = result.figure.title, .rows = {}};
    for (std::size_t p = 0; p < result.panels.size(); ++p) {
        const FigurePanel& panel = result.figure.panels[p];
        SheetRow row = axes(result.figure, panel);
        for (const VariantResult& variant : result.panels[p].variants) {
            row.panels.push_back(sheet_panel(panel, variant, result.panels[p].measured));
        }
        sheet.rows.push_back(std::move(row));
    }
    return sheet;
}

}  // namespace skinfit
