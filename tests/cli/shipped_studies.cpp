#include <algorithm>

#include "study/study.hpp"
#include "tests/cli/study_test.hpp"

namespace skinfit::test {
namespace {

const std::filesystem::path configs = std::filesystem::path(SKINFIT_SOURCE_DIR) / "configs";

class ShippedStudies : public CliTest {};

TEST_F(ShippedStudies, RunAndReport) {
    int studies = 0;
    int without_files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(configs)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("study_") || !name.ends_with(".json")) continue;
        ++studies;
        const Study study = read_study(entry.path());
        const bool here =
            std::ranges::all_of(study.files, [](const StudyFile& file) { return std::filesystem::exists(file.path); });
        if (!here) {
            ++without_files;
            continue;
        }
        const std::string ledger = name + ".sqlite";
        const Outcome ran = run({"study", "run", entry.path().string(), "--ledger", ledger});
        EXPECT_LE(ran.exit_code, 1) << name << ": " << ran.err;
        const Outcome reported =
            run({"study", "report", entry.path().string(), "--ledger", ledger, "--out", name + ".html"});
        EXPECT_EQ(reported.exit_code, 0) << name << ": " << reported.err;
        const std::string page = read_file(folder() / (name + ".html"));
        EXPECT_NE(page.find("Parameters and indices"), std::string::npos) << name;
        EXPECT_EQ(page.find("<script"), std::string::npos) << name;
    }
    EXPECT_GE(studies, 4);
    if (without_files > 0) {
        GTEST_SKIP() << without_files << " of " << studies
                     << " studies read ../shared, which is absent; the others ran";
    }
}

}  // namespace
}  // namespace skinfit::test
