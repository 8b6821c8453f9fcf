#include "study/study_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/input_error.hpp"
#include "core/version.hpp"
#include "fit/configuration_json.hpp"
#include "fit/gnuplot.hpp"
#include "fit/problem.hpp"
#include "study/cube_plan.hpp"
#include "study/ledger_lock.hpp"
#include "study/ledger_merge.hpp"
#include "study/study_tasks.hpp"

namespace skinfit {
namespace {

/// Spectra of one task: some tenths of a second of fitting, so that little is lost when the program is killed.
constexpr std::size_t spectra_at_once = 16;

/// What a study consists of, as its files are now.
struct Plan {
    std::vector<RosterEntry> roster;
    std::vector<CubeEntry> cubes;
    std::size_t left_out = 0;
};

/// Spectra that follow each other go to one part, those of different parts alternate.
bool belongs(std::size_t position, const StudyPart& part) {
    return position / spectra_at_once % part.parts == part.number - 1;
}

Plan plan_of(StudyReader& reader) {
    const Study& study = reader.study();
    Plan plan;
    std::map<std::string, std::string> seen;
    const bool duplicates_count = std::ranges::find(study.accept, "duplicate") == study.accept.end();
    for (std::size_t file = 0; file < study.files.size(); ++file) {
        StudySpectra read = *reader.spectra_of(file);
        if (duplicates_count) refuse_duplicates(read, seen, reader.window());
        plan.left_out += read.left_out;
        std::ranges::move(read.entries, std::back_inserter(plan.roster));
    }
    for (std::size_t cube = 0; cube < study.cubes.size(); ++cube) plan.cubes.push_back(planned(reader, cube));
    return plan;
}

void take_part(Plan& plan, const StudyPart& part) {
    std::vector<RosterEntry> mine;
    for (std::size_t i = 0; i < plan.roster.size(); ++i) {
        if (belongs(i, part)) mine.push_back(std::move(plan.roster[i]));
    }
    plan.roster = std::move(mine);
    for (CubeEntry& cube : plan.cubes) {
        std::vector<CubeTile> tiles;
        for (std::size_t i = part.number - 1; i < cube.tiles.size(); i += part.parts) tiles.push_back(cube.tiles[i]);
        cube.tiles = std::move(tiles);
    }
}

std::vector<StudyTask> tasks_of(const Study& study, const Ledger& ledger, const Plan& plan) {
    std::map<std::pair<std::string, std::size_t>, const RosterEntry*> planned_entries;
    for (const RosterEntry& entry : plan.roster) planned_entries[{entry.source, entry.number}] = &entry;
    std::vector<StudyTask> tasks;
    for (std::size_t file = 0; file < study.files.size(); ++file) {
        const std::vector<LedgerKey> keys = ledger.pending(study.files[file].source);
        for (std::size_t first = 0; first < keys.size(); first += spectra_at_once) {
            SpectraTask task{.file = file, .spectra = {}};
            for (std::size_t i = first; i < std::min(first + spectra_at_once, keys.size()); ++i) {
                const RosterEntry& entry = *planned_entries.at({keys[i].source, keys[i].number});
                task.spectra.push_back({.number = entry.number, .name = entry.name, .input_hash = entry.input_hash});
            }
            tasks.emplace_back(std::move(task));
        }
    }
    for (std::size_t cube = 0; cube < study.cubes.size(); ++cube) {
        if (plan.cubes[cube].problem) continue;
        for (const CubeTile& tile : pending_tiles(ledger, study.cubes[cube].source)) {
            tasks.emplace_back(TileTask{.cube = cube, .tile = tile});
        }
    }
    return tasks;
}

/// How many tiles of each cube are to be done.
std::vector<std::size_t> tiles_of_cubes(const std::vector<StudyTask>& tasks, std::size_t cubes) {
    std::vector<std::size_t> tiles(cubes, 0);
    for (const StudyTask& task : tasks) {
        if (const auto* const tile = std::get_if<TileTask>(&task)) ++tiles[tile->cube];
    }
    return tiles;
}

/// Counts down, and says whether this was the last tile of its cube.
bool ends_a_cube(const StudyDone& done, std::vector<std::size_t>& waiting) {
    const auto* const tile = std::get_if<TileDone>(&done);
    return tile != nullptr && --waiting[tile->cube] == 0;
}

std::uint64_t pixels_of(const CubeEntry& cube, const CubeTile& tile) {
    return cube.samples * tile.lines;
}

StudyProgress to_do(const std::vector<StudyTask>& tasks, const std::vector<CubeEntry>& cubes) {
    StudyProgress progress;
    for (const StudyTask& task : tasks) {
        if (const auto* const spectra = std::get_if<SpectraTask>(&task)) {
            progress.spectra_to_do += spectra->spectra.size();
        } else {
            const auto& tile = std::get<TileTask>(task);
            progress.pixels_to_do += pixels_of(cubes[tile.cube], tile.tile);
        }
    }
    return progress;
}

void store(Ledger& ledger, const Study& study, const Plan& plan, const StudyDone& done, StudyProgress& progress) {
    if (const auto* const spectra = std::get_if<SpectraDone>(&done)) {
        ledger.store(spectra->answers);
        progress.spectra += spectra->answers.size();
        return;
    }
    const auto& tile = std::get<TileDone>(done);
    const std::string& source = study.cubes[tile.cube].source;
    if (!tile.problem.empty()) {
        refuse_cube(ledger, source, tile.problem);
    } else {
        store_tile(ledger, source, tile.tile);
    }
    progress.pixels += pixels_of(plan.cubes[tile.cube], tile.tile.tile);
}

/// Settings with which no spectrum could be fitted are an error of the study, not of each of its spectra.
void check_settings(const Study& study) {
    const Configuration configuration = with_instrument(study.configuration);
    Spectrum ramp;
    ramp.source = study.file.string();
    constexpr double step_nm = 5;
    for (double nm = configuration.wavelength_min_nm; nm <= configuration.wavelength_max_nm; nm += step_nm) {
        ramp.wavelength_nm.push_back(nm);
        ramp.value.push_back(nm / configuration.wavelength_max_nm / 2.0);
    }
    (void)make_problem(configuration, ramp);
}

/// Writes the maps of all cubes whose tiles are all done. Those whose pictures cannot be drawn are `undrawn` from then
/// on; the next run tries again.
void write_maps(StudyReader& reader, const Ledger& ledger, const StudyRunOptions& options,
                std::set<std::string>& undrawn) {
    const std::vector<StudyCube>& cubes = reader.study().cubes;
    for (const CubeRow& row : cube_rows(ledger)) {
        if (row.tiles == 0 || row.tiles_done < row.tiles || !row.map.empty() || !row.reason.empty()) continue;
        if (undrawn.contains(row.source)) continue;
        if (!undrawn.empty() && options.stop()) return;  // which ended a picture too
        const auto cube = std::ranges::find(cubes, row.source, &StudyCube::source);
        options.tell(fmt::format("writing the map of {}", row.source));
        const std::optional<std::string> problem =
            write_map(ledger, reader, static_cast<std::size_t>(cube - cubes.begin()), options.cache);
        if (!problem) continue;
        undrawn.insert(row.source);
        options.tell(fmt::format(
            "warning: the map of {} is written, its pictures are not ({}); run the study again to draw them",
            row.source, *problem));
    }
}

/// What a run needs beside its inputs: whole maps are drawn.
void check_tools(const Study& study, const StudyRunOptions& options) {
    if (!study.cubes.empty() && !options.part) require_gnuplot();
}

void make_folder_of(const std::filesystem::path& ledger) {
    const std::filesystem::path folder = ledger.parent_path();
    if (!folder.empty()) make_folder(folder, folder.string());
}

/// For those who read the ledger.
void note_settings(Ledger& ledger, const Study& study) {
    ledger.set_note("study", study.name);
    ledger.set_note("version", std::string(version));
    ledger.set_note("configuration", to_json(with_instrument(study.configuration)).dump());
}

void tell_change(const RosterChange& change, const StudyRunOptions& options) {
    if (change.changed_input > 0) {
        options.tell(fmt::format("{} spectra have changed and are fitted again", change.changed_input));
    }
    if (change.changed_settings > 0) {
        options.tell(fmt::format("the settings have changed: {} spectra are fitted again", change.changed_settings));
    }
    if (change.gone > 0) {
        options.tell(
            fmt::format("{} spectra are no longer among the inputs; their results are kept, not shown", change.gone));
    }
}

}  // namespace

std::filesystem::path ledger_path(const Study& study) {
    return study.output / "ledger.sqlite";
}

std::string configuration_hash_of(const Study& study) {
    // What an instrument says counts, not the file that says it.
    Configuration configuration = with_instrument(study.configuration);
    configuration.instrument.reset();
    const Json everything = {
        {"version", version}, {"configuration", to_json(configuration)}, {"fit", study.fit}, {"accept", study.accept}};
    return content_hash(everything.dump());
}

StudyRun run_study(const Study& study, const StudyRunOptions& options) {
    check_settings(study);
    check_tools(study, options);
    make_folder_of(options.ledger);
    const LedgerLock lock(options.ledger);
    Ledger ledger(options.ledger, Ledger::Access::write);
    const std::string hash = configuration_hash_of(study);
    const auto reader = std::make_shared<StudyReader>(study);
    Plan plan = plan_of(*reader);
    if (options.part) take_part(plan, *options.part);
    StudyRun run{.change = ledger.take(plan.roster, hash), .left_out = plan.left_out, .progress = {}};
    take_cubes(ledger, plan.cubes, hash);
    note_settings(ledger, study);
    tell_change(run.change, options);
    const std::vector<StudyTask> tasks = tasks_of(study, ledger, plan);
    run.progress = to_do(tasks, plan.cubes);
    options.progress(run.progress);
    std::vector<std::size_t> waiting = tiles_of_cubes(tasks, study.cubes.size());
    std::set<std::string> undrawn;
    const auto finish_maps = [&] {
        if (!options.part) write_maps(*reader, ledger, options, undrawn);
    };
    {
        WorkerThreads threads(options.jobs, study_worker(reader, options.cache));
        const std::size_t done = lead(threads,
                                      {.tasks = tasks.size(),
                                       .text = [&](std::size_t number) { return bytes_of(tasks[number]); },
                                       .take =
                                           [&](const DoneTask& task) {
                                               const StudyDone answer = done_in(task.result);
                                               store(ledger, study, plan, answer, run.progress);
                                               // At once, so that the ledger holds the tiles of few cubes.
                                               if (ends_a_cube(answer, waiting)) finish_maps();
                                               options.progress(run.progress);
                                           },
                                       .stop = options.stop},
                                      options.remote);
        run.stopped = done < tasks.size();
    }
    finish_maps();
    run.undrawn_maps = undrawn.size();
    return run;
}

StudyRun merge_study(const Study& study, const std::vector<std::filesystem::path>& parts,
                     const StudyRunOptions& options) {
    check_tools(study, options);
    make_folder_of(options.ledger);
    const LedgerLock lock(options.ledger);
    Ledger ledger(options.ledger, Ledger::Access::write);
    const std::string hash = configuration_hash_of(study);
    StudyReader reader(study);
    const Plan plan = plan_of(reader);
    StudyRun run{.change = ledger.take(plan.roster, hash), .left_out = plan.left_out, .progress = {}};
    take_cubes(ledger, plan.cubes, hash);
    note_settings(ledger, study);
    for (const std::filesystem::path& path : parts) {
        const TakenAnswers taken = take_answers(ledger, path);
        options.tell(fmt::format("{}: {} spectra and {} tiles", path.string(), taken.spectra, taken.tiles));
        run.progress.spectra += taken.spectra;
    }
    std::set<std::string> undrawn;
    write_maps(reader, ledger, options, undrawn);
    run.undrawn_maps = undrawn.size();
    return run;
}

}  // namespace skinfit
