#pragma once

#include <cstddef>
#include <string_view>

namespace skinfit {

/// A text file of the source tree, compiled into the program.
struct EmbeddedFile {
    std::string_view name;  ///< without folder
    std::string_view text;
};

}  // namespace skinfit
