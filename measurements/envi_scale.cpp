#include "measurements/envi_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.hpp"
#include "measurements/envi_quantity.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// A number for every band: as given, or one for all.
std::vector<double> per_band(const EnviFields& fields, const std::string& key, std::uint64_t bands) {
    const std::optional<EnviField> field = fields.find(key);
    if (field && parse_number(field->value)) {
        const double same = *fields.number(key);
        if (!std::isfinite(same)) fields.refuse(key, *field, "it must be finite");
        return std::vector<double>(bands, same);
    }
    return fields.numbers(key, bands);
}

/// By the documentation of ENVI, gains and offsets of reflectance go before those of radiance.
void read_gains(const EnviFields& fields, EnviHeader& header) {
    const bool of_reflectance =
        fields.find("data reflectance gain values") || fields.find("data reflectance offset values");
    const std::string kind = of_reflectance ? "data reflectance " : "data ";
    header.gain = per_band(fields, kind + "gain values", header.bands);
    header.data_offset = per_band(fields, kind + "offset values", header.bands);
    const auto zero = std::ranges::find(header.gain, 0.0);
    if (zero != header.gain.end()) {
        fields.refuse(kind + "gain values", fields.get(kind + "gain values"), "a gain of 0 leaves nothing of a band");
    }
    if (!of_reflectance) return;
    for (const std::string key : {"data gain values", "data offset values"}) {
        if (!fields.find(key)) continue;
        header.remarks.push_back(fmt::format(
            "\"{}\" of the header is not used: there are \"data reflectance gain values\" or offsets", key));
    }
}

void read_scale_factor(const EnviFields& fields, EnviHeader& header) {
    header.reflectance_scale_factor = fields.number("reflectance scale factor");
    if (!header.reflectance_scale_factor) return;
    const double one = *header.reflectance_scale_factor;
    const EnviField field = fields.get("reflectance scale factor");
    if (!(one > 0 && std::isfinite(one))) fields.refuse("reflectance scale factor", field, "it must be above 0");
    constexpr double rounding = 1e-6;  // of factors as headers print them
    const auto undoes = [one](double gain) { return std::abs(gain * one - 1) <= rounding; };
    if (one != 1 && !header.gain.empty() && std::ranges::all_of(header.gain, undoes)) {
        fields.refuse("reflectance scale factor", field,
                      "the gains make the same conversion, and whether both are to be applied is not known");
    }
}

/// Keys with words of a conversion that are not among those read.
void remark_on_unread(const EnviFields& fields, EnviHeader& header) {
    static constexpr std::array<std::string_view, 10> read = {"header offset",
                                                              "x start",
                                                              "data gain values",
                                                              "data offset values",
                                                              "data ignore value",
                                                              "wavelength units",
                                                              "data reflectance gain values",
                                                              "reflectance scale factor",
                                                              "data reflectance offset values",
                                                              "default stretch"};
    static constexpr std::array<std::string_view, 10> words = {
        "scale", "gain", "offset", "factor", "unit", "calibration", "multipl", "divisor", "nodata", "no data"};
    for (const auto& [key, field] : fields.all()) {
        const bool converts =
            std::ranges::any_of(words, [&key](std::string_view word) { return key.find(word) != std::string::npos; });
        if (!converts || std::ranges::find(read, key) != read.end() || is_envi_quantity_key(key) || field.value.empty())
            continue;
        if (key.find("map") != std::string::npos || key.find("geo") != std::string::npos) continue;
        const std::string message = fmt::format("line {} of the header, {} = {}, is not understood and not applied",
                                                field.line, in_quotes(key), in_quotes(field.value));
        const bool scales = key.find("scale") != std::string::npos && parse_number(field.value).value_or(0) != 1.0;
        if (!scales) {
            header.remarks.push_back(message);
            continue;
        }
        header.doubts.push_back({.message = message,
                                 .remedy = "state it as \"data gain values\", \"data offset values\" or \"reflectance "
                                           "scale factor\" if it changes the values, else delete it"});
    }
}

}  // namespace

void read_envi_scale(const EnviFields& fields, EnviHeader& header) {
    read_gains(fields, header);
    read_scale_factor(fields, header);
    read_envi_quantity(fields, header);
    remark_on_unread(fields, header);
}

}  // namespace skinfit
