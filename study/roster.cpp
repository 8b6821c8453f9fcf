#include "study/roster.hpp"

#include <fmt/format.h>

#include <re2/re2.h>

#include "core/hash.hpp"
#include "core/input_error.hpp"
#include "core/json.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {
namespace {

/// Appends what follows so that no two sequences of values give the same bytes.
class Bytes {
public:
    void add(const std::string& text) {
        bytes_ += fmt::format("{}:", text.size());
        bytes_ += text;
    }
    void add(const std::vector<double>& numbers) {
        bytes_ += fmt::format("{}:", numbers.size());
        bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
    }
    template <class Value>
    void add_optional(const std::optional<Value>& value) {
        add(value ? fmt::format("{}", static_cast<double>(*value)) : std::string());
    }
    [[nodiscard]] const std::string& text() const { return bytes_; }

private:
    std::string bytes_;
};

RosterEntry unreadable(const StudyFile& file, const std::string& name, const std::string& reason,
                       const Metadata& metadata) {
    return {.source = file.source,
            .number = 0,
            .name = name,
            .metadata = metadata,
            .input_hash = content_hash(reason),
            .refusal = Refusal{.status = FitStatus::failed, .reason = reason}};
}

Metadata metadata_in(const Spectrum& spectrum) {
    Metadata metadata;
    if (!spectrum.site.empty()) metadata.emplace_back("site", spectrum.site);
    return metadata;
}

/// What the name of a spectrum says by the study's pattern; nothing where the pattern does not know the name.
std::optional<Metadata> metadata_of_name(const NamePattern& pattern, const re2::RE2& compiled,
                                         const std::string& name) {
    std::vector<re2::StringPiece> found(pattern.fields.size() + 1);  // the whole match, then the groups
    if (!compiled.Match(name, 0, name.size(), re2::RE2::UNANCHORED, found.data(), static_cast<int>(found.size()))) {
        return std::nullopt;
    }
    Metadata metadata;
    for (std::size_t i = 0; i < pattern.fields.size(); ++i) {
        metadata.emplace_back(pattern.fields[i], std::string(found[i + 1]));
    }
    return metadata;
}

void add(const StudyFile& file, const Spectrum& spectrum, std::size_t number, const Metadata& metadata,
         StudySpectra& all) {
    const Metadata known = merged(merged(metadata_in(spectrum), file.metadata), metadata);
    all.entries.push_back({.source = file.source,
                           .number = number,
                           .name = spectrum.name,
                           .metadata = known,
                           .input_hash = input_hash_of(spectrum),
                           .refusal = {}});
    all.spectra.push_back(spectrum);
}

void add_all(const StudyFile& file, const std::vector<Spectrum>& spectra, const Metadata& metadata, StudySpectra& all) {
    const re2::RE2 compiled(file.names ? file.names->expression : std::string(), re2::RE2::Quiet);
    for (std::size_t i = 0; i < spectra.size(); ++i) {
        Metadata known = metadata;
        if (file.names) {
            const std::optional<Metadata> found = metadata_of_name(*file.names, compiled, spectra[i].name);
            if (!found) {
                ++all.left_out;
                continue;
            }
            known = merged(known, *found);
        }
        add(file, spectra[i], i + 1, known, all);
    }
}

/// The places of the names; those that occur twice have none.
std::map<std::string, std::optional<std::size_t>> places_of(const std::vector<Spectrum>& spectra) {
    std::map<std::string, std::optional<std::size_t>> places;
    for (std::size_t i = 0; i < spectra.size(); ++i) {
        const auto [place, is_new] = places.try_emplace(spectra[i].name, i);
        if (!is_new) place->second.reset();
    }
    return places;
}

/// Those that a manifest names.
void add_selected(const StudyFile& file, const std::vector<Spectrum>& spectra, StudySpectra& all) {
    const std::map<std::string, std::optional<std::size_t>> places = places_of(spectra);
    std::vector<bool> taken(spectra.size(), false);
    for (const SelectedSpectrum& selected : file.selected) {
        if (selected.spectrum.empty()) {
            if (file.selected.size() == 1) {
                add_all(file, spectra, selected.metadata, all);
            } else {
                all.entries.push_back(
                    unreadable(file, selected.where,
                               fmt::format("{}: names no spectrum (other lines are about {} too); name one",
                                           selected.where, file.source),
                               merged(file.metadata, selected.metadata)));
                all.spectra.emplace_back();
            }
            continue;
        }
        std::optional<std::size_t> place;
        const auto named = places.find(selected.spectrum);
        if (named != places.end()) {
            place = named->second;
        } else if (selected.spectrum.find_first_not_of("0123456789") == std::string::npos &&
                   selected.spectrum.size() < 10) {
            const std::size_t number = std::stoul(selected.spectrum);
            if (number >= 1 && number <= spectra.size()) place = number - 1;
        }
        if (place && !taken[*place]) {
            taken[*place] = true;
            add(file, spectra[*place], *place + 1, selected.metadata, all);
            continue;
        }
        const std::string problem = place                   ? "is named twice"
                                    : named != places.end() ? "is the name of several spectra"
                                                            : "is no spectrum";
        all.entries.push_back(unreadable(file, selected.where,
                                         fmt::format("{}: \"{}\" {} of {}; see `skinfit inspect`", selected.where,
                                                     selected.spectrum, problem, file.source),
                                         merged(file.metadata, selected.metadata)));
        all.spectra.emplace_back();
    }
}

}  // namespace

