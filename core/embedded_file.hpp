#pragma once

#include <span>
#include <string_view>

namespace skinfit {

/// A text file of the source tree, compiled into the program. The files that `skinfit_embed(TARGET NAMESPACE ...)`
/// names in a CMakeLists.txt are `std::span<const EmbeddedFile> skinfit::NAMESPACE::embedded_files()`, to be declared
/// where they are used.
struct EmbeddedFile {
    std::string_view name;  ///< without folder
    std::string_view text;
};

}  // namespace skinfit
