#pragma once

#include <cstddef>
#include <filesystem>

#include "study/ledger.hpp"

namespace skinfit {

/// What a ledger took from another.
struct TakenAnswers {
    std::size_t spectra = 0;
    std::size_t tiles = 0;
};

/// Fills what waits in `ledger` with the answers that the ledger at `part` has for the same input and configuration.
/// Throws InputError as `Ledger`; then nothing has been taken.
TakenAnswers take_answers(const Ledger& ledger, const std::filesystem::path& part);

}  // namespace skinfit
