#pragma once

#include <stdexcept>
#include <stop_token>

namespace skinfit {

/// Leaves work whose stop has been requested; there is no result.
class Cancelled : public std::runtime_error {
public:
    /// With a message that names no cause.
    Cancelled() : std::runtime_error("it was cancelled") {}
};

/// Throws Cancelled where a stop is requested; costs some nanoseconds.
inline void leave_if_cancelled(const std::stop_token& stop) {
    if (stop.stop_requested()) throw Cancelled();
}

}  // namespace skinfit
