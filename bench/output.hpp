#pragma once

#include <string>

#include "bench/ladder.hpp"
#include "core/json.hpp"

namespace skinfit {

/// The measurements as JSON; ratios are of processor times, which other work on the machine disturbs least, and beside
/// them of wall-clock times.
[[nodiscard]] Json bench_json(const BenchResult& result);

/// The same for readers.
[[nodiscard]] std::string bench_text(const BenchResult& result);

}  // namespace skinfit
