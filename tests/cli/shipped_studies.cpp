#include <algorithm>

#include "study/study.hpp"
#include "tests/cli/study_test.hpp"

namespace skinfit::test {
namespace {

const std::filesystem::path configs = std::filesystem::path(SKINFIT_SOURCE_DIR) / "configs";

const std::filesystem::path shared_spectra = std::filesystem::path(SKINFIT_SOURCE_DIR) / "../shared/spectra";

bool is_complete(const Study& study) {
    return std::ranges::all_of(study.files, [](const StudyFile& file) { return std::filesystem::exists(file.path); });
}

class ShippedStudies : public CliTest {};

TEST_F(ShippedStudies, RunAndReport) {
    int studies = 0;
    int without_files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(configs)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("study_") || !name.ends_with(".json")) continue;
        ++studies;
        // One reads the shipped specimens beside it, the others need data that are not shipped.
        const std::filesystem::path data = is_complete(read_study(entry.path())) ? configs : shared_spectra;
        if (data != configs) {
            const Outcome lost = run({"study", "run", entry.path().string(), "--ledger", "none.sqlite"});
            EXPECT_EQ(lost.exit_code, 2) << name;
            EXPECT_NE(lost.err.find(".inputs: none of the files is there"), std::string::npos) << lost.err;
            EXPECT_NE(lost.err.find("name their folder with --data"), std::string::npos) << lost.err;
        }
        if (!is_complete(read_study(entry.path(), data))) {
            ++without_files;
            continue;
        }
        const std::vector<std::string> where = {entry.path().string(), "--data", data.string(), "--ledger",
                                                name + ".sqlite"};
        std::vector<std::string> study_run = {"study", "run"};
        study_run.insert(study_run.end(), where.begin(), where.end());
        const Outcome ran = run(study_run);
        EXPECT_LE(ran.exit_code, 1) << name << ": " << ran.err;
        std::vector<std::string> study_report = {"study", "report", "--out", name + ".html"};
        study_report.insert(study_report.end(), where.begin(), where.end());
        const Outcome reported = run(study_report);
        EXPECT_EQ(reported.exit_code, 0) << name << ": " << reported.err;
        const std::string page = read_file(folder() / (name + ".html"));
        EXPECT_NE(page.find("Parameters and indices"), std::string::npos) << name;
        EXPECT_EQ(page.find("<script"), std::string::npos) << name;
    }
    EXPECT_GE(studies, 4);
    if (without_files > 0) {
        GTEST_SKIP() << without_files << " of " << studies
                     << " studies read data that are not shipped, and ../shared is absent; the others ran";
    }
}

}  // namespace
}  // namespace skinfit::test
