#include "measurements/envi_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/envi_bands.hpp"
#include "measurements/envi_fields.hpp"
#include "measurements/envi_scale.hpp"
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
}

/// `EnviHeader::file_type`. Data of other programs have headers of their own in front or between.
std::string read_file_type(const EnviFields& fields) {
    const std::optional<EnviField> field = fields.find("file type");
    if (!field) return {};
    const std::string type = lower_case(field->value);
    for (const std::string_view other : {"meta file", "virtual mosaic", "tiff", "hdf", "nitf", "jpeg", "jp2", "png",
                                         "bmp", "erdas", "esri", "pci", "mrsid", "ecw", "ascii", "fft", "vector"}) {
        if (type.find(other) == std::string::npos) continue;
        fields.refuse("file type", *field, "only the plain data of ENVI Standard and ENVI Spectral Library are read");
    }
    return type;
}

std::string on_one_line(std::string_view text) {
    std::string line(text);
    std::ranges::replace_if(
        line, [](char c) { return c == '\r' || c == '\n'; }, ' ');
    return line;
}

/// The names in a list of `count`; none where it is not given or not as long.
std::vector<std::string> read_names(const EnviFields& fields, std::string_view key, std::uint64_t count) {
    const std::optional<EnviField> field = fields.find(key);
    if (!field) return {};
    std::vector<std::string> names;
    for (const std::string_view name : split(field->value, ',')) names.push_back(on_one_line(name));
    return names.size() == count ? names : std::vector<std::string>{};
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

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    return text.substr(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
}

bool is_envi_header(std::string_view text) {
    constexpr std::string_view word = "ENVI";
    text = without_byte_order_mark(text);
    return text.starts_with(word) &&
           trimmed(text.substr(word.size(), text.find_first_of("\r\n") - word.size())).empty();
}

EnviHeader parse_envi_header(std::string_view text, const std::string& source) {
    const EnviFields fields(text, source);
    refuse_other_layouts(fields);
    EnviHeader header;
    header.source = source;
    header.file_type = read_file_type(fields);
    header.spectral_library = header.file_type.find("spectral library") != std::string::npos;
    header.samples = fields.count("samples", 1, header.spectral_library ? most_bands : most_samples);
    header.lines = fields.count("lines", 1, most_samples);
    header.bands = fields.count("bands", 1, header.spectral_library ? 1 : most_bands);
    if (fields.find("header offset")) header.header_offset = fields.count("header offset", 0, most_samples);
    header.data_type = read_data_type(fields);
    if (header.spectral_library) {
        std::swap(header.samples, header.bands);
        header.interleave = Interleave::bip;
        header.spectra_names = read_names(fields, "spectra names", header.lines);
    } else {
        header.interleave = read_interleave(fields);
        header.band_names = read_names(fields, "band names", header.bands);
    }
    read_envi_bands(fields, header);
    read_envi_scale(fields, header);
    header.data_ignore_value = fields.number("data ignore value");
    if (const auto sensor = fields.find("sensor type")) header.sensor_type = sensor->value;
    header.place = read_place(fields);
    return header;
}

}  // namespace skinfit
