#include "study/study.hpp"

#include <gtest/gtest.h>

#include "core/file.hpp"
#include "measurements/quality_checks.hpp"
#include "model/parameters.hpp"
#include "tests/study/example_ledger.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

class StudyFiles : public test::TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        for (const std::string name : {"a.csv", "b.csv", "c[1].csv"}) write_file_atomically(in_folder(name), "x");
        std::filesystem::create_directory(in_folder("d.csv"));
    }
    [[nodiscard]] Study parsed(const std::string& text) const { return parse_study(text, in_folder("study.json")); }
    [[nodiscard]] std::vector<std::string> sources(const std::string& inputs) const {
        std::vector<std::string> names;
        for (const StudyFile& file : parsed("{\"inputs\": " + inputs + R"(, "output": "out"})").files) {
            names.push_back(file.source);
        }
        return names;
    }
};

using Names = std::vector<std::string>;

TEST_F(StudyFiles, TheShippedExampleIsAStudy) {
    const Study study = read_study(std::filesystem::path(SKINFIT_SOURCE_DIR) / "configs" / "study_example.json");
    EXPECT_EQ(study.name, "study_example");
    EXPECT_EQ(study.files.size(), 2U);
}

TEST_F(StudyFiles, HoldsWhatItsFileSays) {
    const Study study = parsed(R"({
  // comments are allowed
  "name": "jaundice",
  "inputs": ["a.csv", {"files": "b.csv", "unit": "percent", "reader": "columns", "metadata": {"site": "arm", "age": 3},
             "names": {"pattern": "^(s[0-9]+)_(.*)$", "fields": ["subject", "visit"]}}],
  "instrument": "ncsu_45_0",
  "fit": {"noise": 0.004},
  "accept": ["spikes"],
  "group_by": ["site", "visit"],
  "repeats_of": "subject",
  "indicators": [
    {"name": "jaundiced", "parameter": "dermal_bilirubin_g_per_l", "above": 0.1, "source": "the example",
     "prevalence": 0.5},
    {"name": "pale", "index": "melanin_index", "below": {"same": "subject", "where": {"site": "arm"}}, "source": "x"}],
  "assess": [
    {"indicator": "jaundiced", "label": "ill", "positive": "yes", "thresholds": [0.2, 0.8]},
    {"parameter": "dermal_bilirubin_g_per_l", "reference": "serum"}],
  "output": "out"})");
    EXPECT_EQ(study.name, "jaundice");
    ASSERT_EQ(study.files.size(), 2U);
    EXPECT_EQ(study.files[0].source, "a.csv");
    EXPECT_EQ(study.files[1].unit, Unit::percent);
    EXPECT_EQ(study.files[1].reader, "columns");
    EXPECT_EQ(study.files[1].metadata, (Metadata{{"site", "arm"}, {"age", "3"}}));
    EXPECT_EQ(study.files[1].names->fields, (Names{"subject", "visit"}));
    EXPECT_EQ(study.instrument, "ncsu_45_0");
    EXPECT_EQ(study.configuration.noise, 0.004);
    EXPECT_EQ(study.configuration.engine, Engine::emulator);
    EXPECT_EQ(study.accept, Names{"spikes"});
    EXPECT_EQ(study.group_by, (Names{"site", "visit"}));
    EXPECT_EQ(study.repeats_of, "subject");
    ASSERT_EQ(study.indicators.size(), 2U);
    EXPECT_TRUE(study.indicators[0].above);
    EXPECT_EQ(study.indicators[0].threshold, 0.1);
    EXPECT_FALSE(study.indicators[0].reference);
    EXPECT_EQ(study.indicators[0].prevalence, 0.5);
    EXPECT_FALSE(study.indicators[1].prevalence);
    EXPECT_FALSE(study.indicators[1].above);
    EXPECT_FALSE(study.indicators[1].threshold);
    EXPECT_EQ(study.indicators[1].reference->same, "subject");
    EXPECT_EQ(study.indicators[1].reference->where, (Metadata{{"site", "arm"}}));
    ASSERT_EQ(study.assessments.size(), 2U);
    EXPECT_EQ(study.assessments[0].thresholds, (std::vector<double>{0.2, 0.8}));
    EXPECT_EQ(study.assessments[0].positive, "yes");
    EXPECT_FALSE(study.assessments[1].is_indicator);
    EXPECT_EQ(study.assessments[1].metadata, "serum");
    EXPECT_EQ(study.output, in_folder("out"));
}

