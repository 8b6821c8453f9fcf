#include <fmt/format.h>

#include "core/version.hpp"
#include "validation/figure_names.hpp"
#include "validation/figure_output.hpp"

namespace skinfit {
namespace {

/// A cell in quotes, so that commas in titles and names do no harm.
std::string csv_cell(std::string_view text) {
    std::string cell = "\"";
    for (const char c : text) {
        cell += c;
        if (c == '"') cell += c;
    }
    return cell + "\"";
}

std::string place(const FigurePanel& panel, const FigureVariant& variant, const std::string& series) {
    return fmt::format("{},{},{},{}", csv_cell(panel.title), name_of(variant.edition), variant.fibril_radius_nm,
                       csv_cell(series));
}

std::string comments(const FigureResult& result) {
    std::string text = fmt::format("# skinfit {} validation\n# figure: {}\n", version, result.figure.title);
    for (const auto& [key, source] : result.figure.sources.items()) {
        text += fmt::format("# {}: {}\n", key, source.get<std::string>());
    }
    for (std::size_t p = 0; p < result.panels.size(); ++p) {
        for (const VariantResult& variant : result.panels[p].variants) {
            for (std::size_t i = 0; i < variant.colours.size(); ++i) {
                const RenderedColour& colour = variant.colours[i];
                text += fmt::format("# colour: {}: L* {:.2f}, a* {:.2f}, b* {:.2f}, sRGB {}{}\n",
                                    place(result.figure.panels[p], variant.variant, variant.spectra[i].name),
                                    colour.lab.l, colour.lab.a, colour.lab.b, colour.srgb,
                                    colour.is_in_gamut ? "" : " (outside the display's gamut, cut)");
            }
        }
    }
    return text;
}

std::string spectral_rows(const FigurePanel& panel, const VariantResult& variant) {
    std::string rows;
    for (const SpectralCurve& curve : variant.spectra) {
        for (std::size_t i = 0; i < curve.value.size(); ++i) {
            rows += fmt::format("{},{},{}\n", place(panel, variant.variant, curve.name), curve.wavelength_nm[i],
                                curve.value[i]);
        }
    }
    return rows;
}

std::string angular_rows(const FigurePanel& panel, const VariantResult& variant) {
    std::string rows;
    const auto add = [&](const AngularCurve& curve, std::string_view kind, const std::vector<BrdfValue>& values) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            rows += fmt::format("{},{},{},{},{},{}\n", place(panel, variant.variant, curve.name), kind,
                                curve.edge_deg(i), curve.edge_deg(i + 1), values[i].per_sr, values[i].standard_error);
        }
    };
    for (const AngularCurve& curve : variant.lobes) {
        add(curve, "inplane_forward", curve.forward);
        add(curve, "inplane_back", curve.backward);
        add(curve, "ring", curve.ring);
    }
    return rows;
}

}  // namespace

std::string figure_csv(const FigureResult& result) {
    const bool is_angular = result.figure.kind == FigureKind::goniophotometer;
    std::string text = comments(result) + "panel,edition,fibril_radius_nm,series,";
    text += is_angular
                ? "kind,polar_lo_deg,polar_hi_deg,bsdf_per_sr,bsdf_se\n"
                : fmt::format("wavelength_nm,{}\n", quantity_name(result.figure.kind, result.figure.panels.front()));
    for (std::size_t p = 0; p < result.panels.size(); ++p) {
        for (const VariantResult& variant : result.panels[p].variants) {
            text += is_angular ? angular_rows(result.figure.panels[p], variant)
                               : spectral_rows(result.figure.panels[p], variant);
        }
    }
    return text;
}

}  // namespace skinfit
