#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>
#include <string_view>

#include "core/stop.hpp"

namespace skinfit {

/// How far a fit has come.
struct FitProgress {
    std::string_view stage;  ///< what is being done, in words
    std::size_t done;        ///< of it
    std::size_t total;       ///< at least 1
};

/// Whoever waits for a fit. `progress` is called from the thread that fits.
struct FitWatch {
    std::stop_token stop{};                                 ///< asks for an end before the end: Cancelled is thrown
    std::function<void(const FitProgress&)> progress = {};  ///< empty: nobody listens
    /// Where the stop comes after the search: give the result without what is not finished, rather than throw.
    bool keeps_partial_result = false;

    /// Tells whoever watches how far the fit is.
    void tell(const FitProgress& now) const {
        if (progress) progress(now);
    }
};

}  // namespace skinfit
