#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measurements/spectrum_file.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit {

/// Whether this FILE means what comes from standard input: "-".
[[nodiscard]] bool is_standard_input(const std::string& file);

/// Measured files as the command line names them, each opened once however many of its spectra are asked for.
class MeasuredFiles {
public:
    /// `reader` is that of --reader; empty: files are recognised. `quiet`: nobody is asked to type.
    MeasuredFiles(const std::string& reader, bool quiet);

    /// The file, or standard input, opened and read. Throws InputError.
    const OpenedSpectra& open(const std::string& file);

    /// As `spectra_in` it.
    [[nodiscard]] SpectrumFile spectra(const std::string& file, const ReadOptions& options);

    /// As `spectrum_in` it.
    [[nodiscard]] Spectrum spectrum(const std::string& file, const ReadOptions& options);

    /// The headers and the data of the cubes among those that are open.
    [[nodiscard]] std::vector<std::filesystem::path> files_of_cubes() const;

private:
    [[nodiscard]] OpenedSpectra standard_input() const;

    std::optional<std::string> reader_;
    bool quiet_;
    std::map<std::string, OpenedSpectra> opened_;
};

}  // namespace skinfit
