#pragma once

#include <span>
#include <string_view>

#include "core/embedded_file.hpp"

namespace skinfit {

/// The files of the page, bundled from `web/` when the program was built; none in a build without it.
[[nodiscard]] std::span<const EmbeddedFile> page_files();

/// The file that the server shows at `path`, index.html at "/"; none for any other path.
[[nodiscard]] const EmbeddedFile* find_page_file(std::string_view path);

}  // namespace skinfit
