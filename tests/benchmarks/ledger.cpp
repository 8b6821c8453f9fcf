#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "study/ledger.hpp"
#include "study/study_tasks.hpp"

namespace skinfit {
namespace {

constexpr std::size_t at_once = 16;  // as a run stores them

/// An answer as large as those of five parameters are.
StudiedSpectrum answer() {
    StudiedSpectrum studied{.status = FitStatus::suspect,
                            .verdict = "suspect",
                            .reason =
                                "AT BOUND: bilirubin_g_per_l ended at its lower bound 0, and the other values "
                                "depend on that; widen the bound if it is not physiological, or fix the parameter"};
    for (const char* const name : {"melanosome_fraction", "papillary_blood_fraction", "reticular_blood_fraction",
                                   "oxygen_saturation", "bilirubin_g_per_l"}) {
        studied.parameters.push_back({.name = name,
                                      .value = 1.0 / 3.0,
                                      .sigma = 1.0 / 30.0,
                                      .interval_95 = {0.27, 0.4},
                                      .bounds = {0.0, 1.0},
                                      .status = Status::free});
    }
    studied.correlation.assign(10, 1.0 / 7.0);
    for (const IndexInfo& info : index_table()) {
        studied.indices.push_back({.name = info.name, .value = 100.0 / 3.0, .sigma = 1.0 / 3.0});
    }
    studied.rmse = 1.0 / 300.0;
    studied.chi2 = 29.0;
    return studied;
}

std::vector<RosterEntry> roster_of(std::size_t spectra) {
    std::vector<RosterEntry> roster;
    for (std::size_t i = 0; i < spectra; ++i) {
        roster.push_back({.source = "spectra.csv",
                          .number = i + 1,
                          .name = std::to_string(i + 1),
                          .metadata = {{"subject", "12"}},
                          .input_hash = "0123456789abcdef0123456789abcdef",
                          .refusal = {}});
    }
    return roster;
}

/// A folder that is gone at the end.
class Scratch {
public:
    Scratch() {
        std::string name = (std::filesystem::temp_directory_path() / "skinfit_ledger_XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() { std::filesystem::remove_all(folder_); }
    [[nodiscard]] std::filesystem::path file() const { return folder_ / "ledger.sqlite"; }

private:
    std::filesystem::path folder_;
};

/// What the leader of a run does for each answer: takes it apart and stores it.
void ledger_store(benchmark::State& state) {
    const Scratch scratch;
    Ledger ledger(scratch.file(), Ledger::Access::write);
    const auto spectra = static_cast<std::size_t>(state.range(0));
    (void)ledger.take(roster_of(spectra), "settings");
    std::size_t next = 0;
    for (auto _ : state) {
        SpectraDone done;
        for (std::size_t i = 0; i < at_once; ++i) {
            const std::size_t number = next++ % spectra + 1;
            done.answers.push_back({.key = {.source = "spectra.csv", .number = number, .name = std::to_string(number)},
                                    .studied = answer()});
        }
        const std::string bytes = bytes_of(done);
        ledger.store(std::get<SpectraDone>(done_in(bytes)).answers);
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(at_once) * static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(ledger_store)->Arg(100'000)->Unit(benchmark::kMicrosecond);

/// What a run does first, when all is known and when nothing is.
void ledger_take(benchmark::State& state) {
    const Scratch scratch;
    Ledger ledger(scratch.file(), Ledger::Access::write);
    const std::vector<RosterEntry> roster = roster_of(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) (void)ledger.take(roster, "settings");
    state.SetItemsProcessed(state.range(0) * static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(ledger_take)->Arg(100'000)->Unit(benchmark::kMillisecond);

/// A tile of five parameters as its bytes travel and are stored.
void ledger_tile(benchmark::State& state) {
    const Scratch scratch;
    Ledger ledger(scratch.file(), Ledger::Access::write);
    constexpr std::size_t tiles = 128;
    CubeEntry cube{
        .source = "hand.hdr", .metadata = {}, .input_hash = "a", .problem = {}, .samples = 1024, .tiles = {}};
    for (std::size_t i = 0; i < tiles; ++i) cube.tiles.push_back({.first_line = 8 * i, .lines = 8});
    take_cubes(ledger, {cube}, "settings");
    constexpr std::size_t planes = 14;
    const std::string map(planes * sizeof(float) * 8192, 'x');
    std::size_t next = 0;
    for (auto _ : state) {
        const TileDone done{
            .cube = 0, .tile = {.tile = cube.tiles[next++ % tiles], .pixels = {}, .bytes = map}, .problem = {}};
        const StudyDone arrived = done_in(bytes_of(done));
        store_tile(ledger, cube.source, std::get<TileDone>(arrived).tile);
    }
    state.SetBytesProcessed(static_cast<std::int64_t>(map.size()) * static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(ledger_tile)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace skinfit
