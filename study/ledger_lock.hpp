#pragma once

#include <filesystem>

namespace skinfit {

/// The right to write a ledger, held as long as it lives: a lock on a file beside the ledger, which the system releases
/// when the process ends, however it ends.
class LedgerLock {
public:
    /// Throws InputError where another process holds it, or the file cannot be made or is something else than a lock: a
    /// link, or another program's.
    explicit LedgerLock(const std::filesystem::path& ledger);
    LedgerLock(const LedgerLock&) = delete;
    LedgerLock& operator=(const LedgerLock&) = delete;
    /// Takes the lock over from `other`.
    LedgerLock(LedgerLock&& other) noexcept;
    LedgerLock& operator=(LedgerLock&&) = delete;
    ~LedgerLock();

private:
    int descriptor_ = -1;
};

}  // namespace skinfit
