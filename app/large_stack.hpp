#pragma once

#include <functional>

namespace skinfit {

/// Calls `work` in a thread whose stack does not depend on the limit that the program was started with (ulimit -s), and
/// gives all threads that start later such a stack. Throws std::system_error where there is no memory for it.
void on_a_large_stack(const std::function<void()>& work);

}  // namespace skinfit
