#include "measurements/envi_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <limits>
#include <utility>
#include <vector>

#include "core/file.hpp"
#include "core/input_error.hpp"

namespace skinfit {
namespace {

bool is_file(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

constexpr std::size_t most_header_bytes = std::size_t{16} << 20U;

/// The text of the file where it begins as a header does; no more than the beginning of any other is read.
std::optional<EnviHeaderFile> header_at(const std::filesystem::path& path) {
    constexpr std::size_t beginning = 64;  // bytes
    if (!is_file(path)) return std::nullopt;
    std::string text = read_input(path, [](std::string_view so_far) {
        return so_far.size() <= most_header_bytes && (so_far.size() < beginning || is_envi_header(so_far));
    });
    if (!is_envi_header(text)) return std::nullopt;
    return EnviHeaderFile{.path = path, .text = std::move(text)};
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

std::optional<EnviHeaderFile> envi_header_beside(const std::filesystem::path& path) {
    if (!is_file(path)) return std::nullopt;
    const std::vector<std::string> endings = data_endings();
    const bool replaceable = std::ranges::find(endings, path.extension().string()) != endings.end();
    for (const std::string_view ending : {".hdr", ".HDR"}) {
        std::filesystem::path behind = path;
        behind += ending;
        if (std::optional<EnviHeaderFile> header = header_at(behind)) return header;
        if (!replaceable) continue;
        const std::filesystem::path instead = std::filesystem::path(path).replace_extension(ending);
        if (std::optional<EnviHeaderFile> header = header_at(instead)) return header;
    }
    return std::nullopt;
}

EnviFiles files_of(EnviHeaderFile header) {
    const std::vector<std::filesystem::path> data = data_files(header.path);
    if (data.size() == 1) return {.header = header.path, .data = data.front(), .header_text = std::move(header.text)};
    if (data.empty()) {
        throw InputError({.where = header.path.string(),
                          .problem = "has no data file beside it",
                          .why = "a header holds no measurements",
                          .remedy = fmt::format("put the data beside it, called {}",
                                                header.path.filename().replace_extension("dat").string())});
    }
    throw InputError({.where = header.path.string(),
                      .problem = "has several data files beside it",
                      .why = fmt::format("{} and {} may both belong to it", data[0].filename().string(),
                                         data[1].filename().string()),
                      .remedy = "name the data file instead of the header"});
}

std::optional<EnviFiles> envi_files(const std::filesystem::path& path) {
    if (std::optional<EnviHeaderFile> beside = envi_header_beside(path)) {
        return EnviFiles{.header = beside->path, .data = path, .header_text = std::move(beside->text)};
    }
    std::optional<EnviHeaderFile> header = header_at(path);
    if (!header) return std::nullopt;
    return files_of(std::move(*header));
}

EnviFiles find_envi_files(const std::filesystem::path& path) {
    if (std::optional<EnviFiles> files = envi_files(path)) return std::move(*files);
    throw InputError({.where = path.string(),
                      .problem = "is no ENVI file",
                      .why = "neither it nor a .hdr file beside it begins with the line ENVI",
                      .remedy = "name the header or the data of an ENVI cube"});
}

EnviHeader read_envi_header(const EnviFiles& files) {
    if (files.header_text.size() > most_header_bytes) {
        throw InputError({.where = files.header.string(),
                          .problem = "has more than 16 MiB",
                          .why = "no header of a cube needs as much",
                          .remedy = "check that it is a header"});
    }
    EnviHeader header = parse_envi_header(files.header_text, files.header.string());
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
