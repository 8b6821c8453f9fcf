#include "measurements/envi_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/envi_fields.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// More cannot be read through GDAL.
constexpr std::uint64_t most_samples = std::numeric_limits<std::int32_t>::max();
constexpr std::uint64_t most_bands = 65536;

NumberType read_data_type(const EnviFields& fields) {
    static const std::map<std::string_view, NumberType> types = {
        {"1", {.kind = NumberKind::uint8, .bytes = 1}},   {"2", {.kind = NumberKind::int16, .bytes = 2}},
        {"3", {.kind = NumberKind::int32, .bytes = 4}},   {"4", {.kind = NumberKind::float32, .bytes = 4}},
        {"5", {.kind = NumberKind::float64, .bytes = 8}}, {"12", {.kind = NumberKind::uint16, .bytes = 2}},
        {"13", {.kind = NumberKind::uint32, .bytes = 4}}, {"14", {.kind = NumberKind::int64, .bytes = 8}},
        {"15", {.kind = NumberKind::uint64, .bytes = 8}},
    };
    const EnviField field = fields.get("data type");
    const auto found = types.find(field.value);
    if (found == types.end()) {
        const bool complex = field.value == "6" || field.value == "9";
        fields.refuse("data type", field,
                      complex ? "complex numbers are no fractions of light"
                              : "the types of real numbers are 1, 2, 3, 4, 5, 12, 13, 14 and 15");
    }
    NumberType type = found->second;
    // Without the field, the order of several bytes would be a guess.
    if (type.bytes > 1 || fields.find("byte order")) {
        type.most_significant_byte_first = fields.count("byte order", 0, 1) == 1;
    }
    return type;
}

Interleave read_interleave(const EnviFields& fields) {
    const EnviField field = fields.get("interleave");
    const auto* const found = std::ranges::find(interleave_names, lower_case(field.value));
    if (found == interleave_names.end()) fields.refuse("interleave", field, "it must be bsq, bil or bip");
    return static_cast<Interleave>(found - interleave_names.begin());
}

void refuse_other_layouts(const EnviFields& fields) {
    for (const std::string key : {"file compression", "major frame offsets", "minor frame offsets"}) {
        const std::optional<EnviField> field = fields.find(key);
        if (!field) continue;
        for (const std::string_view cell : split(field->value, ',')) {
            if (parse_number(cell) != 0.0) fields.refuse(key, *field, "only plain data without gaps are read");
        }
    }
    const std::optional<EnviField> kind = fields.find("file type");
    if (!kind) return;
    for (const std::string_view other : {"spectral library", "meta file", "virtual mosaic"}) {
        if (lower_case(kind->value).find(other) == std::string::npos) continue;
        fields.refuse("file type", *kind, "a cube is needed");
    }
}

/// The unit of the wavelengths.
struct LengthUnit {
    double nm;
    std::string rule;
};

LengthUnit find_wavelength_unit(const EnviFields& fields, const std::vector<double>& wavelengths) {
    const std::optional<EnviField> field = fields.find("wavelength units");
    const std::string word = field ? lower_case(field->value) : "";
    constexpr double nm_per_micrometre = 1000;
    for (const std::string_view name : {"nanometers", "nanometer", "nanometres", "nanometre", "nm"}) {
        if (word == name) return {.nm = 1, .rule = "nanometres: stated by the header"};
    }
    for (const std::string_view name : {"micrometers", "micrometer", "micrometres", "micrometre", "microns", "micron",
                                        "um", "\xC2\xB5m", "\xCE\xBCm", "\xB5m"}) {
        if (word == name) return {.nm = nm_per_micrometre, .rule = "micrometres: stated by the header"};
    }
    if (!word.empty() && word != "unknown") {
        fields.refuse("wavelength units", *field, "it must be nanometers or micrometers");
    }
    constexpr double largest_in_micrometres = 10;
    if (std::ranges::max(wavelengths) > largest_in_micrometres) {
        return {.nm = 1, .rule = fmt::format("nanometres: some exceed {}", largest_in_micrometres)};
    }
    return {.nm = nm_per_micrometre, .rule = fmt::format("micrometres: none exceeds {}", largest_in_micrometres)};
}