TEST_F(StudyFiles, SpectraBeginWithPresetSkinAndImagesWithThePapers) {
    const auto configuration = [this](const std::string& input, const std::string& fit) {
        return parsed("{\"inputs\": [" + input + "], \"fit\": " + fit + R"(, "output": "out"})").configuration;
    };
    const Configuration skin = configuration(R"("a.csv")", "{}");
    EXPECT_EQ(skin.preset, Preset::skin);
    EXPECT_TRUE(skin.discrepancy);
    const Configuration paper = configuration(R"("a.csv")", R"({"preset": "paper"})");
    EXPECT_EQ(paper.preset, Preset::paper);
    EXPECT_EQ(paper.engine, Engine::emulator);
    EXPECT_FALSE(paper.discrepancy);
    EXPECT_EQ(configuration(R"("a.csv")", R"({"preset": "paper", "engine": "paths"})").engine, Engine::paths);
    const Configuration image = configuration(R"({"cube": "image.hdr"})", "{}");
    EXPECT_EQ(image.preset, Preset::paper);
    EXPECT_EQ(image.engine, Engine::emulator);
}

TEST_F(StudyFiles, QuantitiesOfTheTissueAreAskedForAsParametersWhereFitsAdjustThem) {
    const std::string frame = R"({"inputs": ["a.csv"], "output": "out", "fit": {"free": ["%"]},
        "indicators": [{"name": "jaundice", "parameter": "tissue_bilirubin_mg_per_dl", "above": 5, "source": "x"}],
        "assess": [{"parameter": "tissue_bilirubin_mg_per_dl", "reference": "serum_bilirubin_mg_per_dl"}]})";
    const auto freeing = [&](const std::string& name) {
        std::string text = frame;
        return parsed(text.replace(text.find('%'), 1, name));
    };
    const Study study = freeing("dermal_bilirubin_g_per_l");
    EXPECT_EQ(study.indicators[0].quantity, "tissue_bilirubin_mg_per_dl");
    EXPECT_EQ(study.indicators[0].threshold, 5.0);
    EXPECT_EQ(study.assessments[0].name, "tissue_bilirubin_mg_per_dl");
    const std::string complaint = test::refusal_of([&] { (void)freeing("melanosome_fraction"); });
    EXPECT_NE(
        complaint.find("indicator jaundice: tissue_bilirubin_mg_per_dl is not adjusted by the fits (they hold all "
                       "that it is computed from, and say nothing about it); add what it is computed from"),
        std::string::npos)
        << complaint;
}

TEST_F(StudyFiles, ThresholdsDefaultToOneHalfAndTheNameToTheFile) {
    const Study study = parsed(R"({"inputs": ["a.csv"], "output": "out",
  "indicators": [{"name": "i", "index": "melanin_index", "above": 40, "source": "x"}],
  "assess": [{"indicator": "i", "label": "l", "positive": "p"}]})");
    EXPECT_EQ(study.assessments[0].thresholds, std::vector<double>{0.5});
    EXPECT_EQ(study.name, "study");
}

TEST_F(StudyFiles, PatternsNameFilesInOrder) {
    EXPECT_EQ(sources("[\"*.csv\"]"), (Names{"a.csv", "b.csv", "c[1].csv"})) << "folders are no files";
    EXPECT_EQ(sources("[\"[ab].csv\"]"), (Names{"a.csv", "b.csv"}));
    EXPECT_EQ(sources("[{\"files\": [\"?.csv\", \"c[[]1].csv\"]}]"), (Names{"a.csv", "b.csv", "c[1].csv"}));
    EXPECT_EQ(sources("[\"c[1].csv\"]"), Names{"c[1].csv"}) << "the name of a file is itself";
    EXPECT_EQ(sources("[\"later.csv\"]"), Names{"later.csv"}) << "what is missing is a result of the run";
    EXPECT_EQ(sources("[\"./x/../a.csv\"]"), Names{"a.csv"});
}

