#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_replacement.hpp"

namespace skinfit {

/// What the header of an ENVI file of 32-bit floating point numbers, interleaved by line, says.
struct EnviOutput {
    std::uint64_t samples = 0;            ///< pixels in a line
    std::uint64_t lines = 0;              ///< of each band
    std::vector<std::string> band_names;  ///< at least one, without commas, braces and line ends
    std::string description;              ///< braces become parentheses, and line ends blanks
    std::vector<std::string> place{};     ///< header lines, as `EnviHeader::place`
};

/// Writes an ENVI file in parts, line after line: all bands of a line, band after band, in the machine's byte order
/// (interleave bil). NaN is the `data ignore value`. The data, and then the header beside it with `hdr` in place of the
/// ending, are each put in place in one step at the end; without `finish` nothing changes. (GDAL's own writer does
/// neither.) The data may be larger than the memory.
class EnviWriter {
public:
    /// Throws InputError when `path` is called like its header, and as `FileReplacement`.
    EnviWriter(const std::filesystem::path& path, EnviOutput output);

    /// Throws InputError when the disk is full; then what was written is removed with the writer.
    void append(std::string_view bytes);

    /// After exactly the bytes of the picture. Throws InputError when the files cannot be put in place.
    void finish();

private:
    std::filesystem::path header_;
    EnviOutput output_;
    FileReplacement data_;
    std::uint64_t appended_ = 0;  ///< bytes
};

}  // namespace skinfit
