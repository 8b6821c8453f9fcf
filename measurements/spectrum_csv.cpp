#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>

#include "core/csv.hpp"
#include "core/input_error.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/spectrum_file.hpp"
#include "measurements/spectrum_writer.hpp"

namespace skinfit {
namespace {

[[noreturn]] void refuse_csv(const std::string& where, const std::string& problem, const std::string& why) {
    throw InputError({.where = where,
                      .problem = problem,
                      .why = why,
                      .remedy = "write them with --format json, or choose some of them with --column"});
}

/// The comments that describe a spectrum, without its notes.
std::string description(const Spectrum& spectrum) {
    std::string text;
    const auto put = [&text](std::string_view key, const auto& value) {
        text += fmt::format("# {}: {}\n", key, value);
    };
    if (spectrum.quantity) put("quantity", quantity_names[static_cast<std::size_t>(*spectrum.quantity)]);
    put("unit", "fraction");
    if (spectrum.geometry.incidence_deg) put("incidence_deg", *spectrum.geometry.incidence_deg);
    if (spectrum.geometry.specular) {
        put("specular", specular_names[static_cast<std::size_t>(*spectrum.geometry.specular)]);
    }
    if (spectrum.geometry.viewing_cone_deg) put("viewing_cone_deg", *spectrum.geometry.viewing_cone_deg);
    if (!spectrum.instrument.empty()) put("instrument", spectrum.instrument);
    if (!spectrum.site.empty()) put("site", spectrum.site);
    if (spectrum.aperture_mm) put("aperture_mm", *spectrum.aperture_mm);
    if (spectrum.bandpass) {
        put("bandpass_shape", bandpass_shape_names[static_cast<std::size_t>(spectrum.bandpass->shape)]);
        put("bandpass_width_nm", spectrum.bandpass->width_nm);
    }
    return text;
}

/// The notes that all spectra have, and a line that says so where some have others; without those of the source's units
/// and scales: the table's own are nm and fractions.
std::string notes(const std::vector<Spectrum>& spectra) {
    const auto same_note = [](const FileNote& a, const FileNote& b) { return a.key == b.key && a.value == b.value; };
    std::string text;
    bool all_are_common = true;
    for (const FileNote& note : spectra.front().notes) {
        const bool common = std::ranges::all_of(spectra, [&](const Spectrum& spectrum) {
            return std::ranges::any_of(spectrum.notes, [&](const FileNote& other) { return same_note(note, other); });
        });
        if (common && !is_statement_key(note.key)) text += fmt::format("# {}: {}\n", note.key, note.value);
        all_are_common = all_are_common && common;
    }
    for (const Spectrum& spectrum : spectra) {
        all_are_common = all_are_common && spectrum.notes.size() == spectra.front().notes.size();
    }
    return all_are_common ? text
                          : text + "# notes that differ between the spectra are left out here; JSON holds them\n";
}

/// Where the uncertainties come from, if it is the same for all that have some.
std::string sigma_source(const std::vector<Spectrum>& spectra, const std::string& where) {
    std::set<std::string> sources;
    for (const Spectrum& spectrum : spectra) {
        if (!spectrum.sigma.empty()) sources.insert(spectrum.sigma_source);
    }
    if (sources.size() > 1)
        refuse_csv(where, "holds uncertainties of different sources", "one comment states the source");
    return sources.empty() ? "" : fmt::format("# sigma_source: {}\n", *sources.begin());
}

/// The wavelengths of all spectra; those that a spectrum lacks are its missing values.
std::vector<double> common_wavelengths(const std::vector<Spectrum>& spectra, const std::string& where) {
    std::set<double> all;
    bool alike = true;
    for (const Spectrum& spectrum : spectra) {
        alike = alike && spectrum.wavelength_nm == spectra.front().wavelength_nm;
        if (!alike) all.insert(spectrum.wavelength_nm.begin(), spectrum.wavelength_nm.end());
    }
    if (alike) return spectra.front().wavelength_nm;
    all.insert(spectra.front().wavelength_nm.begin(), spectra.front().wavelength_nm.end());
    const bool explained = std::ranges::all_of(spectra, [&all](const Spectrum& spectrum) {
        return spectrum.value.size() + spectrum.missing_nm.size() == all.size();
    });
    if (explained) return {all.begin(), all.end()};
    const auto other = std::ranges::find_if(spectra, [&spectra](const Spectrum& spectrum) {
        return spectrum.wavelength_nm != spectra.front().wavelength_nm;
    });
    refuse_csv(where, fmt::format("\"{}\" has other wavelengths than \"{}\"", other->name, spectra.front().name),
               "the lines of a table have one wavelength each");
}

std::string quoted(const std::string& name) {
    std::string text = "\"";
    for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
}

/// As a cell of the header: in quotes where its characters ask for them.
std::string cell(const std::string& name) {
    const std::string text = marked_as_text(name);
    return text.find_first_of(",;#\" \t") == std::string::npos ? text : quoted(text);
}

std::string table(const std::vector<Spectrum>& spectra, const std::vector<double>& wavelength_nm) {
    const bool sole = spectra.size() == 1;
    std::string text = "wavelength_nm";
    for (const Spectrum& spectrum : spectra) {
        text += "," + (sole ? "value" : cell(spectrum.name));
        if (!spectrum.sigma.empty()) text += "," + (sole ? "sigma" : cell(spectrum.name + "_sigma"));
    }
    text += "\n";
    std::vector<std::size_t> next(spectra.size());
    for (const double nm : wavelength_nm) {
        text += fmt::format("{}", nm);
        for (std::size_t k = 0; k < spectra.size(); ++k) {
            const Spectrum& spectrum = spectra[k];
            const bool has = next[k] < spectrum.value.size() && spectrum.wavelength_nm[next[k]] == nm;
            text += has ? fmt::format(",{}", spectrum.value[next[k]]) : ",";
            const bool has_sigma = has && !spectrum.sigma.empty() && !std::isnan(spectrum.sigma[next[k]]);
            if (!spectrum.sigma.empty()) text += has_sigma ? fmt::format(",{}", spectrum.sigma[next[k]]) : ",";
            if (has) ++next[k];
        }
        text += "\n";
    }
    return text;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(a, b, {}, std::bit_cast<std::uint64_t, double>, std::bit_cast<std::uint64_t, double>);
}

/// True where all is the same that columns can hold.
bool same(const Spectrum& a, const Spectrum& b) {
    return a.name == b.name && same_bits(a.wavelength_nm, b.wavelength_nm) && same_bits(a.value, b.value) &&
           same_bits(a.sigma, b.sigma) && a.sigma_source == b.sigma_source && description(a) == description(b);
}

}  // namespace

std::string spectra_csv(const std::vector<Spectrum>& spectra, const std::string& where) {
    const std::string described = description(spectra.front());
    for (const Spectrum& spectrum : spectra) {
        if (description(spectrum) == described) continue;
        refuse_csv(where, fmt::format("\"{}\" is described otherwise than \"{}\"", spectrum.name, spectra.front().name),
                   "the comments of a table hold for all of its columns");
    }
    const std::vector<double> wavelength_nm = common_wavelengths(spectra, where);
    std::string text = described + notes(spectra) + sigma_source(spectra, where);
    if (spectra.size() == 1) text += fmt::format("# specimen: {}\n", spectra.front().name);
    text += table(spectra, wavelength_nm);
    // What a name or a comment does to a file is found out by reading it.
    const auto reads_back = [&] {
        try {
            return std::ranges::equal(parse_spectra(text, where, {}, "columns").spectra, spectra, same);
        } catch (const InputError&) {
            return false;
        }
    };
    if (!reads_back()) {
        refuse_csv(where, "its names or comments cannot stand in a table of text",
                   "names must be different, on one line, and not say anything about unit or quantity");
    }
    return text;
}

}  // namespace skinfit
