#pragma once

#include "app/completion.hpp"

namespace skinfit {

/// What a shell offers for the value of an option or argument.
struct OfferedValues {
    enum class Kind { nothing, files, folders, words, assignments };
    Kind kind;
    std::vector<std::string> words;
};

/// What may be typed as the value of `option`.
[[nodiscard]] OfferedValues offered_values(const OptionWords& option, const CompletedNames& names);

/// The long name of an option, else its short one.
[[nodiscard]] const std::string& main_name(const OptionWords& option);

}  // namespace skinfit
