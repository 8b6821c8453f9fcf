#include "app/commands.hpp"

namespace skinfit {

void add_study_command(CLI::App& app, Session& session) {
    CLI::App* const study = app.add_subcommand("study", "fit thousands of spectra and whole images by one file");
    study->require_subcommand(1);
    add_study_run_command(*study, session);
    add_study_status_command(*study, session);
    add_study_export_command(*study, session);
    add_study_report_command(*study, session);
    add_study_power_command(*study, session);
    add_study_merge_command(*study, session);
    add_study_simulate_command(*study, session);
}

}  // namespace skinfit
