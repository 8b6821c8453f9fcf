#include "app/validate_by_transport.hpp"

#include <fmt/format.h>

#include "app/outputs.hpp"
#include "app/progress_line.hpp"
#include "app/terminal.hpp"
#include "app/transport_watch.hpp"
#include "core/file.hpp"
#include "core/stop.hpp"
#include "fit/configuration_check.hpp"
#include "fit/configuration_json.hpp"
#include "fit/problem.hpp"
#include "fit/simulation.hpp"
#include "study/planned_study.hpp"
#include "validation/transport_summary.hpp"

namespace skinfit {
namespace {

/// The fit of the cohort's own study with what the command changes.
Configuration configuration_of(const TransportValidation& command, const Cohort& cohort) {
    const Configuration planned = planned_fit(cohort);
    Configuration configuration = configuration_from(command.shared, planned);
    // Another preset takes all back that the plan has stated.
    if (!configuration.noise) configuration.noise = planned.noise;
    const auto take = [&](const char* key, const std::string& text) {
        if (!text.empty()) configuration = configured_by_word(configuration, key, text, std::string("--") + key);
    };
    take("seed", command.seed);
    take("engine", command.engine);
    return with_free_and_fixed(configuration, command.free, command.fix);
}

void write(const TransportValidation& command, const TransportStudy& study, const TransportSummary& summary,
           const Configuration& configuration, const Cohort& cohort) {
    write_file_atomically(command.output / "transport.csv", transport_csv(study));
    Json json = transport_json(summary);
    json["simulated_by"] = "transport";
    json["simulation"] = cohort.resolved;
    json["configuration"] = to_json(configuration);
    const std::string text = json_text(json);
    write_file_atomically(command.output / "summary.json", text);
    command.shared.format == "json" ? write_stdout(text) : write_report_to_stdout(transport_text(summary));
}

/// The fits of all skins; of none where Ctrl-C came while photons were traced.
TransportStudy studied(const TransportValidation& command, const Cohort& cohort, const Configuration& configuration,
                       Session& session, ProgressLine& line) {
    const SimulationWatch tracing = transport_watch(cohort, session, line);
    const DiskCache cache = cache_from(command.shared, line);
    try {
        const SimulatedCohort simulated = simulate(cohort, cache, tracing);
        const std::size_t total = simulated.subjects.size();
        return fit_transport_skins(cohort, simulated, configuration, cache,
                                   {.stop = tracing.stop, .progress = [&line, total](std::uint64_t done) {
                                        line.show({.what = fmt::format("fitting, {}/{} spectra", done, total),
                                                   .done = done,
                                                   .total = total,
                                                   .count = done,
                                                   .unit = "spectra"});
                                    }});
    } catch (const Cancelled&) {
        return {};
    }
}

}  // namespace

int validate_by_transport(const TransportValidation& command, Session& session) {
    const Cohort stated = transport_cohort(command.cohort, command.spectra);
    const Configuration configuration = configuration_of(command, stated);
    const Cohort cohort = measured_as(stated, configuration, command.port_diameter_mm);
    check_freedom(configuration, "free");
    (void)make_problem(configuration, blank_spectrum(cohort.configuration));
    make_output_folder(command.output);
    const auto limit = thread_limit(command.shared);
    ProgressLine line(session, "tracing photons");
    const TransportStudy study = studied(command, cohort, configuration, session, line);
    line.end();
    if (study.fits.empty()) {
        line.tell("no spectrum was finished; nothing was written");
        return session.interrupt.exit_code();
    }
    const TransportSummary summary = summarised(study);
    write(command, study, summary, configuration, cohort);
    if (session.interrupt.signal()) {
        line.tell(fmt::format("interrupted: only these {} spectra were finished", study.fits.size()));
        return session.interrupt.exit_code();
    }
    return passes(summary) ? good_result : result_with_warning;
}

}  // namespace skinfit
