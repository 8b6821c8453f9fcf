#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string_view>

namespace skinfit {

/// How far a fit has come.
struct FitProgress {
    std::string_view stage;  ///< what is being done, in words
    std::size_t done;        ///< of it
    std::size_t total;       ///< at least 1
};

/// Whoever waits for a fit. `progress` is called from the thread that fits.
struct FitWatch {
    std::stop_token stop{};                                 ///< asks for an end before the end
    std::function<void(const FitProgress&)> progress = {};  ///< empty: nobody listens

    void tell(const FitProgress& now) const {
        if (progress) progress(now);
    }
};

/// Leaves a fit whose `FitWatch::stop` has been requested; there is no result.
class FitCancelled : public std::runtime_error {
public:
    FitCancelled() : std::runtime_error("the fit was cancelled") {}
};

/// Throws FitCancelled where a stop is requested.
inline void leave_if_cancelled(const std::stop_token& stop) {
    if (stop.stop_requested()) throw FitCancelled();
}

}  // namespace skinfit
