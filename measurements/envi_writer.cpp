#include "measurements/envi_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <cassert>
#include <string_view>

#include "core/file.hpp"
#include "core/input_error.hpp"

namespace skinfit {
namespace {

std::string header_text(const Planes& planes) {
    std::vector<std::string_view> names;
    for (const Plane& plane : planes.planes) names.push_back(plane.name);
    return fmt::format(
        "ENVI\ndescription = {{{}}}\nsamples = {}\nlines = {}\nbands = {}\nheader offset = 0\n"
        "file type = ENVI Standard\ndata type = 4\ninterleave = bsq\nbyte order = {}\ndata ignore value = nan\n"
        "band names = {{{}}}\n",
        planes.description, planes.samples, planes.lines, planes.planes.size(),
        std::endian::native == std::endian::little ? 0 : 1, fmt::join(names, ", "));
}

}  // namespace

void write_envi(const std::filesystem::path& path, const Planes& planes) {
    const std::filesystem::path header = std::filesystem::path(path).replace_extension("hdr");
    if (header == path) {
        throw InputError({.where = path.string(),
                          .problem = "is called like its header",
                          .why = "an ENVI file has its data in another",
                          .remedy = "give it another ending, such as dat"});
    }
    assert(!planes.planes.empty());
    std::string bytes;
    bytes.reserve(planes.planes.size() * planes.samples * planes.lines * sizeof(float));
    for (const Plane& plane : planes.planes) {
        assert(plane.value.size() == planes.samples * planes.lines);
        assert(plane.name.find_first_of(",{}\r\n") == std::string::npos);
        bytes.append(reinterpret_cast<const char*>(plane.value.data()), plane.value.size() * sizeof(float));
    }
    write_file_atomically(path, bytes);
    write_file_atomically(header, header_text(planes));
}

}  // namespace skinfit
