#include "app/fit_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace skinfit {
namespace {

void check(const NamedSpectra& named) {
    const std::size_t files = named.files.size();
    const std::size_t columns = named.columns.size();
    if (files > 1 && columns > 1 && files != columns) {
        throw InputError({.where = "--column",
                          .problem = fmt::format("{} columns for {} files", columns, files),
                          .why = "which column belongs to which file is not clear",
                          .remedy = "give one for each file, or one for all"});
    }
    if (std::ranges::count_if(named.files, is_standard_input) > 1) {
        throw InputError({.where = "FILE",
                          .problem = "standard input twice",
                          .why = "it can be read once",
                          .remedy = "give - once, and name the columns of several spectra by --column"});
    }
}

/// The name that a file gives to its only spectrum: not that of the file, and no word for what is measured, as which
/// `skinfit convert` writes the name of a column. A column that is chosen among several is of a table of many
/// specimens.
std::string specimen_of(const Spectrum& spectrum, const ReadOptions& options) {
    const bool is_of_file = spectrum.name == std::filesystem::path(spectrum.source).stem().string();
    const bool is_quantity = std::ranges::find(quantity_names, spectrum.name) != quantity_names.end();
    const bool is_place = spectrum.name.starts_with("line ");  // as readers call one that has no name
    return options.column || is_of_file || is_quantity || is_place ? "" : spectrum.name;
}

NamedSpectrum read_named(const std::string& name, const std::string& file, const ReadOptions& options,
                         MeasuredFiles& measured) {
    NamedSpectrum input{.name = name, .specimen = {}, .spectrum = {}, .refusal = {}};
    try {
        input.spectrum = measured.spectrum(file, options);
        input.specimen = specimen_of(*input.spectrum, options);
    } catch (const InputError& error) {
        input.refusal = error;
    }
    return input;
}

}  // namespace

std::vector<NamedSpectrum> read_spectra_named(const NamedSpectra& named, MeasuredFiles& measured) {
    check(named);
    const std::size_t files = named.files.size();
    const std::size_t columns = named.columns.size();
    std::vector<NamedSpectrum> spectra;
    for (std::size_t k = 0; k < std::max(files, columns); ++k) {
        const std::string& file = named.files[files == 1 ? 0 : k];
        ReadOptions options = named.options;
        std::string name = file;
        if (columns > 0) options.column = named.columns[columns == 1 ? 0 : k];
        if (columns > 1) name += " " + named.columns[k];
        spectra.push_back(read_named(name, file, options, measured));
    }
    return spectra;
}

bool state_one_specimen(const std::vector<NamedSpectrum>& spectra) {
    const std::string& first = spectra.front().specimen;
    return !first.empty() &&
           std::ranges::all_of(spectra, [&](const NamedSpectrum& each) { return each.specimen == first; });
}

}  // namespace skinfit
