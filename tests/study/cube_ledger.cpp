#include "study/cube_ledger.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/study/example_ledger.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

CubeEntry hand(const std::string& input_hash = "input") {
    return {.source = "hand.hdr",
            .metadata = {{"subject", "s"}},
            .input_hash = input_hash,
            .problem = {},
            .samples = 5,
            .tiles = {{0, 8}, {8, 8}, {16, 3}}};
}

FittedTile fitted(std::size_t first_line, std::size_t lines) {
    return {.tile = {first_line, lines},
            .pixels = {0, 5 * lines - 1, 0, 1, 0, 0},
            .bytes = std::string("a\0\xff", 3) + std::to_string(first_line),
            .seconds = 0.25};
}

class CubeLedger : public test::TemporaryFolder {
protected:
    [[nodiscard]] Ledger opened() const { return {in_folder("ledger.sqlite"), Ledger::Access::write}; }
    void finish(const Ledger& ledger) const {
        for (const CubeTile& tile : pending_tiles(ledger, "hand.hdr")) {
            store_tile(ledger, "hand.hdr", fitted(tile.first_line, tile.lines));
        }
        write_file_atomically(map(), "map");
        finish_cube(ledger, "hand.hdr", map().string());
    }
    [[nodiscard]] std::filesystem::path map() const { return in_folder("hand_map.hdr"); }
};

TEST_F(CubeLedger, KeepsTilesAndCountsTheirPixels) {
    const Ledger ledger = opened();
    take_cubes(ledger, {hand()}, "settings");
    EXPECT_EQ(pending_tiles(ledger, "hand.hdr").size(), 3U);
    store_tile(ledger, "hand.hdr", fitted(16, 3));
    store_tile(ledger, "hand.hdr", fitted(0, 8));
    ASSERT_EQ(pending_tiles(ledger, "hand.hdr").size(), 1U);
    EXPECT_EQ(pending_tiles(ledger, "hand.hdr")[0].first_line, 8U);
    const CubeRow row = cube_rows(ledger).at(0);
    EXPECT_EQ(row.tiles, 3U);
    EXPECT_EQ(row.tiles_done, 2U);
    EXPECT_EQ(row.pixels, (StatusCounts{0, 53, 0, 2, 0, 0}));
    EXPECT_EQ(row.metadata, hand().metadata);
    std::vector<std::string> bytes;
    for_each_tile(ledger, "hand.hdr", [&](const FittedTile& tile) {
        bytes.push_back(tile.bytes);
        EXPECT_EQ(tile.pixels, fitted(tile.tile.first_line, tile.tile.lines).pixels);
        EXPECT_EQ(tile.seconds, 0.25);
    });
    EXPECT_EQ(bytes, (std::vector<std::string>{fitted(0, 8).bytes, fitted(16, 3).bytes}));
}

TEST_F(CubeLedger, HoldsNoTileThatTheCubeLacks) {
    const Ledger ledger = opened();
    take_cubes(ledger, {hand()}, "settings");
    EXPECT_THROW(store_tile(ledger, "hand.hdr", fitted(4, 8)), std::logic_error);
    EXPECT_THROW(store_tile(ledger, "foot.hdr", fitted(0, 8)), std::logic_error);
}

TEST_F(CubeLedger, TilesStandForTheSameInputAndSettings) {
    const Ledger ledger = opened();
    take_cubes(ledger, {hand()}, "settings");
    store_tile(ledger, "hand.hdr", fitted(0, 8));
    take_cubes(ledger, {hand()}, "settings");
    EXPECT_EQ(pending_tiles(ledger, "hand.hdr").size(), 2U);
    take_cubes(ledger, {hand("other")}, "settings");
    EXPECT_EQ(pending_tiles(ledger, "hand.hdr").size(), 3U);
    store_tile(ledger, "hand.hdr", fitted(0, 8));
    take_cubes(ledger, {hand("other")}, "other settings");
    EXPECT_EQ(pending_tiles(ledger, "hand.hdr").size(), 3U);
    EXPECT_EQ(cube_rows(ledger).at(0).configuration_hash, "other settings");
}

