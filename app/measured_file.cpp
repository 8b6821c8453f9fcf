#include "app/measured_file.hpp"

#include <unistd.h>

#include "app/terminal.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "measurements/envi_reader.hpp"

namespace skinfit {
namespace {

constexpr const char* standard_input_name = "standard input";

}  // namespace

bool is_standard_input(const std::string& file) {
    return file == "-";
}

MeasuredFiles::MeasuredFiles(const std::string& reader, bool quiet)
    : reader_(reader.empty() ? std::nullopt : std::optional(reader)), quiet_(quiet) {}

const std::string& MeasuredFiles::standard_input() {
    if (!standard_input_) {
        if (reader_ == envi_reader_name) {
            throw InputError({.where = standard_input_name,
                              .problem = "cannot be an ENVI cube",
                              .why = "that is two files",
                              .remedy = "name one of them"});
        }
        if (is_terminal(STDIN_FILENO) && !quiet_) say_line("type or paste a spectrum; Ctrl-D ends it");
        standard_input_ = read_standard_input();
    }
    return *standard_input_;
}

SpectrumFile MeasuredFiles::spectra(const std::string& file, const ReadOptions& options) {
    if (!is_standard_input(file)) return read_spectra(file, options, reader_);
    return parse_spectra(standard_input(), standard_input_name, options, reader_);
}

Spectrum MeasuredFiles::spectrum(const std::string& file, const ReadOptions& options) {
    if (!is_standard_input(file)) return read_spectrum(file, options, reader_);
    return parse_spectrum(standard_input(), standard_input_name, options, reader_);
}

}  // namespace skinfit
