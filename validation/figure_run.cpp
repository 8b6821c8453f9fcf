#include "validation/figure_run.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "fit/problem.hpp"
#include "fit/wavelength_sets.hpp"
#include "model/spectrophotometer.hpp"
#include "validation/angular_claims.hpp"
#include "validation/figure_names.hpp"
#include "validation/shipped.hpp"
#include "validation/spectral_claims.hpp"

namespace skinfit {
namespace {

Configuration under(const FigureVariant& variant, Configuration configuration) {
    configuration.edition = variant.edition;
    configuration.values.skin.fibril_radius_nm = variant.fibril_radius_nm;
    return configuration;
}

SpectralCurve spectrum_of(const std::string& name, const Configuration& configuration) {
    const std::vector<double> wavelengths_nm = parse_wavelengths(configuration.wavelengths, "wavelengths");
    const bool is_transmittance = configuration.quantity.value_or(default_quantity) == Quantity::transmittance;
    SpectralCurve curve{.name = name, .wavelength_nm = wavelengths_nm, .value = {}};
    for (const Reading& reading : read_by_solver(make_experiment(configuration), wavelengths_nm)) {
        curve.value.push_back(is_transmittance ? reading.transmittance : reading.reflectance);
    }
    return curve;
}

SpectralCurve extinction_of(const std::string& pigment, const Configuration& configuration) {
    const auto row = std::ranges::find(pigment_table(), pigment, &PigmentRow::name);
    SpectralCurve curve{
        .name = pigment, .wavelength_nm = parse_wavelengths(configuration.wavelengths, "wavelengths"), .value = {}};
    const Edition edition = make_experiment(configuration).edition;
    for (const double nm : curve.wavelength_nm) {
        curve.value.push_back(Extinction::at(nm, edition).*row->extinction);
    }
    return curve;
}

Light light_of(FigureLight light) {
    switch (light) {
        case FigureLight::subsurface:
            return Light::subsurface;
        case FigureLight::transmitted:
            return Light::transmitted;
        default:
            return Light::reflected;
    }
}

AngularCurve lobe_of(const std::string& name, FigureLight shown, const Configuration& configuration,
                     const FigureOptions& options) {
    const Experiment experiment = make_experiment(configuration);
    const std::vector<double> wavelengths_nm = parse_wavelengths(configuration.wavelengths, "wavelengths");
    const AngularBins bins{.polar = 18, .azimuth = 18};
    const AngularSpectrum spectrum{
        .bins = bins,
        .counts = goniophotometer(experiment.sample(), wavelengths_nm,
                                  {.incidence = {experiment.incidence_rad, experiment.incidence_rad},
                                   .rays = options.rays.value_or(configuration.rays),
                                   .seed = options.seed.value_or(configuration.seed),
                                   .first_ray = 0,
                                   .bins = bins}),
        .weights = std::vector<double>(wavelengths_nm.size(), 1.0)};
    const Light light = light_of(shown);
    AngularCurve curve{.name = name,
                       .incidence_deg = configuration.incidence_deg.value_or(default_incidence_deg),
                       .ring = {},
                       .forward = {},
                       .backward = {}};
    for (int polar = 0; polar < bins.polar; ++polar) {
        curve.ring.push_back(brdf(spectrum, light, polar));
        curve.forward.push_back(brdf(spectrum, light, polar, 0));
        curve.backward.push_back(brdf(spectrum, light, polar, bins.azimuth / 2));
    }
    return curve;
}

ClaimFinding judged(Claim claim, const VariantResult& result, const std::optional<Spectrum>& measured) {
    if (info(claim).needs_measured && !measured) {
        return {.verdict = ClaimVerdict::skipped, .number = 0.0, .measure = "", .why = "the measurement is not here"};
    }
    std::vector<Lab> colours;
    for (const RenderedColour& colour : result.colours) colours.push_back(colour.lab);
    switch (claim) {
        case Claim::falls_with_wavelength:
            return falls_with_wavelength(result.spectra);
        case Claim::darker_in_order:
            return darker_in_order(result.spectra);
        case Claim::w_deepens_in_order:
            return w_deepens_in_order(result.spectra);
        case Claim::close_to_measured:
            return close_to_measured(result.spectra, *measured);
        case Claim::measured_within:
            return measured_within(result.spectra, *measured);
        case Claim::redder_in_order:
            return redder_in_order(colours);
        case Claim::yellower_in_order:
            return yellower_in_order(colours);
        case Claim::more_directional_in_order:
            return more_directional_in_order(result.lobes);
        default:
            return near_lambertian(result.lobes);
    }
}

bool needs_colours(const FigurePanel& panel) {
    const auto is_of_colour = [](Claim claim) {
        return claim == Claim::redder_in_order || claim == Claim::yellower_in_order;
    };
    return panel.has_swatches || std::ranges::any_of(panel.claims, is_of_colour);
}

VariantResult run_variant(const FigurePanel& panel, FigureKind kind, const FigureVariant& variant,
                          const std::optional<Spectrum>& measured, const FigureOptions& options) {
    VariantResult result{.variant = variant, .spectra = {}, .colours = {}, .lobes = {}, .findings = {}};
    if (kind == FigureKind::extinction) {
        for (const FigureSeries& series : panel.series) {
            result.spectra.push_back(extinction_of(series.name, under(variant, series.configuration)));
        }
    } else if (kind == FigureKind::spectrum) {
        result.spectra.resize(panel.series.size());
        tbb::parallel_for(std::size_t{0}, panel.series.size(), [&](std::size_t i) {
            const FigureSeries& series = panel.series[i];
            result.spectra[i] = spectrum_of(series.name, under(variant, series.configuration));
        });
        if (needs_colours(panel)) {
            for (const SpectralCurve& curve : result.spectra) result.colours.push_back(rendered(curve));
        }
    } else {
        for (const FigureSeries& series : panel.series) {
            result.lobes.push_back(lobe_of(series.name, panel.light, under(variant, series.configuration), options));
        }
    }
    for (const Claim claim : panel.claims) result.findings.push_back(judged(claim, result, measured));
    return result;
}

}  // namespace

FigureResult run_figure(const Figure& figure, const FigureOptions& options) {
    FigureResult result{.figure = figure, .panels = {}, .messages = {}};
    for (const FigurePanel& panel : figure.panels) {
        PanelResult panel_result;
        if (panel.measured) panel_result.measured = measured_spectrum(*panel.measured, options.shared_folder);
        if (panel.measured && !panel_result.measured) {
            result.messages.push_back(fmt::format(
                "figure {}: no comparison with {}, which is not shipped{}; --shared names its folder", figure.number,
                *panel.measured,
                options.shared_folder.empty() ? "" : fmt::format(" and not in {}", options.shared_folder.string())));
        }
        for (const FigureVariant& variant : figure.variants) {
            panel_result.variants.push_back(run_variant(panel, figure.kind, variant, panel_result.measured, options));
        }
        result.panels.push_back(std::move(panel_result));
    }
    return result;
}

}  // namespace skinfit
