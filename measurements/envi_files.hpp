#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "measurements/envi_header.hpp"
#include "measurements/raster.hpp"

namespace skinfit {

/// The two files that together hold an ENVI cube.
struct EnviFiles {
    std::filesystem::path header;
    std::filesystem::path data;
    std::string header_text;  ///< as it was when the files were found; cut after 16 MB
};

/// The header of an ENVI file and its text.
struct EnviHeaderFile {
    std::filesystem::path path;
    std::string text;
};

/// The header beside `path`, which is called as the data with `.hdr` (or `.HDR`) behind it or in place of an ending
/// that data have: dat, img, raw, bin, bsq, bil, bip, cube, hyspex, hsi, flt, ref, rfl, rad, sli, slb or lib, in small
/// or capital letters. Nothing where there is none. `path` is not opened.
[[nodiscard]] std::optional<EnviHeaderFile> envi_header_beside(const std::filesystem::path& path);

/// Both files, of which this is the header. The data are called as the header without `.hdr` or with one of those
/// endings in its place. Throws InputError when no data or several are found.
[[nodiscard]] EnviFiles files_of(EnviHeaderFile header);

/// Both files, either of which `path` may name: the header is the one beside it, else `path` itself where it begins as
/// one does; nothing where there is none. Throws InputError as `files_of`.
[[nodiscard]] std::optional<EnviFiles> envi_files(const std::filesystem::path& path);

/// The same. Throws InputError, too, where there is none.
[[nodiscard]] EnviFiles find_envi_files(const std::filesystem::path& path);

/// What the header says; it may have 16 MB. Data that are more than it promises make a doubt. Throws InputError as
/// `parse_envi_header`, and when the data are fewer than it promises.
[[nodiscard]] EnviHeader read_envi_header(const EnviFiles& files);

/// The numbers of the data in the order of the file: each row is a line of all bands for bip, of one band for the
/// others. Throws InputError when a line has more than 2^23 numbers in all its bands (64 MB once read) or all bands
/// together have more than 2^31 - 1 lines.
[[nodiscard]] Raster open_envi_data(const EnviFiles& files, const EnviHeader& header);

}  // namespace skinfit
