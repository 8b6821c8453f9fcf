#include "measurements/envi_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <limits>
#include <vector>

#include "core/file.hpp"
#include "core/input_error.hpp"

namespace skinfit {
namespace {

bool is_file(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

bool begins_as_header(const std::filesystem::path& path) {
    if (!is_file(path)) return false;
    std::array<char, 64> start{};
    std::ifstream stream(path, std::ios::binary);
    stream.read(start.data(), start.size());
    return is_envi_header({start.data(), static_cast<std::size_t>(stream.gcount())});
}

/// The endings of data whose header has `.hdr` in their place.
std::vector<std::string> data_endings() {
    std::vector<std::string> endings;
    for (const std::string ending : {".dat", ".img", ".raw", ".bin", ".bsq", ".bil", ".bip", ".cube", ".hyspex", ".hsi",
                                     ".flt", ".ref", ".rfl", ".rad", ".sli", ".slb", ".lib"}) {
        endings.push_back(ending);
        endings.push_back(ending);
        for (char& c : endings.back()) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    return endings;
}

std::vector<std::filesystem::path> data_files(const std::filesystem::path& header) {
    std::filesystem::path stem = header;
    if (is_file(stem.replace_extension()) && stem != header) return {stem};
    std::vector<std::filesystem::path> found;
    for (const std::string& ending : data_endings()) {
        const std::filesystem::path path = std::filesystem::path(header).replace_extension(ending);
        if (path != header && is_file(path)) found.push_back(path);
    }
    return found;
}

bool is_gzipped(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return stream.get() == 0x1f && stream.get() == 0x8b;
}

[[noreturn]] void refuse_short_data(const EnviFiles& files, std::uintmax_t found, std::uint64_t promised) {
    if (is_gzipped(files.data)) {
        throw InputError({.where = files.data.string(),
                          .problem = "is compressed by gzip",
                          .why = "only plain data are read",
                          .remedy = "unpack it with gunzip"});
    }
    throw InputError({.where = files.data.string(),
                      .problem = fmt::format("has {} bytes", found),
                      .why = fmt::format("its header promises {}", promised == std::numeric_limits<std::uint64_t>::max()
                                                                       ? "more than 2^64"
                                                                       : fmt::to_string(promised)),
                      .remedy = "copy the file again if it is cut short, else correct the sizes in the header"});
}

FileDoubt doubt_about_long_data(const EnviFiles& files, std::uintmax_t found, std::uintmax_t excess) {
    return {.message = fmt::format("{} has {} bytes, {} more than its header promises; if any stand in front of the "
                                   "numbers, all values belong to other bands or pixels",
                                   files.data.filename().string(), found, excess),
            .remedy =
                "state the bytes in front as \"header offset\", correct the sizes in the header, or cut off what "
                "stands behind the numbers"};
}

}  // namespace

std::optional<std::filesystem::path> find_envi_header(const std::filesystem::path& path) {
    if (begins_as_header(path)) return path;
    if (!is_file(path)) return std::nullopt;
    const std::vector<std::string> endings = data_endings();
    const bool replaceable = std::ranges::find(endings, path.extension().string()) != endings.end();
    for (const std::string_view ending : {".hdr", ".HDR"}) {
        std::filesystem::path behind = path;
        behind += ending;
        if (begins_as_header(behind)) return behind;
        const std::filesystem::path instead = std::filesystem::path(path).replace_extension(ending);
        if (replaceable && begins_as_header(instead)) return instead;
    }
    return std::nullopt;
}

EnviFiles find_envi_files(const std::filesystem::path& path) {
    const std::optional<std::filesystem::path> header = find_envi_header(path);
    if (!header) {
        throw InputError({.where = path.string(),
                          .problem = "is no ENVI file",
                          .why = "neither it nor a .hdr file beside it begins with the line ENVI",
                          .remedy = "name the header or the data of an ENVI cube"});
    }
    if (*header != path) return {.header = *header, .data = path};
    const std::vector<std::filesystem::path> data = data_files(*header);
    if (data.size() == 1) return {.header = *header, .data = data.front()};
    if (data.empty()) {
        throw InputError({.where = header->string(),
                          .problem = "has no data file beside it",
                          .why = "a header holds no measurements",
                          .remedy = fmt::format("put the data beside it, called {}",
                                                header->filename().replace_extension("dat").string())});
    }
    throw InputError({.where = header->string(),
                      .problem = "has several data files beside it",
                      .why = fmt::format("{} and {} may both belong to it", data[0].filename().string(),
                                         data[1].filename().string()),
                      .remedy = "name the data file instead of the header"});
}

EnviHeader read_envi_header(const EnviFiles& files) {
    constexpr std::uintmax_t most_bytes = std::uintmax_t{16} << 20U;
    if (std::filesystem::file_size(files.header) > most_bytes) {
        throw InputError({.where = files.header.string(),
                          .problem = "has more than 16 MiB",
                          .why = "no header of a cube needs as much",
                          .remedy = "check that it is a header"});
    }
    EnviHeader header = parse_envi_header(read_file(files.header), files.header.string());
    const std::uintmax_t found = std::filesystem::file_size(files.data);
    const std::uint64_t promised = header.data_file_bytes();
    if (found < promised) refuse_short_data(files, found, promised);
    if (found > promised) header.doubts.push_back(doubt_about_long_data(files, found, found - promised));
    return header;
}

Raster open_envi_data(const EnviFiles& files, const EnviHeader& header) {
    const bool by_pixel = header.interleave == Interleave::bip;
    const std::uint64_t columns = by_pixel ? header.samples * header.bands : header.samples;
    const std::uint64_t rows = by_pixel ? header.lines : header.lines * header.bands;
    constexpr std::uint64_t most_numbers = std::uint64_t{1} << 23U;
    constexpr std::uint64_t most_rows = std::numeric_limits<std::int32_t>::max();
    if (header.samples * header.bands > most_numbers || rows > most_rows) {
        throw InputError(
            {.where = header.source,
             .problem = fmt::format("describes {} x {} pixels of {} bands", header.samples, header.lines, header.bands),
             .why = fmt::format("at most {} samples times bands and {} lines times bands can be read", most_numbers,
                                most_rows),
             .remedy = "cut the cube into parts"});
    }
    return Raster(RawNumbers{.path = files.data,
                             .first_byte = header.header_offset,
                             .type = header.data_type,
                             .columns = columns,
                             .rows = rows});
}

}  // namespace skinfit