void read_wavelengths(const EnviFields& fields, EnviHeader& header) {
    header.wavelength_nm = fields.numbers("wavelength", header.bands);
    if (header.wavelength_nm.empty()) return;
    header.fwhm_nm = fields.numbers("fwhm", header.bands);
    const LengthUnit unit = find_wavelength_unit(fields, header.wavelength_nm);
    header.wavelength_rule = unit.rule;
    for (double& wavelength : header.wavelength_nm) wavelength *= unit.nm;
    for (double& width : header.fwhm_nm) width *= unit.nm;
}

std::string on_one_line(std::string_view text) {
    std::string line(text);
    std::ranges::replace_if(
        line, [](char c) { return c == '\r' || c == '\n'; }, ' ');
    return line;
}

/// `EnviHeader::band_names`.
std::vector<std::string> read_band_names(const EnviFields& fields, std::uint64_t bands) {
    const std::optional<EnviField> field = fields.find("band names");
    if (!field) return {};
    std::vector<std::string> names;
    for (const std::string_view name : split(field->value, ',')) names.push_back(on_one_line(name));
    return names.size() == bands ? names : std::vector<std::string>{};
}

/// `EnviHeader::place`.
std::vector<std::string> read_place(const EnviFields& fields) {
    std::vector<std::string> lines;
    for (const std::string key :
         {"map info", "projection info", "coordinate system string", "geo points", "pixel size"}) {
        const std::optional<EnviField> field = fields.find(key);
        if (field) lines.push_back(fmt::format("{} = {{{}}}", key, on_one_line(field->value)));
    }
    for (const std::string key : {"x start", "y start"}) {
        const std::optional<EnviField> field = fields.find(key);
        if (field) lines.push_back(fmt::format("{} = {}", key, on_one_line(field->value)));
    }
    return lines;
}

}  // namespace

std::uint64_t EnviHeader::data_file_bytes() const {
    std::uint64_t bytes = data_type.bytes;
    bool overflows = false;
    for (const std::uint64_t factor : {samples, lines, bands}) {
        overflows = __builtin_mul_overflow(bytes, factor, &bytes) || overflows;
    }
    overflows = __builtin_add_overflow(bytes, header_offset, &bytes) || overflows;
    return overflows ? std::numeric_limits<std::uint64_t>::max() : bytes;
}

bool is_envi_header(std::string_view text) {
    constexpr std::string_view word = "ENVI";
    return text.starts_with(word) &&
           trimmed(text.substr(word.size(), text.find_first_of("\r\n") - word.size())).empty();
}

EnviHeader parse_envi_header(std::string_view text, const std::string& source) {
    const EnviFields fields(text, source);
    refuse_other_layouts(fields);
    EnviHeader header;
    header.source = source;
    header.samples = fields.count("samples", 1, most_samples);
    header.lines = fields.count("lines", 1, most_samples);
    header.bands = fields.count("bands", 1, most_bands);
    if (fields.find("header offset")) header.header_offset = fields.count("header offset", 0, most_samples);
    header.data_type = read_data_type(fields);
    header.interleave = read_interleave(fields);

    header.reflectance_scale_factor = fields.number("reflectance scale factor");
    const double scale = header.reflectance_scale_factor.value_or(1);
    if (!(scale > 0 && std::isfinite(scale))) {
        fields.refuse("reflectance scale factor", fields.get("reflectance scale factor"), "it must be above 0");
    }
    header.data_ignore_value = fields.number("data ignore value");
    read_wavelengths(fields, header);
    if (const auto sensor = fields.find("sensor type")) header.sensor_type = sensor->value;
    header.good.assign(header.bands, true);
    const std::vector<double> marks = fields.numbers("bbl", header.bands);
    for (std::size_t band = 0; band < marks.size(); ++band) header.good[band] = marks[band] != 0;
    header.band_names = read_band_names(fields, header.bands);
    header.place = read_place(fields);
    return header;
}

}  // namespace skinfit
