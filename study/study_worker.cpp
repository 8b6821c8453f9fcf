#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "core/input_error.hpp"
#include "measurements/envi_reader.hpp"
#include "study/map_tile.hpp"
#include "study/spectrum_fitter.hpp"
#include "study/study_run.hpp"
#include "study/study_tasks.hpp"

namespace skinfit {
namespace {

/// What the tasks of a study share in one process.
class Workshop {
public:
    Workshop(std::shared_ptr<StudyReader> reader, const DiskCache& cache)
        : reader_(std::move(reader)), study_(reader_->study()), cache_(cache), fitter_(study_, cache) {}

    SpectraDone fit(const SpectraTask& task) {
        const std::shared_ptr<const StudySpectra> read = reader_->spectra_of(task.file);
        SpectraDone done;
        for (const TaskedSpectrum& wanted : task.spectra) {
            for (std::size_t i = 0; i < read->entries.size(); ++i) {
                const RosterEntry& entry = read->entries[i];
                const bool is_it =
                    entry.number == wanted.number && entry.name == wanted.name && entry.input_hash == wanted.input_hash;
                if (!is_it) continue;
                done.answers.push_back({.key = {.source = entry.source, .number = entry.number, .name = entry.name},
                                        .studied = fitter_.fit(read->spectra[i])});
            }
        }
        return done;
    }

    TileDone fit(const TileTask& task) {
        const auto begin = std::chrono::steady_clock::now();
        TileDone done{.cube = task.cube, .tile = {.tile = task.tile, .pixels = {}, .bytes = {}}, .problem = {}};
        try {
            const StudyCube& cube = study_.cubes[task.cube];
            const SpectralCube opened(reader_->files_of_cube(task.cube), cube.unit);
            const CubeRegion region(cube.region, opened);
            const std::shared_ptr<const PixelFitter> fitter = fitter_of(task.cube, opened);
            MapTile tile = fit_tile(*fitter, opened, region, task.tile.first_line, task.tile.lines);
            done.tile.bytes = std::move(tile.bytes);
            done.tile.pixels = tile.pixels;
        } catch (const InputError& error) {
            done.problem = error.what();
        }
        done.tile.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        return done;
    }

private:
    std::shared_ptr<const PixelFitter> fitter_of(std::size_t cube, const SpectralCube& opened) {
        const std::lock_guard lock(mutex_);
        std::shared_ptr<const PixelFitter>& fitter = pixel_fitters_[cube];
        if (!fitter) {
            fitter = std::make_shared<const PixelFitter>(study_.configuration, common_spectrum(opened), cache_);
        }
        return fitter;
    }

    std::shared_ptr<StudyReader> reader_;
    const Study& study_;
    DiskCache cache_;
    SpectrumFitter fitter_;
    std::mutex mutex_;
    std::map<std::size_t, std::shared_ptr<const PixelFitter>> pixel_fitters_;
};

}  // namespace

Worker study_worker(std::shared_ptr<StudyReader> reader, const DiskCache& cache) {
    const auto workshop = std::make_shared<Workshop>(std::move(reader), cache);
    return [workshop](const std::string& text) {
        const StudyTask task = task_in(text);
        if (const auto* const spectra = std::get_if<SpectraTask>(&task)) return bytes_of(workshop->fit(*spectra));
        return bytes_of(workshop->fit(std::get<TileTask>(task)));
    };
}

}  // namespace skinfit
