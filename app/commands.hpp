#pragma once

#include <CLI/CLI.hpp>

/// One function per command: it adds the command to `app`; the command sets `exit_code` when it runs.
namespace skinfit {

/// What a run of the program ended with.
enum ExitCode : int { trustworthy_result = 0, result_with_warning = 1, bad_input = 2, internal_error = 3 };

void add_fit_command(CLI::App& app, int& exit_code, const std::string& command_line);
void add_inspect_command(CLI::App& app, int& exit_code);
void add_simulate_command(CLI::App& app, int& exit_code);
void add_sensitivity_command(CLI::App& app, int& exit_code);
void add_design_command(CLI::App& app, int& exit_code);
void add_explore_command(CLI::App& app, int& exit_code);
void add_gonio_command(CLI::App& app, int& exit_code);
void add_validate_command(CLI::App& app, int& exit_code);
/// A subcommand of `validate`.
void add_validate_inverse_command(CLI::App& validate, int& exit_code);
void add_study_command(CLI::App& app, int& exit_code);
/// Subcommands of `study`.
void add_study_run_command(CLI::App& study, int& exit_code);
void add_study_status_command(CLI::App& study, int& exit_code);
void add_study_export_command(CLI::App& study, int& exit_code);
void add_study_report_command(CLI::App& study, int& exit_code);
void add_study_power_command(CLI::App& study, int& exit_code);
void add_study_merge_command(CLI::App& study, int& exit_code);
void add_study_simulate_command(CLI::App& study, int& exit_code);
void add_bench_command(CLI::App& app, int& exit_code);
void add_convert_command(CLI::App& app, int& exit_code);
void add_config_command(CLI::App& app, int& exit_code);

}  // namespace skinfit
