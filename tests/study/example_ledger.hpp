#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/file.hpp"
#include "study/ledger.hpp"
#include "tests/study/example_rows.hpp"

namespace skinfit::test {

[[nodiscard]] inline RosterEntry example_entry(std::size_t number, const std::string& input_hash = "input",
                                               const std::string& source = "a.csv") {
    return {.source = source,
            .number = number,
            .name = "spectrum " + std::to_string(number),
            .metadata = {{"subject", "s" + std::to_string(number)}},
            .input_hash = input_hash,
            .refusal = {}};
}

/// So many spectra of one file.
[[nodiscard]] inline std::vector<RosterEntry> example_roster(std::size_t count) {
    std::vector<RosterEntry> roster;
    for (std::size_t i = 1; i <= count; ++i) roster.push_back(example_entry(i));
    return roster;
}

[[nodiscard]] inline Ledger::Answer example_answer_of(const RosterEntry& entry) {
    return {.key = {.source = entry.source, .number = entry.number, .name = entry.name}, .studied = example_answer()};
}

[[nodiscard]] inline std::vector<Ledger::Answer> example_answers(const std::vector<RosterEntry>& roster) {
    std::vector<Ledger::Answer> answers;
    for (const RosterEntry& entry : roster) answers.push_back(example_answer_of(entry));
    return answers;
}

/// All that the ledger at `path` shows of spectra, as text.
[[nodiscard]] inline std::string shown_by(const std::filesystem::path& path) {
    std::string text;
    const Ledger ledger(path, Ledger::Access::read);
    for (const LedgerRow& row : ledger.rows()) {
        text += row.key.source + std::to_string(row.key.number) + row.key.name + metadata_json(row.metadata).dump() +
                row.input_hash + row.configuration_hash + to_json(row.studied).dump() + "\n";
    }
    return text;
}

}  // namespace skinfit::test
