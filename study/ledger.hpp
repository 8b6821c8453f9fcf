#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/roster.hpp"
#include "study/studied_spectrum.hpp"

namespace SQLite {
class Database;
}

namespace skinfit {

/// How many spectra, or pixels, have each status.
using StatusCounts = std::array<std::uint64_t, fit_status_names.size()>;

/// Where a spectrum stands in the ledger.
struct LedgerKey {
    std::string source;
    std::size_t number;
    std::string name;
};

/// One spectrum of a study and what became of it.
struct LedgerRow {
    LedgerKey key;
    Metadata metadata;
    std::string input_hash;
    std::string configuration_hash;
    StudiedSpectrum studied;
};

/// What a new roster changed.
struct RosterChange {
    std::size_t kept = 0;              ///< finished earlier, with the same input and configuration
    std::size_t added = 0;             ///< not known before, or not finished
    std::size_t changed_input = 0;     ///< to be fitted again
    std::size_t changed_settings = 0;  ///< to be fitted again
    std::size_t gone = 0;              ///< known before, and no part of the study any more; kept apart
};

/// The results of a study in an SQLite database, one row per spectrum. Everything is written in transactions: whatever
/// stops the program, the ledger holds all that was stored before. A writer is alone; readers may look on.
///
/// Every function throws InputError naming the file where the disk is full, the file is damaged or cannot be read or
/// written; then nothing of the call has been stored.
class Ledger {
public:
    enum class Access { read, write };

    /// Opens the ledger at `path`, for writing also makes it. For one that writes, `LedgerLock` must be held. Throws
    /// InputError for a file that is no ledger, is damaged, or was made by a later version of the program.
    Ledger(const std::filesystem::path& path, Access access);
    Ledger(const Ledger&) = delete;
    Ledger& operator=(const Ledger&) = delete;
    /// A ledger moves with its open file.
    Ledger(Ledger&&) noexcept;
    Ledger& operator=(Ledger&&) noexcept;
    ~Ledger();

    /// Makes the ledger hold the spectra of `roster`, in its order, those to be fitted as pending. What was finished
    /// with the same input hash and `configuration_hash` stays; what is no part of the roster is kept but not shown.
    RosterChange take(const std::vector<RosterEntry>& roster, const std::string& configuration_hash);

    /// One answer for the spectrum that the ledger holds under a key.
    struct Answer {
        LedgerKey key;
        StudiedSpectrum studied;
    };
    /// Stores answers, all or none.
    void store(std::span<const Answer> answers);

    /// The spectra of one file that wait, by their numbers.
    [[nodiscard]] std::vector<LedgerKey> pending(const std::string& source) const;

    /// Spectra by their status.
    [[nodiscard]] StatusCounts counts() const;

    /// Calls `use` with each spectrum of the study, in its order.
    void for_each(const std::function<void(const LedgerRow&)>& use) const;
    [[nodiscard]] std::vector<LedgerRow> rows() const;

    /// A text kept beside the results, such as the configuration; empty where there is none.
    [[nodiscard]] std::string note(const std::string& name) const;
    void set_note(const std::string& name, const std::string& text);

    /// The database, for the parts of the ledger that are kept elsewhere in the program.
    [[nodiscard]] SQLite::Database& database() const { return *database_; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::unique_ptr<SQLite::Database> database_;
};

}  // namespace skinfit
