#pragma once

#include <string>
#include <string_view>

/// What a terminal shows and a file does not.
namespace skinfit {

/// Takes away what stands on the current line of a terminal.
inline constexpr std::string_view clear_line = "\r\x1b[K";

/// Whether what is written to this descriptor is seen by a person at once, and may be drawn over: not with TERM=dumb.
[[nodiscard]] bool is_terminal(int descriptor);

/// Whether it may be coloured: not with NO_COLOR set to anything but the empty text.
[[nodiscard]] bool shows_colour(int descriptor);

/// `report` for a terminal with colours: the verdict in green or red, the names of problems bold.
[[nodiscard]] std::string coloured(std::string_view report);

/// Writes `text` to stderr. A terminal that is gone, or a full disk, is no reason to stop: it is left out then.
void write_stderr(std::string_view text) noexcept;

/// Writes one line to stderr, `printable`, over a progress bar that may stand there.
void say_line(std::string_view text);

/// The same for "error: ..." and "warning: ...": the word before the colon is coloured where that is shown.
void say_trouble(std::string_view kind, std::string_view text);

}  // namespace skinfit
