#include "app/study_options.hpp"

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "study/study_run.hpp"

namespace skinfit {

CLI::App* add_study_subcommand(CLI::App& study, StudyOptions& options, const std::string& name,
                               const std::string& meaning) {
    CLI::App* const command = study.add_subcommand(name, meaning);
    command->add_option("STUDY", options.study, "JSON file that describes the study")->required();
    command->add_option("--data", options.data, "folder in which the inputs are, instead of that of STUDY")
        ->type_name("FOLDER");
    command
        ->add_option("--ledger", options.ledger,
                     "database of the study's results; ledger.sqlite in its output folder if not given")
        ->type_name("FILE");
    return command;
}

Study study_of(const StudyOptions& options) {
    return read_study(options.study, options.data);
}

std::filesystem::path ledger_of(const StudyOptions& options, const Study& study) {
    return options.ledger.empty() ? ledger_path(study) : std::filesystem::path(options.ledger);
}

int exit_code_of(const StudyCounts& counts) {
    const auto count = [](const StatusCounts& each, FitStatus status) {
        return each[static_cast<std::size_t>(status)];
    };
    for (const FitStatus status : {FitStatus::pending, FitStatus::suspect, FitStatus::rejected, FitStatus::failed}) {
        if (count(counts.spectra, status) > 0 || count(counts.pixels, status) > 0) return result_with_warning;
    }
    return counts.unread_cubes.empty() && counts.maps == counts.cubes ? good_result : result_with_warning;
}

}  // namespace skinfit
