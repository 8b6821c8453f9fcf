#include "app/commands.hpp"

namespace skinfit {

void add_study_command(CLI::App& app, int& exit_code) {
    CLI::App* const study = app.add_subcommand("study", "studies of many spectra");
    study->require_subcommand(1);
    add_study_simulate_command(*study, exit_code);
}

}  // namespace skinfit
