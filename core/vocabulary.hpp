#pragma once

#include <span>
#include <string_view>

namespace skinfit {

/// A word of the program's files and outputs: a JSON key, a CSV column or a row of a report.
struct Word {
    std::string_view name;
    std::string_view unit;  ///< empty for a pure number and for what is no number
    std::string_view meaning;
};

/// All words but the names of parameters and settings, which have tables of their own, in ascending order: the rows of
/// core/data/vocabulary.csv.
[[nodiscard]] std::span<const Word> vocabulary();

/// What reports and messages print in capitals or as a label and is none of those: the rows of core/data/labels.csv, in
/// lower case, in ascending order.
[[nodiscard]] std::span<const Word> labels();

}  // namespace skinfit
