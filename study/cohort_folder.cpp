#include "study/cohort_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "study/manifest.hpp"
#include "study/planned_study.hpp"

namespace skinfit {
namespace {

constexpr std::string_view cohort_file = "cohort.json";
constexpr std::string_view study_file = "study.json";
constexpr std::array files = {spectra_file, manifest_file, cohort_file, study_file};

/// Whether the first line says that it is a table of ours.
bool is_ours(const std::filesystem::path& spectra) {
    const std::string text = read_file(spectra);
    const std::string line = text.substr(0, text.find('\n'));
    return line.starts_with("# skinfit ") && line.find(" simulated cohort ") != std::string::npos;
}

}  // namespace

bool holds_earlier_cohort(const std::filesystem::path& folder, const std::filesystem::path& source) {
    const auto refuse = [&](const std::string& problem, const std::string& why) {
        throw InputError({.where = fmt::format("--output {}", folder.string()),
                          .problem = problem,
                          .why = why,
                          .remedy = "name another folder"});
    };
    bool empty = true;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        empty = false;
        const std::string name = entry.path().filename().string();
        if (std::ranges::find(files, name) == files.end()) {
            refuse(fmt::format("holds {}", name),
                   "it belongs to no simulated cohort or rests on the one that is there");
        }
        std::error_code error;
        if (std::filesystem::equivalent(entry.path(), source, error)) {
            refuse(fmt::format("{} is the cohort that is read", name), "it would be replaced");
        }
    }
    if (empty) return false;
    const std::filesystem::path spectra = folder / spectra_file;
    if (!std::filesystem::exists(spectra) || !is_ours(spectra)) {
        refuse(fmt::format("holds no {} of an earlier simulation", spectra_file),
               "its other files would be replaced, and may not be ours");
    }
    return true;
}

void write_cohort(const Cohort& cohort, const SimulatedCohort& simulated, const std::filesystem::path& folder) {
    const auto json_text = [](const Json& json) { return json.dump(2) + "\n"; };
    write_file_atomically(folder / spectra_file, cohort_spectra_csv(cohort, simulated));
    write_file_atomically(folder / manifest_file, manifest_csv(cohort, simulated));
    write_file_atomically(folder / cohort_file, json_text(cohort.resolved));
    write_file_atomically(folder / study_file, json_text(study_json(cohort)));
}

}  // namespace skinfit
