#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/version.hpp"
#include "fit/inspection.hpp"
#include "fit/spectra_plot.hpp"

namespace skinfit {
namespace {

constexpr std::size_t most_names = 12;  // in a list for people

std::string listed(const std::vector<std::string>& names) {
    const std::size_t shown = std::min(names.size(), most_names);
    const std::string text =
        fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
    return shown == names.size() ? text : fmt::format("{} and {} more", text, names.size() - shown);
}

std::vector<std::string> names_of(const std::vector<Spectrum>& spectra) {
    std::vector<std::string> names(spectra.size());
    std::ranges::transform(spectra, names.begin(), &Spectrum::name);
    return names;
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json();
}

template <class Name, class Names>
Json word_or_null(const std::optional<Name>& value, const Names& names) {
    return value ? Json(names.at(static_cast<std::size_t>(*value))) : Json();
}

std::string_view shape_name(const Bandpass& bandpass) {
    return bandpass_shape_names.at(static_cast<std::size_t>(bandpass.shape));
}

Json bandpass_json(const std::optional<Bandpass>& bandpass) {
    if (!bandpass) return {};
    return {{"shape", shape_name(*bandpass)}, {"width_nm", bandpass->width_nm}};
}

Json geometry_json(const Geometry& geometry) {
    return {{"incidence_deg", or_null(geometry.incidence_deg)},
            {"specular", word_or_null(geometry.specular, specular_names)},
            {"viewing_cone_deg", or_null(geometry.viewing_cone_deg)}};
}

/// "transmittance (leaf 1), reflectance (leaf 2)" where the spectra state different things of one kind; empty where
/// they agree, or none states it. `word` gives what one of them states, or nothing.
template <class Word>
std::string differing(const std::vector<Spectrum>& spectra, const Word& word) {
    std::vector<std::string> words;
    std::vector<std::vector<std::string>> names;
    for (const Spectrum& spectrum : spectra) {
        const std::string stated = word(spectrum);
        const auto known = std::ranges::find(words, stated);
        const auto place = static_cast<std::size_t>(known - words.begin());
        if (known == words.end()) {
            words.push_back(stated);
            names.emplace_back();
        }
        names[place].push_back(spectrum.name);
    }
    if (words.size() < 2) return {};
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < words.size(); ++i) {
        parts.push_back(fmt::format("{} ({})", words[i].empty() ? "not stated" : words[i], listed(names[i])));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string quantity_of(const Spectrum& spectrum) {
    return spectrum.quantity ? std::string(quantity_names.at(static_cast<std::size_t>(*spectrum.quantity))) : "";
}

std::string specular_of(const Spectrum& spectrum) {
    const std::optional<Specular>& specular = spectrum.geometry.specular;
    return specular ? fmt::format("specular {}", specular_names.at(static_cast<std::size_t>(*specular))) : "";
}

std::string geometry_text(const Inspection& inspection) {
    std::vector<std::string> parts;
    const Geometry& geometry = inspection.geometry;
    for (const std::string& each :
         {differing(inspection.file.spectra, quantity_of), differing(inspection.file.spectra, specular_of)}) {
        if (!each.empty()) parts.push_back(each);
    }
    if (inspection.quantity) parts.emplace_back(quantity_names.at(static_cast<std::size_t>(*inspection.quantity)));
    if (geometry.incidence_deg) parts.push_back(fmt::format("incidence {:g} deg", *geometry.incidence_deg));
    if (geometry.specular) {
        parts.push_back(fmt::format("specular {}", specular_names.at(static_cast<std::size_t>(*geometry.specular))));
    }
    if (geometry.viewing_cone_deg) parts.push_back(fmt::format("viewing cone {:g} deg", *geometry.viewing_cone_deg));
    if (inspection.bandpass) {
        parts.push_back(
            fmt::format("bandpass {} {:g} nm", shape_name(*inspection.bandpass), inspection.bandpass->width_nm));
    }
    if (inspection.aperture_mm) parts.push_back(fmt::format("aperture {:g} mm", *inspection.aperture_mm));
    if (!inspection.instrument.empty()) parts.push_back(inspection.instrument);
    return parts.empty()
               ? fmt::format("not stated; a fit takes reflectance, incidence {:g} deg, specular {}",
                             default_incidence_deg, specular_names.at(static_cast<std::size_t>(default_specular)))
               : fmt::format("{}", fmt::join(parts, ", "));
}

std::string wavelength_text(const Inspection& inspection) {
    const std::string readings = inspection.fewest_readings == inspection.most_readings
                                     ? fmt::format("{}", inspection.most_readings)
                                     : fmt::format("{} to {}", inspection.fewest_readings, inspection.most_readings);
    if (inspection.most_readings == 1) return fmt::format("one, {:g} nm", inspection.first_nm);
    return fmt::format("{} from {:g} to {:g} nm, {}", readings, inspection.first_nm, inspection.last_nm,
                       inspection.step_nm ? fmt::format("every {:g} nm", *inspection.step_nm) : "unevenly spaced");
}

}  // namespace

Json findings_json(const std::vector<Finding>& findings) {
    Json list = Json::array();
    for (const Finding& finding : findings) {
        list.push_back({{"name", finding.name},
                        {"severity", name_of(finding.severity)},
                        {"spectrum", finding.spectrum},
                        {"message", finding.message},
                        {"remedy", finding.remedy}});
    }
    return list;
}

std::string findings_text(const std::vector<Finding>& findings, std::size_t spectra) {
    if (findings.empty()) return "findings: none\n";
    std::string text = "findings:\n";
    std::vector<std::string> told;
    for (const Finding& first : findings) {
        if (std::ranges::find(told, first.name) != told.end()) continue;
        told.push_back(first.name);
        std::vector<std::string> names;
        for (const Finding& each : findings) {
            if (each.name == first.name) names.push_back(each.spectrum);
        }
        const std::string_view severity = first.severity == Severity::warning ? "WARNING" : "note";
        if (spectra == 1) {
            text += fmt::format("  {} {}: {}\n      remedy: {}\n", severity, first.name, first.message, first.remedy);
            continue;
        }
        text +=
            fmt::format("  {} {}: {} of {} spectra: {}\n", severity, first.name, names.size(), spectra, listed(names));
        text += fmt::format("      {}: {}\n      remedy: {}\n", first.spectrum, first.message, first.remedy);
    }
    return text;
}

std::string inspection_text(const Inspection& inspection) {
    const std::vector<Spectrum>& spectra = inspection.file.spectra;
    std::string text = fmt::format("{}: {} {}, read as {}\n", inspection.file.source, spectra.size(),
                                   spectra.size() == 1 ? "spectrum" : "spectra", inspection.file.format);
    text += fmt::format("names: {}\n", listed(names_of(spectra)));
    text += fmt::format("wavelengths: {}\n", wavelength_text(inspection));
    text += fmt::format("values: {:.4g} to {:.4g}, read as {}\n", inspection.smallest, inspection.largest,
                        inspection.unit_rule);
    text +=
        fmt::format("uncertainty: {}\n", inspection.sigma_source.empty() ? "not given; a fit takes the setting noise"
                                                                         : inspection.sigma_source);
    text += fmt::format("measurement: {}\n\n", geometry_text(inspection));
    return text + terminal_plot_of(spectra) + "\n" + findings_text(inspection.findings, spectra.size());
}

Json inspection_json(const Inspection& inspection) {
    const std::vector<Spectrum>& spectra = inspection.file.spectra;
    return {{"source", inspection.file.source},
            {"format", inspection.file.format},
            {"spectra", spectra.size()},
            {"names", names_of(spectra)},
            {"wavelength_nm",
             {{"first", inspection.first_nm}, {"last", inspection.last_nm}, {"step", or_null(inspection.step_nm)}}},
            {"readings", {{"fewest", inspection.fewest_readings}, {"most", inspection.most_readings}}},
            {"values", {{"smallest", inspection.smallest}, {"largest", inspection.largest}}},
            {"unit_rule", inspection.unit_rule},
            {"sigma_source", inspection.sigma_source.empty() ? Json() : Json(inspection.sigma_source)},
            {"quantity", word_or_null(inspection.quantity, quantity_names)},
            {"geometry", geometry_json(inspection.geometry)},
            {"instrument", inspection.instrument.empty() ? Json() : Json(inspection.instrument)},
            {"aperture_mm", or_null(inspection.aperture_mm)},
            {"bandpass", bandpass_json(inspection.bandpass)},
            {"findings", findings_json(inspection.findings)},
            {"version", version}};
}

}  // namespace skinfit
