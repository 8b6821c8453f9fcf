#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/file.hpp"
#include "study/study.hpp"
#include "tests/study/example_ledger.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

struct Refused {
    std::string text;  ///< of a study, or of some of its names
    std::string said;  ///< behind the name of the file
};

class StudyRefusals : public test::TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        write_file_atomically(in_folder("a.csv"), "x");
        write_file_atomically(in_folder("m.csv"), "file\na.csv\n");
    }
    void expect(const std::vector<Refused>& refused, const std::string& frame) const {
        const std::filesystem::path path = in_folder("study.json");
        for (const auto& [text, said] : refused) {
            const std::string whole = fmt::format(fmt::runtime(frame), text);
            const std::string found = test::refusal_of([&] { (void)parse_study(whole, path); });
            std::string shown = found;
            const std::string folder = path.parent_path().string() + "/";
            for (std::size_t at = shown.find(folder); at != std::string::npos; at = shown.find(folder)) {
                shown.erase(at, folder.size());
            }
            EXPECT_EQ(shown, said) << whole;
        }
    }
};

const std::string example = "; configs/study_example.json, which comes with skinfit, is an example";

TEST_F(StudyRefusals, OfWhatIsNoStudy) {
    expect({{"{", "study.json:1: is no JSON (unexpected end of input); correct this line" + example},
            {"[]", "study.json: [] is no object (keys and values are needed here)" + example},
            {"{}", "study.json: no \"inputs\" (a study cannot do without it)" + example},
            {R"({"inputs": ["a.csv"]})", "study.json: no \"output\" (a study cannot do without it)" + example},
            {R"({"inputs": ["a.csv"], "output": ""})",
             "study.json.output: \"\" cannot be used (a word is needed); write it between double quotes"},
            {R"({"input": ["a.csv"], "output": "out"})",
             R"(study.json: unknown name "input" (it would have no effect); did you mean "inputs"?)"},
            {R"({"inputs": ["a.csv"], "output": "out", "output": "o"})",
             "study.json: gives \"output\" twice (only one of them could hold); keep one of the two"}},
           "{}");
}

TEST_F(StudyRefusals, OfInputs) {
    const std::string list = " cannot be used (a list of files is needed)" + example;
    expect(
        {{"[]", "study.json.inputs: []" + list},
         {"\"a.csv\"", "study.json.inputs: \"a.csv\"" + list},
         {"[7]", "study.json.inputs[0]: 7 is no object (keys and values are needed here)" + example},
         {"[{}]", R"(study.json.inputs[0]: {} cannot be used (it names no "files", "manifest" or "cube"))" + example},
         {"[\"no*.csv\"]",
          "study.json.inputs[0].files: no file matches no*.csv (the study would lack its spectra); correct the "
          "pattern, or name the folder of the data with --data"},
         {R"(["a.csv", "?.csv"])",
          "study.json.inputs: name a.csv twice (its spectra would count twice); leave it out of one of them"},
         {R"(["a.csv", {"manifest": "m.csv"}])",
          "study.json.inputs: name a.csv twice (its spectra would count twice); leave it out of one of them"},
         {R"([{"manifest": "none.csv"}])",
          "none.csv: cannot be read (No such file or directory); check the name and the permission "
          "to read it"},
         {R"([{"files": []}])", "study.json.inputs[0].files: [] cannot be used (it names no file)" + example},
         {R"([{"files": "a.csv", "units": "percent"}])",
          R"(study.json.inputs[0]: unknown name "units" (it would have no effect); did you mean "unit"?)"},
         {R"([{"files": "a.csv", "manifest": "m.csv"}])",
          "study.json.inputs[0]: {\"files\":\"a.csv\",\"manifest\":\"m.csv\"} cannot be used (it is two kinds of "
          "input); make an input of each"},
         {R"([{"files": "a.csv", "subject": "s"}])",
          "study.json.inputs[0]: unknown name \"subject\" (it would have no effect)" + example},
         {R"([{"files": "a.csv", "metadata": {"site": ["arm"]}}])",
          "study.json.inputs[0].metadata.site: [\"arm\"] cannot be used (a word or a number is needed)" + example},
         {R"([{"files": "a.csv", "metadata": "arm"}])",
          "study.json.inputs[0].metadata: \"arm\" is no object (keys and values are needed here)" + example}},
        R"({{"inputs": {}, "output": "out"}})");
}

