#pragma once

#include <optional>
#include <string>

#include "measurements/spectrum_file.hpp"
#include "measurements/text_reader.hpp"

namespace skinfit {

/// Whether this FILE means what comes from standard input: "-".
[[nodiscard]] bool is_standard_input(const std::string& file);

/// Measured files as the command line names them.
class MeasuredFiles {
public:
    /// `reader` is that of --reader; empty: files are recognised. `quiet`: nobody is asked to type.
    MeasuredFiles(const std::string& reader, bool quiet);

    /// As `read_spectra`, of a file or of standard input, which is read once. Throws InputError.
    [[nodiscard]] SpectrumFile spectra(const std::string& file, const ReadOptions& options);

    /// As `read_spectrum`.
    [[nodiscard]] Spectrum spectrum(const std::string& file, const ReadOptions& options);

private:
    const std::string& standard_input();

    std::optional<std::string> reader_;
    bool quiet_;
    std::optional<std::string> standard_input_;  ///< once it is read
};

}  // namespace skinfit
