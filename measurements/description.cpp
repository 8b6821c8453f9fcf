#include "measurements/description.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>

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

[[noreturn]] void refuse(const Columns& columns, const Note& note, const std::string& expected) {
    throw InputError({.where = at_line(columns, note.line),
                      .problem = fmt::format("{} is {}", note.key, in_quotes(note.value)),
                      .why = fmt::format("it must be {}", expected),
                      .remedy = "correct the comment or delete it"});
}

/// The meaning of the note's value, which must be one of two words.
template <typename Meaning>
Meaning either(const Columns& columns, const Note& note,
               const std::array<std::pair<std::string_view, Meaning>, 2>& words) {
    const std::string value = lower_case(note.value);
    for (const auto& [word, meaning] : words) {
        if (value == word) return meaning;
    }
    refuse(columns, note, fmt::format("{} or {}", words[0].first, words[1].first));
}

double angle(const Columns& columns, const Note& note, double lowest_deg, double highest_deg) {
    const std::optional<double> degrees = parse_number(note.value);
    if (!degrees || !(*degrees >= lowest_deg && *degrees <= highest_deg)) {
        refuse(columns, note, fmt::format("an angle to the normal in degrees, from {} to {}", lowest_deg, highest_deg));
    }
    return *degrees;
}

}  // namespace

Description read_description(const Columns& columns) {
    Description description;
    std::map<std::string_view, std::size_t> line_of_key;
    for (const Comment& comment : columns.comments) {
        const std::size_t colon = comment.text.find(':');
        if (colon == std::string_view::npos) continue;
        const Note note{.line = comment.line,
                        .key = trimmed(comment.text.substr(0, colon)),
                        .value = trimmed(comment.text.substr(colon + 1))};
        if (note.key == "quantity") {
            description.quantity = either<Quantity>(
                columns, note, {{{"reflectance", Quantity::reflectance}, {"transmittance", Quantity::transmittance}}});
        } else if (note.key == "unit") {
            description.unit =
                either<Unit>(columns, note, {{{"fraction", Unit::fraction}, {"percent", Unit::percent}}});
        } else if (note.key == "specular") {
            description.geometry.specular =
                either<Specular>(columns, note, {{{"included", Specular::included}, {"excluded", Specular::excluded}}});
        } else if (note.key == "incidence_deg") {
            description.geometry.incidence_deg = angle(columns, note, 0, 85);  // as far as the model is asked
        } else if (note.key == "viewing_cone_deg") {
            description.geometry.viewing_cone_deg = angle(columns, note, 0.1, 90);  // likewise
        } else if (note.key == "specimen") {
            description.specimen = note.value;
        } else {
            continue;
        }
        if (const auto [first, is_new] = line_of_key.emplace(note.key, note.line); !is_new) {
            throw InputError({.where = at_line(columns, note.line),
                              .problem = fmt::format("gives {} again", note.key),
                              .why = fmt::format("line {} gives it already", first->second),
                              .remedy = "keep one of the two"});
        }
    }
    return description;
}

}  // namespace skinfit