TEST_F(StudyRefusals, OfPatternsOfNames) {
    expect(
        {{R"({"pattern": "(a", "fields": ["s"]})",
          "study.json.inputs[0].names.pattern: \"(a\" cannot be used (missing ): (a); write a regular expression "
          "of RE2, which has no look-ahead and no back-references"},
         {R"x({"pattern": "(a)\\1", "fields": ["s"]})x",
          R"x(study.json.inputs[0].names.pattern: "(a)\\1" cannot be used (invalid escape sequence: \1); write a regular )x"
          "expression of RE2, which has no look-ahead and no back-references"},
         {R"x({"pattern": "(a)(b)", "fields": ["s"]})x",
          "study.json.inputs[0].names.fields: [\"s\"] cannot be used (the pattern has 2 groups); name each group "
          "once"},
         {R"x({"pattern": "(a)(b)", "fields": ["s", "s"]})x",
          "study.json.inputs[0].names.fields: \"s\" cannot be used (another group has it); give each a name of its "
          "own"},
         {R"x({"pattern": "(a)"})x", "study.json.inputs[0].names: no \"fields\" (names are read by both)" + example}},
        R"({{"inputs": [{{"files": "a.csv", "names": {}}}], "output": "out"}})");
}

TEST_F(StudyRefusals, OfSettings) {
    expect(
        {{R"("accept": ["spike"])",
          R"(study.json.accept: unknown name "spike" (it would have no effect); did you mean "spikes"?)"},
         {R"("accept": [1])", "study.json.accept: 1 cannot be used (a word is needed); write it between double quotes"},
         {R"("group_by": [""])",
          "study.json.group_by: \"\" cannot be used (a word is needed); write it between double quotes"},
         {R"("fit": {"nois": 0.1})",
          R"(study.json.fit: unknown name "nois" (it would have no effect); did you mean "noise"?)"},
         {R"("fit": {"instrument": "ncsu_45_0"}, "instrument": "ideal")",
          "study.json.instrument: is given by \"fit\" too (only one of them could hold); keep one of the two"}},
        R"({{"inputs": ["a.csv"], {}, "output": "out"}})");
}

TEST_F(StudyRefusals, OfIndicators) {
    expect({{R"({"name": "i", "parameter": "oxygen_saturation", "above": 0.5})",
             "study.json.indicators[0]: no \"source\" (a reader must see what is asked, and why there)" + example},
            {R"({"name": "i", "parameter": "oxygen_saturation", "above": 0.5, "below": 0.4, "source": "x"})",
             "study.json.indicators[0]: {\"name\":\"i\",\"parameter\":\"oxygen_saturation\",\"above\":0.5,\"bel... "
             "cannot be "
             "used (either \"above\" or \"below\" is needed); give one of the two"},
            {R"({"name": "i", "parameter": "bilirubin", "above": 0.5, "source": "x"})",
             "study.json.indicators[0].parameter: unknown name \"bilirubin\" (it would have no effect); did you mean "
             "\"bilirubin_g_per_l\"?"},
            {R"({"name": "i", "index": "melanin", "above": 0.5, "source": "x"})",
             "study.json.indicators[0].index: unknown name \"melanin\" (it would have no effect); did you mean "
             "\"melanin_index\"?"},
            {R"({"name": "i", "index": "melanin_index", "parameter": "a", "above": 0.5, "source": "x"})",
             "study.json.indicators[0]: {\"name\":\"i\",\"index\":\"melanin_index\",\"parameter\":\"a\",\"above\":... "
             "cannot be "
             "used (either \"parameter\" or \"index\" is needed); give one of the two"},
            {R"({"name": "i", "parameter": "oxygen_saturation", "above": 1.5, "source": "x"})",
             "study.json.indicators[0].above: 1.5 cannot be used (out of range); give a number from 0 to 1"},
            {R"({"name": "i", "parameter": "oxygen_saturation", "below": "low", "source": "x"})",
             "study.json.indicators[0].below: \"low\" cannot be used (a number is needed); give a number from 0 to 1"},
            {R"({"name": "i", "parameter": "oxygen_saturation", "above": 0.5, "source": "x", "prevalence": 1})",
             "study.json.indicators[0].prevalence: 1 cannot be used (out of range); give a number from 1e-06 to "
             "0.999999"},
            {R"({"name": "i", "index": "melanin_index", "above": 40, "source": "x", "prevalence": 0.5})",
             "study.json.indicators[0].prevalence: 0.5 cannot be used (it takes the place of what a prior says of a "
             "threshold; here is none); leave it out, or ask about a parameter of the skin above or below a number"},
            {R"({"name": "i", "parameter": "tissue_bilirubin_mg_per_dl", "above": -1, "source": "x"})",
             "study.json.indicators[0].above: -1 cannot be used (out of range); give a number from 0 to 1000000"},
            {R"({"name": "i", "index": "melanin_index", "above": {"same": "subject"}, "source": "x"})",
             "study.json.indicators[0].above: no \"where\" (a reference needs both)" + example},
            {R"({"name": "i", "index": "melanin_index", "above": {"same": "subject", "where": {}}, "source": "x"})",
             "study.json.indicators[0].above.where: {} cannot be used (it chooses nothing)" + example},
            {R"({"name": "i", "index": "melanin_index", "above": 1, "source": "x"},
             {"name": "i", "index": "erythema_index", "above": 1, "source": "x"})",
             "study.json.indicators[1].name: \"i\" cannot be used (another indicator has it); give each a name of its "
             "own"}},
           R"({{"inputs": ["a.csv"], "indicators": [{}], "output": "out"}})");
}

TEST_F(StudyRefusals, OfAssessments) {
    expect({{R"({"indicator": "j", "label": "l", "positive": "yes"})",
             "study.json.assess[0].indicator: unknown name \"j\" (it would have no effect); give one of i"},
            {R"({"indicator": "i", "label": "l"})",
             "study.json.assess[0]: no \"positive\" (an indicator is compared with a label)" + example},
            {R"({"indicator": "i", "label": "l", "positive": "yes", "thresholds": [2]})",
             "study.json.assess[0].thresholds: 2 cannot be used (out of range); give a number from 0 to 1"},
            {R"({"parameter": "oxygen_saturation"})",
             "study.json.assess[0]: no \"reference\" (estimates are compared with numbers)" + example}},
           R"({{"inputs": ["a.csv"], "indicators": [{{"name": "i", "index": "melanin_index", "above": 1,
  "source": "x"}}], "assess": [{}], "output": "out"}})");
    expect({{"", "study.json.assess[0].indicator: \"i\" cannot be used (the study has no indicators)" + example}},
           R"({{"inputs": ["a.csv"], {} "assess": [{{"indicator": "i", "label": "l", "positive": "yes"}}],
  "output": "out"}})");
}

}  // namespace
}  // namespace skinfit
