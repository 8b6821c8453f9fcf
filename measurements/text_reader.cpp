#include "measurements/text_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry.hpp"
#include "core/input_error.hpp"
#include "measurements/column_reader.hpp"
#include "measurements/spectrum_choice.hpp"
#include "measurements/spectrum_file.hpp"

namespace skinfit {
namespace {

[[noreturn]] void refuse_choice(const SpectrumFile& file, std::string_view text) {
    if (file.format == "columns") refuse_several_columns(text, file.source);
    throw InputError({.where = file.source,
                      .problem = fmt::format("has {} spectra", file.spectra.size()),
                      .why = list_of_names(file.spectra),
                      .remedy = "choose one with --column, by its name or its number"});
}

/// Of a value of the first spectrum. Lines are looked up in the text rather than kept with every value: only messages
/// need them.
ValuePlace place_of(const SpectrumFile& file, std::string_view text, const ReadOptions& options, double wavelength_nm) {
    if (file.format != "columns") {
        const std::size_t line = file.spectra.front().line;
        return {.where = line > 0 ? fmt::format("{}:{}", file.source, line) : file.source};
    }
    return place_in_columns(text, file.source, options, wavelength_nm);
}

/// Refuses values that no fit can use, where it uses them.
void check_values(const SpectrumFile& file, std::string_view text, const ReadOptions& options) {
    const Spectrum& spectrum = file.spectra.front();
    refuse_repeated(part_of(spectrum, options.window));
    const std::function<ValuePlace(std::size_t)> place = [&](std::size_t i) {
        return place_of(file, text, options, spectrum.wavelength_nm[i]);
    };
    for (std::size_t i = 0; i < spectrum.value.size(); ++i) {
        const double nm = spectrum.wavelength_nm[i];
        const double value = spectrum.value[i];
        if (!options.window.contains(nm)) continue;
        if (value < 0) {
            throw InputError({.where = place(i).where,
                              .problem = fmt::format("the value {} at {} nm is negative", value, nm),
                              .why = "no fraction of light is; it may be a dark-current offset",
                              .remedy = "correct the offset, or leave those wavelengths out with exclude_nm"});
        }
        if (value > largest_fraction) {
            throw InputError({.where = place(i).where,
                              .problem = fmt::format("the value {} at {} nm exceeds {}", value, nm, largest_fraction),
                              .why = fmt::format("as a fraction; the unit was taken as {}", spectrum.unit_rule),
                              .remedy = "correct the value, or, where the file is in percent, add a line \"# unit: "
                                        "percent\" or give --unit percent"});
        }
        refuse_sigma(spectrum, i, place);
    }
}

}  // namespace

void refuse_sigma(const Spectrum& spectrum, std::size_t i, const std::function<ValuePlace(std::size_t)>& place_of) {
    if (spectrum.sigma.empty() || sigma_range.contains(spectrum.sigma[i])) return;
    const ValuePlace place = place_of(i);
    if (spectrum.sigma[i] > 0.0) {
        throw InputError(
            {.where = place.where,
             .problem = fmt::format("{} is {} at {} nm", place.sigma, spectrum.sigma[i], spectrum.wavelength_nm[i]),
             .why = fmt::format("a standard uncertainty from {} to {} can be weighed, as a fraction",
                                sigma_range.lowest, sigma_range.highest),
             .remedy = "correct it, or delete its column and state noise=..."});
    }
    if (std::isnan(spectrum.sigma[i])) {
        throw InputError({.where = place.where,
                          .problem = fmt::format("{} has no number at {} nm", place.sigma, spectrum.wavelength_nm[i]),
                          .why = "every value needs its uncertainty",
                          .remedy = "give it, or delete the column of uncertainties"});
    }
    throw InputError(
        {.where = place.where,
         .problem = fmt::format("{} is {} at {} nm", place.sigma, spectrum.sigma[i], spectrum.wavelength_nm[i]),
         .why = "a standard uncertainty is above 0",
         .remedy = "correct it or delete its column"});
}

void refuse_repeated(const Spectrum& spectrum) {
    const auto twin = std::ranges::adjacent_find(spectrum.wavelength_nm);
    if (twin == spectrum.wavelength_nm.end()) return;
    const auto place = std::ranges::find(spectrum.repeated, *twin, &RepeatedWavelength::wavelength_nm);
    const bool is_known = place != spectrum.repeated.end();
    throw InputError({.where = is_known ? place->where : spectrum.source,
                      .problem = fmt::format("repeats the wavelength {} nm", *twin),
                      .why = is_known ? fmt::format("{} has it already", place->first)
                                      : "a spectrum has one value at each wavelength",
                      .remedy = "keep one of the two or average them"});
}

Spectrum spectrum_in(const OpenedSpectra& opened, const ReadOptions& options) {
    SpectrumFile file = spectra_in(opened, options);
    if (file.spectra.size() > 1) refuse_choice(file, opened.text);
    check_values(file, opened.text, options);
    return std::move(file.spectra.front());
}

Spectrum parse_spectrum(std::string_view text, const std::string& source, const ReadOptions& options,
                        const std::optional<std::string>& reader) {
    return spectrum_in({.source = source, .text = std::string(text), .cube = {}, .reader = reader}, options);
}

Spectrum read_spectrum(const std::filesystem::path& path, const ReadOptions& options,
                       const std::optional<std::string>& reader) {
    return spectrum_in(open_spectra(path, reader), options);
}

}  // namespace skinfit
