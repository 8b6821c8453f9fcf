#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "study/study_output.hpp"

namespace skinfit {

/// Options that the subcommands of `study` have in common.
struct StudyOptions {
    std::string study;   ///< JSON file
    std::string ledger;  ///< empty: in the study's output folder
    std::string format;
};

/// Adds the subcommand `name` of `study`, with the study's file and --ledger.
CLI::App* add_study_subcommand(CLI::App& study, StudyOptions& options, const std::string& name,
                               const std::string& meaning);

/// The ledger that the options mean.
[[nodiscard]] std::filesystem::path ledger_of(const StudyOptions& options, const Study& study);

/// 0 where every spectrum and pixel is fitted, else 1.
[[nodiscard]] int exit_code_of(const StudyCounts& counts);

}  // namespace skinfit