TEST_F(StudyFiles, AFileCalledLikeAPatternHidesNoOther) {
    write_file_atomically(in_folder("*.csv"), "x");
    EXPECT_EQ(sources("[\"*.csv\"]"), (Names{"*.csv", "a.csv", "b.csv", "c[1].csv"}));
    EXPECT_EQ(sources(R"(["\\*.csv"])"), Names{"*.csv"});
    write_file_atomically(in_folder("c1.csv"), "x");
    const std::string complaint = test::refusal_of([&] { (void)sources("[\"c[1].csv\"]"); });
    EXPECT_NE(complaint.find("c[1].csv is a file, and as a pattern names "), std::string::npos) << complaint;
    EXPECT_EQ(sources(R"(["c\\[1].csv"])"), Names{"c[1].csv"});
}

TEST_F(StudyFiles, AFolderMayBearTheMarksOfPatterns) {
    const std::filesystem::path folder = in_folder("study [1] *?\\");
    std::filesystem::create_directory(folder);
    write_file_atomically(folder / "a.csv", "x");
    const Study study = parse_study(R"({"inputs": ["*.csv"], "output": "out"})", folder / "study.json");
    ASSERT_EQ(study.files.size(), 1U);
    EXPECT_EQ(study.files[0].source, "a.csv");
    EXPECT_EQ(study.files[0].path, folder / "a.csv");
}

TEST_F(StudyFiles, FilesElsewhereKeepTheirWholeName) {
    const std::filesystem::path elsewhere = std::filesystem::temp_directory_path() / "a.csv";
    EXPECT_EQ(sources("[" + Json(elsewhere.string()).dump() + "]"), Names{elsewhere.string()});
}

TEST_F(StudyFiles, AManifestNamesFilesRelativeToItself) {
    std::filesystem::create_directory(in_folder("sub"));
    write_file_atomically(in_folder("sub/m.csv"), "file,spectrum,subject\nx.csv,1,a\n../a.csv,,b\n./x.csv,2,c\n");
    const Study study = parsed(R"({"inputs": ["b.csv", {"manifest": "sub/m.csv", "metadata": {"site": "arm"}}],
  "output": "out"})");
    ASSERT_EQ(study.files.size(), 3U);
    EXPECT_EQ(study.files[1].source, "sub/x.csv");
    EXPECT_EQ(study.files[2].source, "a.csv");
    ASSERT_EQ(study.files[1].selected.size(), 2U);
    EXPECT_EQ(study.files[1].selected[1].metadata, (Metadata{{"subject", "c"}}));
    EXPECT_EQ(study.files[1].metadata, (Metadata{{"site", "arm"}}));
}

TEST_F(StudyFiles, CubesHaveRegions) {
    const Study study = parsed(R"({"inputs": [{"cube": "hand.hdr", "mask": "mask.png", "rectangle": "1,2,30,40"}],
  "output": "out"})");
    ASSERT_EQ(study.cubes.size(), 1U);
    EXPECT_EQ(study.cubes[0].source, "hand.hdr");
    EXPECT_EQ(study.cubes[0].region.mask, in_folder("mask.png"));
    EXPECT_TRUE(study.cubes[0].region.rectangle.has_value());
}

TEST_F(StudyFiles, SettingsMayBeAFileOfTheirOwn) {
    write_file_atomically(in_folder("fit.json"), "{\"noise\": 0.007}");
    EXPECT_EQ(parsed(R"({"inputs": ["a.csv"], "fit": "fit.json", "output": "out"})").configuration.noise, 0.007);
}

TEST_F(StudyFiles, EveryCheckOfQualityMayBeAccepted) {
    for (const std::string_view name : quality_check_names) {
        const Json json = {{"inputs", {"a.csv"}}, {"accept", {name}}, {"output", "out"}};
        EXPECT_EQ(parsed(json.dump()).accept, Names{std::string(name)});
    }
}

}  // namespace
}  // namespace skinfit
