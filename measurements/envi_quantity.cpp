#include "measurements/envi_quantity.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <string>

#include "core/text.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/stated_words.hpp"
#include "measurements/unit_rule.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

bool is_prose(std::string_view key) {
    return key == "description" || key == "product type";
}

/// The title of the values: the first of two is that of the wavelengths.
std::string_view title_in(std::string_view key, std::string_view value) {
    const std::size_t comma = key.starts_with("z plot") ? value.find(',') : std::string_view::npos;
    return comma == std::string_view::npos ? value : value.substr(comma + 1);
}

/// `Reflectance x10000` without its factor.
std::string without_powers_of_ten(std::string_view title) {
    std::string text(title);
    for (std::size_t at = text.find('1'); at != std::string::npos; at = text.find('1', at + 1)) {
        const char before = at > 0 ? text[at - 1] : ' ';
        const bool is_number = std::isalnum(static_cast<unsigned char>(before)) == 0 || before == 'x' || before == 'X';
        if (!is_number || at + 1 == text.size() || std::string_view("0eE").find(text[at + 1]) == std::string_view::npos)
            continue;
        text.erase(at, std::min(text.find_first_not_of("0123456789eE^*+-", at), text.size()) - at);
    }
    return text;
}

/// What a title states; a scale in it is the one that the header has applied already.
ValueStatement stated_in_title(std::string_view title, const EnviHeader& header) {
    const ValueStatement stated = values_stated_by_letter(title);
    const bool is_scaled = header.reflectance_scale_factor || !header.gain.empty();
    if (stated.unusable.empty() || !is_scaled) return stated;
    const ValueStatement plain = values_stated_by_letter(without_powers_of_ten(title));
    return plain.quantity ? plain : stated;
}

void read_values(const std::string& key, const EnviField& field, EnviHeader& header) {
    const bool in_prose = !is_envi_quantity_key(key);
    const std::string_view title = title_in(key, field.value);
    const ValueStatement stated = in_prose ? values_stated(title) : stated_in_title(title, header);
    const std::optional<std::string> in_words = unusable_in_prose(title);
    const bool unusable = in_prose ? in_words.has_value() : !stated.unusable.empty();
    if (unusable && (!header.other_quantity || (header.other_quantity->in_prose && !in_prose))) {
        header.other_quantity = {.line = field.line,
                                 .key = key,
                                 .value = std::string(field.value),
                                 .word = in_prose ? *in_words : std::string(trimmed(title)),
                                 .in_prose = in_prose};
    }
    if (!header.quantity) header.quantity = stated.quantity;
    header.percent = header.percent || (!in_prose && stated.unit == Unit::percent);
}

/// Names of bands that differ in numbers alone, as `Absorbance 400 nm`, where nothing else says what the values are.
void read_band_names(const EnviFields& fields, EnviHeader& header) {
    if (header.band_names.empty() || header.quantity || header.other_quantity || header.reflectance_scale_factor)
        return;
    const auto without_numbers = [](std::string name) {
        std::erase_if(name, [](char c) { return is_digit(c) || c == '.'; });
        return name;
    };
    const std::string common = without_numbers(header.band_names.front());
    const bool alike = std::ranges::all_of(header.band_names,
                                           [&](const std::string& name) { return without_numbers(name) == common; });
    if (alike) read_values("band names", {.line = fields.get("band names").line, .value = common}, header);
}

/// None where they contradict each other.
void take_specular(const std::optional<Specular>& stated, EnviHeader& header) {
    if (!stated) return;
    if (header.geometry.specular && header.geometry.specular != stated) {
        header.doubts.push_back({.message = "the header states specular included and excluded; the last counts",
                                 .remedy = "correct it, or state specular in the configuration"});
    }
    header.geometry.specular = stated;
}

bool is_of_geometry(std::string_view key) {
    return contains(key, "specular") || contains(key, "geometry") || contains(key, "gloss");
}

}  // namespace

bool is_envi_quantity_key(std::string_view key) {
    static constexpr std::array<std::string_view, 7> keys = {
        "z plot titles", "z plot title", "y plot titles", "y plot title", "data unit", "data quantity", "value units"};
    return key != "data type" && (is_ordinate_key(key) || std::ranges::find(keys, key) != keys.end());
}

void read_envi_quantity(const EnviFields& fields, EnviHeader& header) {
    std::set<std::string> keys;
    for (const auto& [key, field] : fields.all()) keys.insert(key);
    for (const std::string& key : keys) {
        if (is_envi_quantity_key(key)) read_values(key, *fields.find(key), header);
    }
    const bool is_titled = header.quantity.has_value();
    for (const std::string& key : keys) {
        const bool prose = is_prose(key);
        if (prose && !is_titled) read_values(key, *fields.find(key), header);
        if (is_of_geometry(key)) {
            const StatedGeometry stated = geometry_stated(key, fields.find(key)->value);
            if (stated.incidence_deg) header.geometry.incidence_deg = stated.incidence_deg;
            take_specular(stated.specular, header);
        } else if (prose || is_envi_quantity_key(key)) {
            take_specular(specular_stated(key, fields.find(key)->value), header);
        }
    }
    read_band_names(fields, header);
}

}  // namespace skinfit
