#pragma once

#include <string>

namespace skinfit {

/// Two clocks: the machine may have other work to do.
struct Duration {
    double wall_s = 0.0;
    double cpu_s = 0.0;  ///< of all threads of this program
};

/// Starts when it is made.
class Stopwatch {
public:
    /// Starts.
    Stopwatch();
    /// Since the start.
    [[nodiscard]] Duration elapsed() const;

private:
    Duration begin_;
};

/// The processor's name, as the system states it.
[[nodiscard]] std::string machine_name();

/// The most memory that this program has used so far.
[[nodiscard]] double peak_memory_mb();

}  // namespace skinfit