TEST_F(CubeLedger, WhatIsGoneComesBack) {
    const Ledger ledger = opened();
    CubeEntry foot = hand();
    foot.source = "foot.hdr";
    take_cubes(ledger, {hand(), foot}, "settings");
    store_tile(ledger, "hand.hdr", fitted(0, 8));
    take_cubes(ledger, {foot}, "settings");
    ASSERT_EQ(cube_rows(ledger).size(), 1U);
    take_cubes(ledger, {foot, hand()}, "settings");
    ASSERT_EQ(cube_rows(ledger).size(), 2U);
    EXPECT_EQ(cube_rows(ledger)[1].source, "hand.hdr");
    EXPECT_EQ(cube_rows(ledger)[1].tiles_done, 1U);
}

TEST_F(CubeLedger, AMapTakesThePlaceOfItsTilesAsLongAsItIsThere) {
    const Ledger ledger = opened();
    take_cubes(ledger, {hand()}, "settings");
    finish(ledger);
    EXPECT_EQ(cube_rows(ledger).at(0).map, map().string());
    for_each_tile(ledger, "hand.hdr", [](const FittedTile&) { FAIL() << "the map has its bytes"; });
    take_cubes(ledger, {hand()}, "settings");
    EXPECT_TRUE(pending_tiles(ledger, "hand.hdr").empty());
    EXPECT_EQ(cube_rows(ledger).at(0).pixels, (StatusCounts{0, 92, 0, 3, 0, 0}));
    std::filesystem::remove(map());
    take_cubes(ledger, {hand()}, "settings");
    EXPECT_EQ(pending_tiles(ledger, "hand.hdr").size(), 3U);
    EXPECT_EQ(cube_rows(ledger).at(0).map, "");
}

TEST_F(CubeLedger, ARefusalHoldsUntilTheNextRun) {
    const Ledger ledger = opened();
    CubeEntry unreadable = hand();
    unreadable.problem = "cannot be read";
    unreadable.tiles.clear();
    take_cubes(ledger, {unreadable}, "settings");
    EXPECT_EQ(cube_rows(ledger).at(0).reason, "cannot be read");
    take_cubes(ledger, {hand("now it can")}, "settings");
    EXPECT_EQ(cube_rows(ledger).at(0).reason, "");
    refuse_cube(ledger, "hand.hdr", "a band is missing");
    EXPECT_EQ(cube_rows(ledger).at(0).reason, "a band is missing");
    take_cubes(ledger, {hand("now it can")}, "settings");
    EXPECT_EQ(cube_rows(ledger).at(0).reason, "");
}

TEST_F(CubeLedger, WhatCannotBeReadForAWhileIsNotLost) {
    const Ledger ledger = opened();
    take_cubes(ledger, {hand()}, "settings");
    const CubeTile first = pending_tiles(ledger, "hand.hdr").front();
    store_tile(ledger, "hand.hdr", fitted(first.first_line, first.lines));
    CubeEntry unreadable = hand("why it cannot be read");
    unreadable.problem = "no disk";
    unreadable.tiles.clear();
    take_cubes(ledger, {unreadable}, "settings");
    EXPECT_EQ(cube_rows(ledger).at(0).reason, "no disk");
    EXPECT_EQ(cube_rows(ledger).at(0).tiles_done, 1U);
    take_cubes(ledger, {hand()}, "settings");
    EXPECT_EQ(cube_rows(ledger).at(0).reason, "");
    EXPECT_EQ(cube_rows(ledger).at(0).tiles_done, 1U);
    EXPECT_EQ(pending_tiles(ledger, "hand.hdr").size(), 2U);
}

TEST_F(CubeLedger, APartThatBecomesTheWholeHasAllTiles) {
    const Ledger ledger = opened();
    CubeEntry part = hand();
    part.tiles = {part.tiles[1]};
    take_cubes(ledger, {part}, "settings");
    store_tile(ledger, "hand.hdr", fitted(part.tiles[0].first_line, part.tiles[0].lines));
    take_cubes(ledger, {hand()}, "settings");
    EXPECT_EQ(cube_rows(ledger).at(0).tiles, 3U);
    EXPECT_EQ(pending_tiles(ledger, "hand.hdr").size(), 2U);
}

}  // namespace
}  // namespace skinfit
