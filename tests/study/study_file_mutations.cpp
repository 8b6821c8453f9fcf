#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/utf8.hpp"
#include "study/manifest_reader.hpp"
#include "study/study.hpp"
#include "tests/support/mutants.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

constexpr std::string_view marks = "\n\r\t ,;#\":{}[]()*?\\x00\xff\xc3-e";

/// How many of so many mutants of `text`, each a few steps away, `read` takes and how many it refuses.
struct Outcome {
    int taken = 0;
    int refused = 0;
};

template <class Read>
Outcome of_mutants(const std::string& text, int mutants, const Read& read) {
    read(text);
    std::mt19937_64 random(7);
    Outcome outcome;
    for (int i = 0; i < mutants; ++i) {
        std::string mutant = text;
        for (int step = 0; step <= i % 3; ++step) mutant = test::mutated(mutant, marks, random);
        try {
            read(mutant);
            ++outcome.taken;
        } catch (const InputError&) {
            ++outcome.refused;
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what() << " of\n" << mutant;
        }
    }
    return outcome;
}

TEST(Manifest, EveryMutantIsReadOrRefused) {
    const std::string text =
        "\xEF\xBB\xBF# by hand\nfile,spectrum,subject,note\na.csv,1,s1,\"one, "
        "\"\"two\"\"\"\nb.csv,left,M\xc3\xbcller,\n";
    const Outcome outcome = of_mutants(text, 5000, [](const std::string& mutant) {
        for (const ManifestRow& row : parse_manifest(mutant, "m.csv")) {
            EXPECT_FALSE(row.file.empty());
            for (const auto& [name, word] : row.selected.metadata) EXPECT_TRUE(is_utf8(name) && is_utf8(word));
        }
    });
    EXPECT_GT(outcome.taken, 500);
    EXPECT_GT(outcome.refused, 500);
}

class StudyMutants : public test::TemporaryFolder {};

TEST_F(StudyMutants, EveryOneIsAStudyOrRefused) {
    write_file_atomically(in_folder("a.csv"), "x");
    write_file_atomically(in_folder("m.csv"), "file\nb.csv\n");
    const std::string text =
        R"({"name": "n", "inputs": ["a.*", {"manifest": "m.csv"}, {"files": "c.csv", "unit": "percent", "metadata":
{"age": 3}, "names": {"pattern": "^(s[0-9]+)_(.*)$", "fields": ["subject", "visit"]}}, {"cube": "h.hdr", "rectangle":
"1,2,30,40"}], "fit": {"noise": 0.004}, "accept": ["spikes"], "group_by": "site", "indicators": [{"name": "i",
"parameter": "bilirubin_g_per_l", "above": 0.1, "source": "x"}, {"name": "j", "index": "melanin_index", "below":
{"same": "subject", "where": {"site": "arm"}}, "source": "x"}], "assess": [{"indicator": "i", "label": "l",
"positive": "yes", "thresholds": [0.2]}, {"index": "melanin_index", "reference": "r"}], "output": "out"})";
    const Outcome outcome = of_mutants(text, 1000, [&](const std::string& mutant) {
        const Study study = parse_study(mutant, in_folder("study.json"));
        EXPECT_FALSE(study.files.empty() && study.cubes.empty());
        (void)metadata_json(study.files.empty() ? Metadata() : study.files.front().metadata).dump();
    });
    EXPECT_GT(outcome.taken, 10);
    EXPECT_GT(outcome.refused, 300);
}

}  // namespace
}  // namespace skinfit
