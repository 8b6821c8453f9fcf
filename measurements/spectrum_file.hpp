#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/spectrum.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit {

/// Everything one file holds.
struct SpectrumFile {
    std::string source;             ///< the file, as messages name it
    std::string format;             ///< the reader's name
    std::vector<Spectrum> spectra;  ///< at least one, in the file's order; values as they are, checked by nobody
};

/// The names of the readers, in the order in which they are asked whether they recognise a file.
[[nodiscard]] std::vector<std::string_view> reader_names();

/// The text of a file of spectra. Throws InputError as `read_file`, and when its first line is longer than any may be,
/// without reading on.
[[nodiscard]] std::string read_spectrum_text(const std::filesystem::path& path);

/// Reads every spectrum of a file, or only `options.column`. `reader` overrides the recognition of the format by its
/// content. Throws InputError for a file that is no file of spectra; values that no spectrum has are no reason.
[[nodiscard]] SpectrumFile read_spectra(const std::filesystem::path& path, const ReadOptions& options = {},
                                        const std::optional<std::string>& reader = {});

/// The same for text already read; `source` names it in messages.
[[nodiscard]] SpectrumFile parse_spectra(std::string_view text, const std::string& source,
                                         const ReadOptions& options = {},
                                         const std::optional<std::string>& reader = {});

}  // namespace skinfit