std::string input_hash_of(const Spectrum& spectrum) {
    Bytes bytes;
    bytes.add(spectrum.wavelength_nm);
    bytes.add(spectrum.value);
    bytes.add(spectrum.sigma);
    bytes.add_optional(spectrum.quantity);
    bytes.add_optional(spectrum.geometry.incidence_deg);
    bytes.add_optional(spectrum.geometry.specular);
    bytes.add_optional(spectrum.geometry.viewing_cone_deg);
    bytes.add(spectrum.instrument);
    const std::optional<Bandpass>& bandpass = spectrum.bandpass;
    bytes.add(bandpass ? fmt::format("{} {}", static_cast<int>(bandpass->shape), bandpass->width_nm) : std::string());
    for (const FileNote& note : spectrum.notes) {
        bytes.add(note.key);
        bytes.add(note.value);
    }
    bytes.add(spectrum.unit_rule);     // decides findings, as
    bytes.add(spectrum.sigma_source);  // this does
    for (const std::string& remark : spectrum.remarks) bytes.add(remark);
    for (const FileDoubt& doubt : spectrum.doubts) bytes.add(doubt.message);
    for (const std::vector<double>& repeat : spectrum.repeats) bytes.add(repeat);
    bytes.add(spectrum.missing_nm);
    return content_hash(bytes.text());
}

StudySpectra read_study_file(const StudyFile& file, const WavelengthWindow& window) {
    StudySpectra all;
    try {
        const SpectrumFile read = read_spectra(file.path, {.unit = file.unit, .window = window}, file.reader);
        if (file.selected.empty()) {
            add_all(file, read.spectra, {}, all);
        } else {
            add_selected(file, read.spectra, all);
        }
    } catch (const InputError& error) {
        all = {.entries = {unreadable(file, "", error.what(), file.metadata)}, .spectra = {Spectrum()}, .left_out = 0};
    }
    return all;
}

void refuse_duplicates(StudySpectra& spectra, std::map<std::string, std::string>& seen,
                       const WavelengthWindow& window) {
    constexpr std::size_t fewest = 3;  // readings: fewer may agree by chance, as in `duplicates`
    for (std::size_t i = 0; i < spectra.entries.size(); ++i) {
        RosterEntry& entry = spectra.entries[i];
        const Spectrum used = part_of(spectra.spectra[i], window);
        if (entry.refusal || used.value.size() < fewest) continue;
        Bytes values;
        values.add(used.wavelength_nm);
        values.add(used.value);
        const std::string name = fmt::format("{} {}", entry.source, entry.name);
        const auto [first, is_new] = seen.try_emplace(content_hash(values.text()), name);
        if (is_new) continue;
        entry.refusal = Refusal{.status = FitStatus::rejected,
                                .reason = fmt::format("duplicate: has the same values as {}", first->second)};
        entry.input_hash = content_hash(entry.input_hash + first->second);
    }
}

}  // namespace skinfit
