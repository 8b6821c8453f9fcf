#pragma once

#include <string>

#include "core/input_error.hpp"

namespace skinfit::test {

/// The message of the InputError that `work` throws; empty where it throws none.
template <class Work>
[[nodiscard]] std::string refusal_of(const Work& work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

}  // namespace skinfit::test
