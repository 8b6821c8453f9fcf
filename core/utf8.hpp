#pragma once

#include <string_view>

namespace skinfit {

/// Whether `text` is UTF-8, as all text in JSON is.
[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace skinfit
