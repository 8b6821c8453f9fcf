#pragma once

#include <string>
#include <vector>

#include "core/input_error.hpp"
#include "measurements/spectrum.hpp"

namespace skinfit {

/// The spectra of a file that cannot be used beside those that can, so that one never hides the others.
class LeftOut {
public:
    /// Runs `take`, which takes one spectrum; where it throws InputError, the error is kept instead.
    template <class Take>
    void or_keep_error(const Take& take) {
        try {
            take();
        } catch (const InputError& error) {
            errors_.push_back(error);
        }
    }

    /// Adds a remark on what was left out to each of `spectra`. Throws the first error where there are none.
    void tell(std::vector<Spectrum>& spectra) const;

private:
    std::vector<InputError> errors_;
};

}  // namespace skinfit
