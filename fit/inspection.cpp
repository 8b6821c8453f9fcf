#include "fit/inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "measurements/quality_checks.hpp"
#include "model/chromophores.hpp"

namespace skinfit {
namespace {

/// What `member` is in all spectra, where that is the same.
template <class Value, class Member>
std::optional<Value> shared(const std::vector<Spectrum>& spectra, Member member) {
    const std::optional<Value> first = member(spectra.front());
    const bool same = std::ranges::all_of(spectra, [&](const Spectrum& each) { return member(each) == first; });
    return same ? first : std::nullopt;
}

std::optional<Bandpass> shared_bandpass(const std::vector<Spectrum>& spectra) {
    const std::optional<Bandpass>& first = spectra.front().bandpass;
    const bool same = std::ranges::all_of(spectra, [&](const Spectrum& each) {
        return first && each.bandpass && each.bandpass->shape == first->shape &&
               each.bandpass->width_nm == first->width_nm;
    });
    return same ? first : std::nullopt;
}

/// The texts that `member` is in some spectrum, each once, in order.
template <class Member>
std::string all_texts(const std::vector<Spectrum>& spectra, Member member) {
    std::vector<std::string> texts;
    std::string joined;
    for (const Spectrum& spectrum : spectra) {
        const std::string& text = spectrum.*member;
        if (text.empty() || std::ranges::find(texts, text) != texts.end()) continue;
        texts.push_back(text);
        joined += joined.empty() ? text : "; " + text;
    }
    return joined;
}

/// The step of all wavelengths of all spectra.
std::optional<double> step_of(const std::vector<Spectrum>& spectra) {
    constexpr double rounding = 1e-6;  // of wavelengths as files print them
    std::optional<double> step;
    for (const Spectrum& spectrum : spectra) {
        for (std::size_t i = 1; i < spectrum.wavelength_nm.size(); ++i) {
            const double difference = spectrum.wavelength_nm[i] - spectrum.wavelength_nm[i - 1];
            if (!step) step = difference;
            if (std::abs(difference - *step) > rounding * *step * static_cast<double>(spectrum.wavelength_nm.size())) {
                return std::nullopt;
            }
        }
    }
    return step;
}

ModelledRange tables() {
    const WavelengthRange modelled = modelled_wavelengths();
    return {.lowest_nm = modelled.lowest_nm, .highest_nm = modelled.highest_nm};
}

/// What a fit uses of `spectrum`, measured as is decided.
Spectrum as_fitted(const ResolvedConfiguration& configuration, const Spectrum& spectrum) {
    Spectrum used = part_of(spectrum, window_of(configuration));
    used.quantity = configuration.quantity;
    used.geometry = {.incidence_deg = configuration.incidence_deg,
                     .specular = configuration.specular,
                     .viewing_cone_deg = configuration.viewing_cone_deg};
    return used;
}

/// Without the dermis a sample has no blood to find.
void forget_hemoglobin_without_dermis(std::vector<Finding>& findings, const ResolvedConfiguration& configuration) {
    if (configuration.layers == 4) return;
    std::erase_if(findings, [](const Finding& each) { return each.name == "no_hemoglobin"; });
}

/// A finding to which only readings outside the window give cause.
Finding as_note(Finding finding, const WavelengthWindow& window) {
    if (finding.severity == Severity::note) return finding;
    finding.severity = Severity::note;
    const std::string fit = fmt::format("a fit from {:g} to {:g} nm", window.range.lowest_nm, window.range.highest_nm);
    finding.message += fmt::format("; {} does not see it in the readings that it uses", fit);
    finding.remedy = fmt::format("none is needed for {}; for another window: {}", fit, finding.remedy);
    return finding;
}

}  // namespace

WavelengthWindow usual_window() {
    return window_of(default_configuration());
}

std::vector<Finding> findings_in(std::span<const Spectrum> spectra) {
    const WavelengthWindow window = usual_window();
    std::vector<Spectrum> used;
    for (const Spectrum& spectrum : spectra) {
        used.push_back(part_of(spectrum, window));
        if (used.back().value.empty()) used.back() = spectrum;
    }
    std::vector<Finding> findings = quality_findings(used, tables());
    for (Finding& finding : quality_findings(spectra, tables())) {
        const auto known = std::ranges::find_if(findings, [&](const Finding& each) {
            return each.name == finding.name && each.spectrum == finding.spectrum;
        });
        if (known == findings.end()) {
            findings.push_back(as_note(std::move(finding), window));
        } else if (known->name == "missing_values" && known->message != finding.message) {
            known->message = fmt::format("{}; from {:g} to {:g} nm {}", finding.message, window.range.lowest_nm,
                                         window.range.highest_nm, known->message);
        }
    }
    return findings;
}

std::vector<Finding> findings_before_fit(const ResolvedConfiguration& configuration, const Spectrum& spectrum) {
    const Spectrum used = as_fitted(configuration, spectrum);
    std::vector<Finding> findings = quality_findings({&used, 1}, tables());
    forget_hemoglobin_without_dermis(findings, configuration);
    return findings;
}

std::vector<Finding> findings_before_fit(const FitInput& input) {
    std::vector<Spectrum> used;
    for (const FitInput::Part& part : input.parts) used.push_back(as_fitted(part.configuration, part.spectrum));
    std::vector<Finding> findings = quality_findings(used, tables());
    for (const FitInput::Part& part : input.parts) {
        if (!part_of(part.spectrum, window_of(part.configuration)).value.empty()) continue;
        if (auto finding = outside_tables(part.spectrum, tables())) findings.push_back(std::move(*finding));
    }
    forget_hemoglobin_without_dermis(findings, input.parts.front().configuration);
    return findings;
}

std::vector<Finding> findings_before_fit(const Configuration& configuration, std::span<const Spectrum> spectra) {
    return findings_before_fit(fit_input(configuration, spectra));
}

Inspection inspected(SpectrumFile file) {
    const std::vector<Spectrum>& spectra = file.spectra;
    Inspection inspection{
        .file = {},
        .first_nm = spectra.front().wavelength_nm.front(),
        .last_nm = spectra.front().wavelength_nm.back(),
        .step_nm = step_of(spectra),
        .fewest_readings = spectra.front().value.size(),
        .most_readings = 0,
        .smallest = HUGE_VAL,
        .largest = -HUGE_VAL,
        .unit_rule = all_texts(spectra, &Spectrum::unit_rule),
        .sigma_source = all_texts(spectra, &Spectrum::sigma_source),
        .quantity = shared<Quantity>(spectra, [](const Spectrum& each) { return each.quantity; }),
        .geometry = {.incidence_deg =
                         shared<double>(spectra, [](const Spectrum& each) { return each.geometry.incidence_deg; }),
                     .specular = shared<Specular>(spectra, [](const Spectrum& each) { return each.geometry.specular; }),
                     .viewing_cone_deg =
                         shared<double>(spectra, [](const Spectrum& each) { return each.geometry.viewing_cone_deg; })},
        .instrument = all_texts(spectra, &Spectrum::instrument),
        .aperture_mm = shared<double>(spectra, [](const Spectrum& each) { return each.aperture_mm; }),
        .bandpass = shared_bandpass(spectra),
        .findings = findings_in(spectra)};
    for (const Spectrum& spectrum : spectra) {
        inspection.first_nm = std::min(inspection.first_nm, spectrum.wavelength_nm.front());
        inspection.last_nm = std::max(inspection.last_nm, spectrum.wavelength_nm.back());
        inspection.fewest_readings = std::min(inspection.fewest_readings, spectrum.value.size());
        inspection.most_readings = std::max(inspection.most_readings, spectrum.value.size());
        inspection.smallest = std::min(inspection.smallest, std::ranges::min(spectrum.value));
        inspection.largest = std::max(inspection.largest, std::ranges::max(spectrum.value));
    }
    inspection.file = std::move(file);
    return inspection;
}

}  // namespace skinfit
