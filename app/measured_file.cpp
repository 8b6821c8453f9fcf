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

OpenedSpectra MeasuredFiles::standard_input() const {
    if (reader_ == envi_reader_name) {
        throw InputError({.where = standard_input_name,
                          .problem = "cannot be an ENVI cube",
                          .why = "that is two files",
                          .remedy = "name one of them"});
    }
    if (is_terminal(STDIN_FILENO) && !quiet_) say_line("type or paste a spectrum; Ctrl-D ends it");
    return {.source = standard_input_name, .text = read_standard_input(), .cube = {}, .reader = reader_};
}

const OpenedSpectra& MeasuredFiles::open(const std::string& file) {
    const auto found = opened_.find(file);
    if (found != opened_.end()) return found->second;
    return opened_.emplace(file, is_standard_input(file) ? standard_input() : open_spectra(file, reader_))
        .first->second;
}

SpectrumFile MeasuredFiles::spectra(const std::string& file, const ReadOptions& options) {
    return spectra_in(open(file), options);
}

Spectrum MeasuredFiles::spectrum(const std::string& file, const ReadOptions& options) {
    return spectrum_in(open(file), options);
}

std::vector<std::filesystem::path> MeasuredFiles::files_of_cubes() const {
    std::vector<std::filesystem::path> files;
    for (const auto& [name, opened] : opened_) {
        if (!opened.cube) continue;
        files.push_back(opened.cube->header);
        files.push_back(opened.cube->data);
    }
    return files;
}

}  // namespace skinfit
