#pragma once

#include <string>
#include <string_view>

namespace skinfit {

/// Whether `text` is UTF-8, as all text in JSON is.
[[nodiscard]] bool is_utf8(std::string_view text);

/// `text` as it may stand on one line of a terminal or a report, whatever a file or a caller put into it: control
/// characters, line ends, marks that reorder or hide text, and bytes that are not UTF-8 become `\n`, `\x1b` or
/// `\u202e`. Text without such characters is left as it is, so that a second call changes nothing.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace skinfit
