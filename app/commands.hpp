#pragma once

#include <CLI/CLI.hpp>

#include "app/session.hpp"

/// One function per command: it adds the command to `app`; the command sets `session.exit_code` when it runs.
namespace skinfit {

void add_fit_command(CLI::App& app, Session& session);
void add_inspect_command(CLI::App& app, Session& session);
void add_simulate_command(CLI::App& app, Session& session);
void add_sensitivity_command(CLI::App& app, Session& session);
void add_design_command(CLI::App& app, Session& session);
void add_describe_command(CLI::App& app, Session& session);
void add_explore_command(CLI::App& app, Session& session);
void add_gonio_command(CLI::App& app, Session& session);
void add_validate_command(CLI::App& app, Session& session);
/// A subcommand of `validate`.
void add_validate_inverse_command(CLI::App& validate, Session& session);
void add_study_command(CLI::App& app, Session& session);
/// Subcommands of `study`.
void add_study_run_command(CLI::App& study, Session& session);
void add_study_status_command(CLI::App& study, Session& session);
void add_study_export_command(CLI::App& study, Session& session);
void add_study_report_command(CLI::App& study, Session& session);
void add_study_power_command(CLI::App& study, Session& session);
void add_study_merge_command(CLI::App& study, Session& session);
void add_study_simulate_command(CLI::App& study, Session& session);
void add_bench_command(CLI::App& app, Session& session);
void add_convert_command(CLI::App& app, Session& session);
void add_config_command(CLI::App& app, Session& session);
void add_completion_command(CLI::App& app, Session& session);
void add_help_command(CLI::App& app, Session& session);
void add_manual_command(CLI::App& app, Session& session);

}  // namespace skinfit
