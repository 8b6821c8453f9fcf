#pragma once

#include <cstddef>
#include <string>

#include "measurements/file_statements.hpp"

namespace skinfit {

/// Takes what a line `key: value` states of a multiplier, a scale or an offset: multipliers and divisors are applied;
/// factors of a calibration, which may have been applied, are remarks. Throws InputError for a scale, gain or offset
/// that could mean two things. Gains and `offset` count in comments alone: elsewhere they are of the detector.
void take_scale(FileStatements& statements, const std::string& source, std::size_t line, const KeyedLine& keyed,
                bool is_comment);

/// The same of prose: `scale 0.5`, and `scaled by 2` as a remark.
void take_scale_in_prose(FileStatements& statements, const std::string& source, std::size_t line,
                         std::string_view prose, bool is_comment);

}  // namespace skinfit
