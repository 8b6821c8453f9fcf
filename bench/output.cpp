#include "bench/output.hpp"

#include <fmt/format.h>

#include <array>

namespace skinfit {
namespace {

struct TimeRatio {
    const char* name;
    const char* slower;
    const char* faster;
};
constexpr auto ratios = std::to_array<TimeRatio>({{"paths_over_brute_force", "brute_force", "paths"},
                                                  {"paths_as_fit_over_brute_force", "brute_force", "paths_as_fit"},
                                                  {"emulator_over_paths", "paths", "emulator"},
                                                  {"emulator_over_paths_as_fit", "paths_as_fit", "emulator"},
                                                  {"emulator_over_solver", "solver", "emulator"}});

double ratio_of(const BenchResult& result, const TimeRatio& ratio, double Duration::*clock) {
    return rung(result, ratio.slower).median.*clock / rung(result, ratio.faster).median.*clock;
}

Json rung_json(const BenchRung& rung) {
    Json json = {{"name", rung.name},
                 {"what", rung.what},
                 {"spectra", rung.spectra},
                 {"median_wall_s", rung.median.wall_s},
                 {"median_cpu_s", rung.median.cpu_s},
                 {"median_evaluations", rung.evaluations},
                 {"model_mb", rung.model_mb}};
    if (rung.accuracy) {
        json["accuracy"] = {{"median_sigmas", rung.accuracy->median_sigmas},
                            {"worst_sigmas", rung.accuracy->worst_sigmas},
                            {"other_minima", rung.accuracy->other_minima}};
    }
    return json;
}

}  // namespace

Json bench_json(const BenchResult& result) {
    Json json = {{"machine", result.machine},
                 {"compiler", result.compiler},
                 {"threads", 2},
                 {"spectra", result.sizes.spectra},
                 {"rays", result.sizes.rays},
                 {"wavelengths", 31},
                 {"free_parameters", 5}};
    for (const TimeRatio& ratio : ratios) {
        json["ratios"][ratio.name] = ratio_of(result, ratio, &Duration::cpu_s);
        json["ratios_by_wall_clock"][ratio.name] = ratio_of(result, ratio, &Duration::wall_s);
    }
    json["bulk_spectra_per_s"] = result.bulk_spectra_per_s;
    json["bulk_spectra_per_cpu_s"] = result.bulk_spectra_per_cpu_s;
    json["bulk_not_converged"] = result.bulk_not_converged;
    for (const BenchThreads& each : result.threads) json["two_threads_over_one"][each.name] = each.one_s / each.two_s;
    json["intervals"] = {{"spectra", result.intervals.spectra},
                         {"parameters", result.intervals.profile_parameters},
                         {"profile_wall_s", result.intervals.profile.wall_s},
                         {"profile_cpu_s", result.intervals.profile.cpu_s},
                         {"posterior_wall_s", result.intervals.posterior.wall_s},
                         {"posterior_cpu_s", result.intervals.posterior.cpu_s},
                         {"least_effective_draws", result.intervals.least_effective_draws}};
    json["emulator"] = {{"certified_error", result.certified_error},
                        {"build_s", result.build.wall_s},
                        {"build_cpu_s", result.build.cpu_s}};
    json["recorded_rays_per_s_and_core"] = result.recorded_rays_per_s_and_core;
    json["standard_error_100k_rays_table_1"] = {{"largest", result.largest_standard_error},
                                                {"median", result.median_standard_error}};
    json["brute_force"] = {{"timed_evaluations", result.brute_force_timed},
                           {"evaluation_wall_s", result.brute_force_evaluation.wall_s},
                           {"evaluation_cpu_s", result.brute_force_evaluation.cpu_s},
                           {"extrapolated_to_evaluations", rung(result, "brute_force").evaluations}};
    for (const BenchRung& each : result.rungs) json["rungs"].push_back(rung_json(each));
    json["peak_memory_mb"] = result.peak_mb;
    json["whole_wall_s"] = result.whole.wall_s;
    return json;
}

std::string bench_text(const BenchResult& result) {
    std::string text = fmt::format(
        "{}, {}, two threads\n"
        "31 wavelengths, five free pigments, {} spectra with noise 0.003, {} rays\n\n"
        "{:<17}{:>9}{:>12}{:>14}{:>13}{:>8}{:>8}{:>7}{:>11}\n",
        result.machine, result.compiler, result.sizes.spectra, result.sizes.rays, "one fit, median", "spectra",
        "clock, s", "processor, s", "evaluations", "off", "worst", "other", "model, MB");
    for (const BenchRung& each : result.rungs) {
        const auto off = [&](double number) { return each.accuracy ? fmt::format("{:.3f}", number) : "-"; };
        const BenchAccuracy accuracy = each.accuracy.value_or(BenchAccuracy{});
        text += fmt::format("{:<17}{:>9}{:>12.3g}{:>14.3g}{:>13.0f}{:>8}{:>8}{:>7}{:>11.1f}\n", each.name, each.spectra,
                            each.median.wall_s, each.median.cpu_s, each.evaluations, off(accuracy.median_sigmas),
                            off(accuracy.worst_sigmas), accuracy.other_minima, each.model_mb);
    }
    text += fmt::format(
        "\nevaluations: of the model, at one set of values; off, worst: median and largest of how far a parameter is "
        "from the solver's fit, in sigmas; other: fits that ended at another minimum\nbrute_force: {} evaluations "
        "timed, extrapolated to the {:.0f} that BOBYQA takes over recorded "
        "paths\n\n",
        result.brute_force_timed, rung(result, "brute_force").evaluations);
    for (const TimeRatio& ratio : ratios) {
        text += fmt::format("{:<34}{:>10.0f} times as fast by processor time, {:.0f} by the clock\n", ratio.name,
                            ratio_of(result, ratio, &Duration::cpu_s), ratio_of(result, ratio, &Duration::wall_s));
    }
    for (const BenchThreads& each : result.threads) {
        text += fmt::format("{:<34}{:>10.2f}\n", "two threads over one, " + each.name, each.one_s / each.two_s);
    }
    return text +
           fmt::format(
               "bulk{:>40.0f} spectra per s by the clock, {:.0f} per s of one processor; {} of {} not converged\n"
               "profile intervals{:>27.2g} s for {} parameters, emulator, median of {} spectra\n"
               "posterior{:>35.2g} s to 1000 effective draws of each ({:.0f} at least)\n"
               "recorded rays{:>31.3g} per s and core\n"
               "standard error at Table 1{:>19.5f} at most, median {:.5f}\n"
               "emulator{:>36.1e} certified error, built in {:.2f} s\n"
               "whole run{:>35.0f} s, {:.0f} MB at most\n",
               result.bulk_spectra_per_s, result.bulk_spectra_per_cpu_s, result.bulk_not_converged,
               result.sizes.spectra, result.intervals.profile.wall_s, result.intervals.profile_parameters,
               result.intervals.spectra, result.intervals.posterior.wall_s, result.intervals.least_effective_draws,
               result.recorded_rays_per_s_and_core, result.largest_standard_error, result.median_standard_error,
               result.certified_error, result.build.wall_s, result.whole.wall_s, result.peak_mb);
}

}  // namespace skinfit
