#include "measurements/envi_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <stdexcept>
#include <utility>

#include "core/file.hpp"
#include "core/input_error.hpp"

namespace skinfit {
namespace {

std::filesystem::path header_beside(const std::filesystem::path& data) {
    std::filesystem::path header = std::filesystem::path(data).replace_extension("hdr");
    if (header != data) return header;
    throw InputError({.where = data.string(),
                      .problem = "is called like its header",
                      .why = "an ENVI file has its data in another",
                      .remedy = "give it another ending, such as dat"});
}

/// As it may stand between braces.
std::string in_braces(std::string text) {
    std::ranges::replace(text, '{', '(');
    std::ranges::replace(text, '}', ')');
    std::ranges::replace_if(
        text, [](char c) { return c == '\r' || c == '\n'; }, ' ');
    return text;
}

std::string header_text(const EnviOutput& output) {
    std::string text = fmt::format(
        "ENVI\ndescription = {{{}}}\nsamples = {}\nlines = {}\nbands = {}\nheader offset = 0\n"
        "file type = ENVI Standard\ndata type = 4\ninterleave = bil\nbyte order = {}\ndata ignore value = nan\n"
        "band names = {{{}}}\n",
        in_braces(output.description), output.samples, output.lines, output.band_names.size(),
        std::endian::native == std::endian::little ? 0 : 1, fmt::join(output.band_names, ", "));
    for (const std::string& line : output.place) text += line + "\n";
    return text;
}

}  // namespace

EnviWriter::EnviWriter(const std::filesystem::path& path, EnviOutput output)
    : header_(header_beside(path)), output_(std::move(output)), data_(path) {
    assert(!output_.band_names.empty());
    assert(std::ranges::all_of(output_.band_names, [](const std::string& name) {
        return name.find_first_of(",{}\r\n") == std::string::npos;
    }));
}

void EnviWriter::append(std::string_view bytes) {
    data_.append(bytes);
    appended_ += bytes.size();
}

void EnviWriter::finish() {
    if (appended_ != output_.samples * output_.lines * output_.band_names.size() * sizeof(float)) {
        throw std::logic_error("the bytes of an ENVI file are not those of its header");
    }
    data_.finish();
    write_file_atomically(header_, header_text(output_));
}

}  // namespace skinfit
