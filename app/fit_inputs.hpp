#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/measured_file.hpp"
#include "core/input_error.hpp"

namespace skinfit {

/// The spectra that a command line names. Columns belong to the one file, or to the files in their order, or the one to
/// all files.
struct NamedSpectra {
    std::vector<std::string> files;    ///< at least one
    std::vector<std::string> columns;  ///< empty: that of `options`
    ReadOptions options;
};

/// One of them, or why it could not be read.
struct NamedSpectrum {
    std::string name;      ///< its file, with its column where several are named
    std::string specimen;  ///< as a file of one spectrum names it; empty where it does not
    std::optional<Spectrum> spectrum;
    std::optional<InputError> refusal;
};

/// Reads each once. Throws InputError where it is not clear which column belongs to which file.
[[nodiscard]] std::vector<NamedSpectrum> read_spectra_named(const NamedSpectra& named, MeasuredFiles& measured);

/// Whether all are read, and their files name one specimen.
[[nodiscard]] bool state_one_specimen(const std::vector<NamedSpectrum>& spectra);

}  // namespace skinfit
