#pragma once

#include <string>

namespace skinfit {

/// The memory that the program may still take, bytes: what the system has left, within the limit of the process
/// (`ulimit -v`). Infinite where the system does not tell.
[[nodiscard]] double available_memory_bytes();

/// Throws InputError where `bytes` are more than is available, before the work that needs them. `where` names what
/// asks for them, `remedy` how to ask for less.
void refuse_beyond_memory(double bytes, const std::string& where, const std::string& remedy);

}  // namespace skinfit
