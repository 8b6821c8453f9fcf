#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/cells.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/jcamp_blocks.hpp"
#include "measurements/jcamp_points.hpp"
#include "measurements/left_out.hpp"
#include "measurements/limits.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/stated_words.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// The wavelengths that abscissas in XUNITS stand for.
std::vector<double> wavelengths(const JcampBlock& block, const std::vector<double>& x) {
    const std::optional<Abscissa> unit = abscissa_in_unit(block.text("XUNITS"));
    if (!unit) {
        refuse_jcamp(block.source(), block.line_of("XUNITS"),
                     fmt::format("##XUNITS= is {}", in_quotes(block.text("XUNITS"))),
                     "it must be a unit of wavelengths such as NANOMETERS or MICROMETERS, 1/CM, or a unit of frequency",
                     "correct it, or export the spectrum again");
    }
    return wavelengths_nm(*unit, x);
}

Quantity quantity_of(const JcampBlock& block) {
    const std::string unit = block.text("YUNITS");
    const ValueStatement stated = values_stated_by_letter(unit);
    if (stated.quantity) return *stated.quantity;
    refuse_jcamp(block.source(), block.line_of("YUNITS"), fmt::format("##YUNITS= is {}", in_quotes(unit)),
                 "only REFLECTANCE and TRANSMITTANCE are spectra that can be used",
                 stated.unusable.empty() ? "export the spectrum again as one of these, or set ##YUNITS= REFLECTANCE if "
                                           "that is what it holds"
                                         : remedy_for(unit));
}

/// By records such as ##SAMPLING PROCEDURE=, ##$SPECULAR= or ##$GEOMETRY=, else by the title.
Geometry geometry_of(const JcampBlock& block) {
    Geometry geometry;
    for (const auto& [label, record] : block.records()) {
        const bool speaks = label == "SAMPLINGPROCEDURE" || contains(label, "SPECULAR") ||
                            contains(label, "GEOMETRY") || is_ordinate_key(label);
        if (!speaks) continue;
        const StatedGeometry stated = geometry_stated(label, record.value());
        if (stated.incidence_deg) geometry.incidence_deg = stated.incidence_deg;
        if (stated.specular) geometry.specular = stated.specular;
    }
    if (!geometry.specular) geometry.specular = specular_stated(block.text("TITLE"));
    return geometry;
}

void refuse_other_data(const JcampBlock& block) {
    const std::string type = lower_case(block.text("DATATYPE"));
    for (const std::string_view other : {"raman", "mass", "nmr", "interferogram", "peak", "fluoresc", "chromatogram"}) {
        if (type.find(other) == std::string::npos) continue;
        refuse_jcamp(block.source(), block.line_of("DATATYPE"),
                     fmt::format("##DATA TYPE= is {}", in_quotes(block.text("DATATYPE"))),
                     "it is no spectrum of reflectance or transmittance", "export the spectrum again, or correct it");
    }
}

Spectrum spectrum_of(const JcampBlock& block, const JcampRecord& data, const ReadOptions& options) {
    const std::string form = normalised_label(data.value());
    if (form != "(X++(Y..Y))" && form != "(XY..XY)") {
        refuse_jcamp(block.source(), data.line(), fmt::format("has the form {}", in_quotes(data.value())),
                     "only (X++(Y..Y)) and (XY..XY) are read", "export the spectrum again in one of these");
    }
    refuse_other_data(block);
    Spectrum spectrum;
    spectrum.name = block.text("TITLE");
    if (spectrum.name.empty()) spectrum.name = fmt::format("line {}", data.line());
    spectrum.source = block.source();
    spectrum.line = data.line();
    spectrum.quantity = quantity_of(block);
    spectrum.instrument = block.text("SPECTROMETERDATASYSTEM");
    spectrum.geometry = geometry_of(block);
    JcampPoints points = jcamp_points(block, data, form == "(XY..XY)");
    spectrum.doubts = std::move(points.doubts);
    if (const auto other = unusable_in_prose(block.text("DATAPROCESSING"))) {
        spectrum.doubts.push_back(
            {.message = fmt::format("line {}: ##DATA PROCESSING= speaks of {}, and ##YUNITS= is {}",
                                    block.line_of("DATAPROCESSING"), *other, in_quotes(block.text("YUNITS"))),
             .remedy = "check that the values are what ##YUNITS= says"});
    }
    if (points.fill) spectrum.remarks.push_back(fmt::format("readings of {} stand for missing values", *points.fill));
    if (std::ranges::any_of(points.y, [](double y) { return std::isinf(y); })) {
        refuse_jcamp(block.source(), data.line(), "holds a number that is too large", "it exceeds double precision",
                     "correct it or ##YFACTOR=");
    }
    const std::vector<double> wavelength_nm = wavelengths(block, points.x);
    const Grid grid = make_grid(wavelength_nm, [&](std::size_t i) {
        return GridPlace{.where = fmt::format("{}:{}", block.source(), data.line()),
                         .which = fmt::format("point {}", i + 1)};
    });
    const std::string header = block.text("YUNITS");
    take_readings(spectrum, grid, {.value = points.y},
                  {.option = options.unit, .comment = std::nullopt, .header = header, .window = options.window});
    return spectrum;
}

/// The points that equal steps promise: a few bytes may decode to very many.
std::size_t promised_points(const JcampBlock& block) {
    const double count = parse_number(block.text("NPOINTS")).value_or(0);
    return count > 0 ? static_cast<std::size_t>(std::min(count, static_cast<double>(most_jcamp_points))) : 0;
}

}  // namespace

bool holds_jcamp_dx(std::string_view text) {
    LineReader reader(text);
    while (const auto whole = reader.next()) {
        const std::string_view line = without_jcamp_comment(*whole);
        if (line.empty()) continue;
        return line.starts_with("##") && normalised_label(line.substr(2, line.find('=') - 2)) == "TITLE";
    }
    return false;
}

std::vector<Spectrum> read_jcamp_dx(std::string_view text, const std::string& source, const ReadOptions& options) {
    refuse_large_text(text, source);
    refuse_binary(text, source);
    std::vector<Spectrum> spectra;
    LeftOut left_out;
    std::size_t points = 0;
    for (const JcampBlock& block : jcamp_blocks(text, source)) {
        for (const std::string_view label : {"XYDATA", "XYPOINTS"}) {
            const JcampRecord* const data = block.record(label);
            if (data == nullptr) continue;
            points += promised_points(block);
            if (points > most_jcamp_points) {
                refuse_jcamp(source, data->line(), "has too many points",
                             fmt::format("at most {} are read from one file", most_jcamp_points), "split the file");
            }
            left_out.or_keep_error([&] { spectra.push_back(spectrum_of(block, *data, options)); });
            if (!spectra.empty() && spectra.back().value.empty()) spectra.pop_back();
        }
    }
    left_out.tell(spectra);
    if (spectra.empty()) {
        throw InputError({.where = source,
                          .problem = "holds no spectra",
                          .why = "no block of it has ##XYDATA= or ##XYPOINTS= with values",
                          .remedy = "export the spectrum as one of these; peak tables and NTUPLES are not read"});
    }
    return spectra;
}

}  // namespace skinfit
