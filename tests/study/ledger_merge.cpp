#include "study/ledger_merge.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include "study/cube_ledger.hpp"
#include "tests/study/example_ledger.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using test::example_answer_of;
using test::example_entry;
using test::example_roster;
using test::refusal_of;

class Merging : public test::TemporaryFolder {
protected:
    [[nodiscard]] Ledger opened(const std::string& name, const std::vector<RosterEntry>& roster,
                                const std::string& settings = "settings") const {
        Ledger ledger(in_folder(name), Ledger::Access::write);
        (void)ledger.take(roster, settings);
        return ledger;
    }
};

void store(Ledger& ledger, std::size_t number, const std::string& reason) {
    Ledger::Answer answer = example_answer_of(example_entry(number));
    answer.studied.reason = reason;
    ledger.store({&answer, 1});
}

TEST_F(Merging, TakesWhatIsMissingToTheLastBit) {
    Ledger whole = opened("whole", example_roster(3));
    store(whole, 1, "whole");
    {
        Ledger part = opened("part", example_roster(2));
        store(part, 1, "part");
        store(part, 2, "part");
    }
    EXPECT_EQ(take_answers(whole, in_folder("part")).spectra, 1U);
    const std::vector<LedgerRow> rows = whole.rows();
    EXPECT_EQ(rows[0].studied.reason, "whole") << "what is there stays";
    EXPECT_EQ(rows[2].studied.status, FitStatus::pending);
    StudiedSpectrum expected = test::example_answer();
    expected.reason = "part";
    EXPECT_EQ(to_json(rows[1].studied).dump(), to_json(expected).dump());
    const std::string shown = test::shown_by(in_folder("whole"));
    EXPECT_EQ(take_answers(whole, in_folder("part")).spectra, 0U) << "again it takes nothing";
    EXPECT_EQ(test::shown_by(in_folder("whole")), shown);
}

TEST_F(Merging, TakesOnlyTheSameInputAndSettings) {
    const Ledger whole = opened("whole", example_roster(2));
    {
        std::vector<RosterEntry> roster = example_roster(2);
        roster[0].input_hash = "other";
        Ledger part = opened("part", roster);
        store(part, 1, "other input");
        store(part, 2, "same");
    }
    {
        Ledger part = opened("other", example_roster(2), "other settings");
        store(part, 1, "other settings");
    }
    EXPECT_EQ(take_answers(whole, in_folder("other")).spectra, 0U);
    EXPECT_EQ(take_answers(whole, in_folder("part")).spectra, 1U);
    EXPECT_EQ(whole.rows()[0].studied.status, FitStatus::pending);
    EXPECT_EQ(whole.rows()[1].studied.reason, "same");
}

TEST_F(Merging, OfPartsInAnyOrderIsTheSame) {
    for (const std::size_t number : {1U, 2U, 3U}) {
        Ledger part = opened("part" + std::to_string(number), {example_entry(number)});
        store(part, number, "part " + std::to_string(number));
    }
    std::vector<std::string> shown;
    for (const std::string order : {"123", "312"}) {
        const Ledger whole = opened(order, example_roster(3));
        for (const char number : order) {
            EXPECT_EQ(take_answers(whole, in_folder(std::string("part") + number)).spectra, 1U);
        }
        shown.push_back(test::shown_by(in_folder(order)));
    }
    EXPECT_EQ(shown[0], shown[1]);
}

TEST_F(Merging, TakesTilesOfTheSameCube) {
    const CubeEntry cube{.source = "c.hdr",
                         .metadata = {},
                         .input_hash = "input",
                         .problem = {},
                         .samples = 3,
                         .tiles = {{0, 4}, {4, 4}}};
    const Ledger whole = opened("whole", {});
    take_cubes(whole, {cube}, "settings");
    {
        const Ledger part = opened("part", {});
        take_cubes(part, {cube}, "settings");
        store_tile(part, "c.hdr", {.tile = {4, 4}, .pixels = {0, 12}, .bytes = std::string("a\0b", 3), .seconds = 2});
        const Ledger other = opened("other", {});
        take_cubes(other, {cube}, "other settings");
        store_tile(other, "c.hdr", {.tile = {0, 4}, .pixels = {0, 12}, .bytes = "other"});
    }
    EXPECT_EQ(take_answers(whole, in_folder("other")).tiles, 0U);
    EXPECT_EQ(take_answers(whole, in_folder("part")).tiles, 1U);
    EXPECT_EQ(take_answers(whole, in_folder("part")).tiles, 0U);
    ASSERT_EQ(pending_tiles(whole, "c.hdr").size(), 1U);
    for_each_tile(whole, "c.hdr", [](const FittedTile& tile) {
        EXPECT_EQ(tile.bytes, std::string("a\0b", 3));
        EXPECT_EQ(tile.seconds, 2.0);
    });
}

TEST_F(Merging, ABadPartChangesNothingAndTheNextIsTaken) {
    const Ledger whole = opened("whole", example_roster(200));
    {
        Ledger part = opened("part", example_roster(200));
        for (std::size_t i = 1; i <= 200; ++i) store(part, i, "part");
    }
    const std::string bytes = read_file(in_folder("part"));
    write_file_atomically(in_folder("text"), "no database at all, but longer than a header of one");
    write_file_atomically(in_folder("damaged"), bytes.substr(0, bytes.size() / 2));
    const std::string before = test::shown_by(in_folder("whole"));
    for (const std::string name : {"none", "text", "damaged"}) {
        const std::string said = refusal_of([&] { (void)take_answers(whole, in_folder(name)); });
        EXPECT_EQ(said.find(in_folder(name).string() + ": "), 0U) << said;
        EXPECT_EQ(test::shown_by(in_folder("whole")), before);
    }
    EXPECT_EQ(take_answers(whole, in_folder("part")).spectra, 200U);
}

/// A merge that runs out of space takes nothing, and can be made again.
TEST_F(Merging, WithoutSpaceTakesNothing) {
    const Ledger whole = opened("whole", example_roster(200));
    {
        Ledger part = opened("part", example_roster(200));
        for (std::size_t i = 1; i <= 200; ++i) store(part, i, "part");
    }
    const int pages = whole.database().execAndGet("PRAGMA page_count").getInt();
    whole.database().exec("PRAGMA max_page_count = " + std::to_string(pages + 2));
    const std::string said = refusal_of([&] { (void)take_answers(whole, in_folder("part")); });
    EXPECT_EQ(said.find(in_folder("whole").string() + ": cannot grow"), 0U) << said;
    EXPECT_EQ(whole.pending("a.csv").size(), 200U);
    whole.database().exec("PRAGMA max_page_count = 1000000");
    EXPECT_EQ(take_answers(whole, in_folder("part")).spectra, 200U);
}

}  // namespace
}  // namespace skinfit
