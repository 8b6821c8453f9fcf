#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "study/study.hpp"

namespace skinfit {

/// One line of a manifest.
struct ManifestRow {
    std::string file;  ///< as written
    SelectedSpectrum selected;
};

/// The rows of a manifest: a table, separated by commas, semicolons or tabs, whose header names a column `file`,
/// perhaps a column `spectrum` (its name in the file, else its number), and metadata. Empty lines and lines that start
/// with `#` are skipped, as are a line `sep=;` before the header and a column without a name that numbers the rows in
/// front. `source` names it in messages. Throws InputError for a table without `file` or without rows, for text that is
/// not UTF-8, for names that are empty, occur twice or are those of settings, which would have no effect, and for a row
/// with another number of cells or without a file.
[[nodiscard]] std::vector<ManifestRow> parse_manifest(std::string_view text, const std::string& source);

}  // namespace skinfit
