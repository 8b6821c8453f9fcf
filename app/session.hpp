#pragma once

#include <string>

#include "app/interrupt.hpp"

namespace skinfit {

/// What a run of the program ended with; one that a signal ended has 128 plus the signal's number.
enum ExitCode : int { good_result = 0, result_with_warning = 1, bad_input = 2, internal_error = 3 };

/// One run of the program: what every command shares.
struct Session {
    std::string command_line;  ///< as typed into a shell
    Interrupt& interrupt;
    bool quiet = false;  ///< --quiet: nothing on stderr but errors
    int exit_code = good_result;
    bool lacks_a_file = false;      ///< one that was asked for could not be made: the program ends with 1 at least
    bool leaves_out_files = false;  ///< Ctrl-C ended the making of one: the next are not begun

    /// As `Interrupt::graceful`, without a word with --quiet.
    [[nodiscard]] std::stop_token stop_on_interrupt(const std::string& text) {
        return interrupt.graceful(quiet ? "" : text);
    }
};

}  // namespace skinfit
