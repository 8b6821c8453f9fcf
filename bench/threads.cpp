#include "bench/threads.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <functional>

#include "bench/stopwatch.hpp"
#include "fit/bulk.hpp"
#include "fit/misfit_description.hpp"

namespace skinfit {
namespace {

using Index = Eigen::Index;

/// The shortest times of `work`, by turns on one thread and on two.
BenchThreads on_one_and_two_threads(const std::string& name, int runs, const std::function<void()>& work) {
    BenchThreads times{.name = name, .one_s = 0.0, .two_s = 0.0, .one_cpu_s = 0.0};
    const auto timed = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const Stopwatch watch;
        work();
        return watch.elapsed();
    };
    for (int run = 0; run < runs; ++run) {
        const Duration one = timed(1);
        const Duration two = timed(2);
        times.one_s = run == 0 ? one.wall_s : std::min(times.one_s, one.wall_s);
        times.two_s = run == 0 ? two.wall_s : std::min(times.two_s, two.wall_s);
        times.one_cpu_s = run == 0 ? one.cpu_s : std::min(times.one_cpu_s, one.cpu_s);
    }
    return times;
}

std::vector<PerLayer<double>> table_1_depths(const FitProblem& problem) {
    return optical_depths(problem.only().experiment.values.skin,
                          extinctions(problem.only().wavelength_nm, problem.only().experiment.edition));
}

}  // namespace

PathEnsemble recorded(const FitProblem& problem) {
    return PathEnsemble::trace(problem.only().experiment.sample(), problem.only().wavelength_nm, problem.only().walk);
}

void measure_threads(const BenchWork& work, const PathEnsemble& ensemble, const Emulator& emulator,
                     BenchResult& result) {
    const FitProblem& problem = work.problem;
    const std::vector<PerLayer<double>> depths = table_1_depths(problem);
    result.threads.push_back(on_one_and_two_threads("record", 3, [&] { (void)recorded(problem); }));
    result.recorded_rays_per_s_and_core = static_cast<double>(problem.only().walk.rays) *
                                          static_cast<double>(problem.only().wavelength_nm.size()) /
                                          result.threads.back().one_cpu_s;
    result.threads.push_back(on_one_and_two_threads("respond", 30, [&] { (void)ensemble.respond(depths); }));

    const Index count = std::max<Index>(work.spectra.cols(), result.sizes.bulk_spectra);
    Eigen::MatrixXd many(work.spectra.rows(), count);
    for (Index column = 0; column < count; ++column) many.col(column) = work.spectra.col(column % work.spectra.cols());
    std::vector<BulkFit> fits;
    result.threads.push_back(on_one_and_two_threads("bulk", 3, [&] { fits = fit_in_bulk(problem, emulator, many); }));
    result.bulk_spectra_per_s = static_cast<double>(count) / result.threads.back().two_s;
    result.bulk_spectra_per_cpu_s = static_cast<double>(count) / result.threads.back().one_cpu_s;
    result.bulk_not_converged = static_cast<int>(
        std::count_if(fits.begin(), fits.begin() + work.spectra.cols(), [](const BulkFit& f) { return !f.converged; }));

    std::vector<double> errors;
    for (const EnsembleResponse& response : ensemble.respond(depths)) {
        errors.push_back(response[Side::top].standard_error);
    }
    result.largest_standard_error = *std::ranges::max_element(errors);
    result.median_standard_error = median(errors);
}

}  // namespace skinfit
