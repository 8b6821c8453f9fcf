#pragma once

#include <filesystem>
#include <optional>

#include "measurements/envi_header.hpp"
#include "measurements/raster.hpp"

namespace skinfit {

/// The two files that together hold an ENVI cube.
struct EnviFiles {
    std::filesystem::path header;
    std::filesystem::path data;
};

/// The header that belongs to `path`: `path` itself where it begins as a header does, else the header beside it, which
/// is called as the data with `.hdr` (or `.HDR`) behind it or in place of an ending that data have: dat, img, raw, bin,
/// bsq, bil, bip, cube, hyspex, hsi, flt, ref, rfl, rad, sli, slb or lib, in small or capital letters. Nothing where
/// there is none.
[[nodiscard]] std::optional<std::filesystem::path> find_envi_header(const std::filesystem::path& path);

/// Both files, either of which `path` may name. The data are called as the header without `.hdr` or with one of those
/// endings in its place.
///
/// Throws InputError when `path` is no ENVI file and when no data or several are found.
[[nodiscard]] EnviFiles find_envi_files(const std::filesystem::path& path);

/// Reads the header; it may have 16 MB. Data that are more than it promises make a doubt. Throws InputError as
/// `parse_envi_header`, and when the data are fewer than it promises.
[[nodiscard]] EnviHeader read_envi_header(const EnviFiles& files);

/// The numbers of the data in the order of the file: each row is a line of all bands for bip, of one band for the
/// others. Throws InputError when a line has more than 2^23 numbers in all its bands (64 MB once read) or all bands
/// together have more than 2^31 - 1 lines.
[[nodiscard]] Raster open_envi_data(const EnviFiles& files, const EnviHeader& header);

}  // namespace skinfit
