#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurements/envi_files.hpp"
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

/// A file of spectra that has been opened and read, once: whatever is asked of it later, its answers agree.
struct OpenedSpectra {
    std::string source;                   ///< the file, as messages name it
    std::string text;                     ///< all of it; empty where it is a cube, whose numbers are too many
    std::optional<EnviFiles> cube{};      ///< where it is an ENVI cube: its files, with the text of the header
    std::optional<std::string> reader{};  ///< overrides the recognition of the form
};

/// Opens the file, or pipe, at `path`. Throws InputError as `read_input`, and when its first line is longer than any
/// may be, without reading on; `reader` is that of a cube or of text.
[[nodiscard]] OpenedSpectra open_spectra(const std::filesystem::path& path,
                                         const std::optional<std::string>& reader = {});

/// Every spectrum of the file, or only `options.column`. Throws InputError as `read_spectra`.
[[nodiscard]] SpectrumFile spectra_in(const OpenedSpectra& opened, const ReadOptions& options = {});

/// Reads every spectrum of a file, or only `options.column`. `reader` overrides the recognition of the format by its
/// content. Throws InputError for a file that is no file of spectra; values that no spectrum has are no reason.
[[nodiscard]] SpectrumFile read_spectra(const std::filesystem::path& path, const ReadOptions& options = {},
                                        const std::optional<std::string>& reader = {});

/// The same for text already read; `source` names it in messages.
[[nodiscard]] SpectrumFile parse_spectra(std::string_view text, const std::string& source,
                                         const ReadOptions& options = {},
                                         const std::optional<std::string>& reader = {});

}  // namespace skinfit
