#include "measurements/description.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

struct Note {
    std::size_t line;
    std::string_view key;
    std::string_view value;
};

[[noreturn]] void refuse(const std::string& source, const Note& note, const std::string& expected) {
    throw InputError({.where = fmt::format("{}:{}", source, note.line),
                      .problem = fmt::format("{} is {}", note.key, in_quotes(note.value)),
                      .why = fmt::format("it must be {}", expected),
                      .remedy = "correct the comment or delete it"});
}

/// The meaning of the note's value: the place of its word in `words`.
template <typename Meaning, std::size_t size>
Meaning one_of(const std::string& source, const Note& note, const std::array<std::string_view, size>& words) {
    const auto found = std::ranges::find(words, lower_case(note.value));
    if (found == words.end()) refuse(source, note, fmt::format("{}", fmt::join(words, " or ")));
    return static_cast<Meaning>(found - words.begin());
}

double positive(const std::string& source, const Note& note) {
    const std::optional<double> number = parse_number(note.value);
    if (!number || !(*number > 0) || !std::isfinite(*number)) refuse(source, note, "a number above 0");
    return *number;
}

double bandpass_width(const std::string& source, const Note& note) {
    const double width_nm = positive(source, note);
    const double widest_nm = bandpass_width_range_nm.highest;
    if (width_nm > widest_nm) refuse(source, note, fmt::format("at most {} nm", widest_nm));
    return width_nm;
}

double angle(const std::string& source, const Note& note, const Range& range_deg) {
    const std::optional<double> degrees = parse_number(note.value);
    if (!degrees || !range_deg.contains(*degrees)) {
        refuse(source, note,
               fmt::format("an angle to the normal in degrees, from {} to {}", range_deg.lowest, range_deg.highest));
    }
    return *degrees;
}

/// The keys that change what is read.
constexpr std::array<std::string_view, 7> weighty_keys = {
    "quantity", "unit", "specular", "incidence_deg", "viewing_cone_deg", "bandpass_shape", "bandpass_width_nm"};

/// Takes what a known key says; false where the key is not known.
bool take(Description& description, const std::string& source, const Note& note) {
    if (note.key == "quantity") {
        description.quantity = one_of<Quantity>(source, note, quantity_names);
    } else if (note.key == "unit") {
        description.unit = one_of<Unit>(source, note, unit_names);
    } else if (note.key == "specular") {
        description.geometry.specular = one_of<Specular>(source, note, specular_names);
    } else if (note.key == "incidence_deg") {
        description.geometry.incidence_deg = angle(source, note, incidence_range_deg);
    } else if (note.key == "viewing_cone_deg") {
        description.geometry.viewing_cone_deg = angle(source, note, viewing_cone_range_deg);
    } else if (note.key == "bandpass_shape") {
        description.bandpass_shape = one_of<BandpassShape>(source, note, bandpass_shape_names);
    } else if (note.key == "bandpass_width_nm") {
        description.bandpass_width_nm = bandpass_width(source, note);
    } else if (note.key == "aperture_mm") {
        description.aperture_mm = positive(source, note);
    } else if (note.key == "specimen") {
        description.specimen = note.value;
    } else if (note.key == "site") {
        description.site = note.value;
    } else if (note.key == "instrument") {
        description.instrument = note.value;
    } else if (note.key == "sigma_source") {
        description.sigma_source = note.value;
    } else {
        return false;
    }
    return true;
}

/// Throws InputError where only one of the two is given.
void check_bandpass(const std::string& source, const Description& description) {
    if (description.bandpass_shape.has_value() == description.bandpass_width_nm.has_value()) return;
    const bool shaped = description.bandpass_shape.has_value();
    throw InputError({.where = source,
                      .problem = fmt::format("gives bandpass_{} alone", shaped ? "shape" : "width_nm"),
                      .why = "a bandpass is a shape and a width",
                      .remedy = fmt::format("add a line \"# {}\"",
                                            shaped ? "bandpass_width_nm: 10" : "bandpass_shape: triangular")});
}

}  // namespace

void refuse_slip(const std::string& source, std::size_t line, std::string_view key,
                 std::span<const std::string_view> known) {
    if (std::ranges::find(known, key) != known.end()) return;
    const std::string plain = lower_case(key);
    const auto cut = std::ranges::find_if(known, [&](std::string_view name) { return name.starts_with(plain + "_"); });
    const std::optional<std::string_view> meant = cut != known.end() ? *cut : similar_name(plain, known);
    if (!meant) return;
    throw InputError({.where = fmt::format("{}:{}", source, line),
                      .problem = fmt::format("unknown key {}", in_quotes(key)),
                      .why = "it would have no effect",
                      .remedy = fmt::format("write {}: ... as the key, or reword the comment", *meant)});
}

Description read_description(const std::string& source, std::span<const Comment> comments) {
    Description description;
    std::map<std::string_view, std::size_t> line_of_key;
    for (const Comment& comment : comments) {
        const std::size_t colon = comment.text.find(':');
        if (colon == std::string_view::npos) continue;
        const Note note{.line = comment.line,
                        .key = trimmed(comment.text.substr(0, colon)),
                        .value = trimmed(comment.text.substr(colon + 1))};
        if (!take(description, source, note)) {
            refuse_slip(source, note.line, note.key, weighty_keys);
            description.notes.push_back(
                {.line = note.line, .key = std::string(note.key), .value = std::string(note.value)});
            continue;
        }
        if (const auto [first, is_new] = line_of_key.emplace(note.key, note.line); !is_new) {
            throw InputError({.where = fmt::format("{}:{}", source, note.line),
                              .problem = fmt::format("gives {} again", note.key),
                              .why = fmt::format("line {} gives it already", first->second),
                              .remedy = "keep one of the two"});
        }
    }
    check_bandpass(source, description);
    return description;
}

Spectrum spectrum_of(const Description& description) {
    Spectrum spectrum;
    spectrum.name = description.specimen;
    spectrum.quantity = description.quantity;
    spectrum.geometry = description.geometry;
    spectrum.notes = description.notes;
    spectrum.instrument = description.instrument;
    spectrum.site = description.site;
    spectrum.aperture_mm = description.aperture_mm;
    if (description.bandpass_shape && description.bandpass_width_nm) {
        spectrum.bandpass = {.shape = *description.bandpass_shape, .width_nm = *description.bandpass_width_nm};
    }
    return spectrum;
}

std::vector<FileNote> notes_in(std::span<const Comment> prose) {
    std::vector<FileNote> notes;
    for (const Comment& comment : prose) {
        const std::size_t colon = comment.text.find(':');
        if (colon == std::string_view::npos) continue;
        notes.push_back({.line = comment.line,
                         .key = std::string(trimmed(comment.text.substr(0, colon))),
                         .value = std::string(trimmed(comment.text.substr(colon + 1)))});
    }
    return notes;
}

}  // namespace skinfit
