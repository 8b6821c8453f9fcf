#include "app/fit_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>

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

NamedSpectrum read_named(const std::string& name, const std::string& file, const ReadOptions& options,
                         MeasuredFiles& measured) {
    NamedSpectrum input{.name = name, .spectrum = {}, .refusal = {}};
    try {
        input.spectrum = measured.spectrum(file, options);
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
    const auto specimen = [](const NamedSpectrum& input) { return input.spectrum ? input.spectrum->specimen : ""; };
    const std::string first = specimen(spectra.front());
    // A column's name, as `skinfit convert` writes it where the file states no specimen, is none.
    if (first.empty() || std::ranges::find(quantity_names, first) != quantity_names.end()) return false;
    return std::ranges::all_of(spectra, [&](const NamedSpectrum& each) { return specimen(each) == first; });
}

}  // namespace skinfit
