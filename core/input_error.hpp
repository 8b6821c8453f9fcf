#pragma once

#include <stdexcept>
#include <string>

#include "core/utf8.hpp"

namespace skinfit {

/// What is wrong with something the user gave, in the four parts every message has.
struct Complaint {
    std::string where;    ///< file, line, key or option
    std::string problem;  ///< what is wrong there
    std::string why;      ///< why that cannot be used
    std::string remedy;   ///< what to do about it
};

/// The user's input cannot be used. Caught in `main`, and where one bad input must not stop the others: in studies, in
/// the explorer, in the cache. `what()` reads `<where>: <problem> (<why>); <what to do>`, on one line, `printable`.
class InputError : public std::runtime_error {
public:
    /// The message of `complaint`, whose four parts must not be empty.
    explicit InputError(const Complaint& complaint)
        : std::runtime_error(printable(complaint.where + ": " + complaint.problem + " (" + complaint.why + "); " +
                                       complaint.remedy)) {}
};

}  // namespace skinfit
