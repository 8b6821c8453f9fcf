#include "study/roster.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "core/file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

Spectrum example() {
    Spectrum spectrum;
    spectrum.name = "arm";
    spectrum.source = "a.csv";
    spectrum.wavelength_nm = {400, 500, 600};
    spectrum.value = {0.1, 0.2, 0.3};
    spectrum.sigma = {0.01, 0.01, 0.01};
    spectrum.unit_rule = "fraction: stated";
    spectrum.notes = {{.line = 1, .key = "edition", .value = "revised"}};
    spectrum.repeats = {{0.1, 0.2, 0.3}};
    return spectrum;
}

using Change = std::function<void(Spectrum&)>;

TEST(InputHash, ChangesWithEverythingThatAFitReads) {
    const std::vector<Change> changes = {[](Spectrum& s) { s.wavelength_nm[1] = 500.0000000001; },
                                         [](Spectrum& s) { s.value[2] = 0.30000000000000004; },
                                         [](Spectrum& s) { s.sigma[0] = 0.02; },
                                         [](Spectrum& s) { s.sigma.clear(); },
                                         [](Spectrum& s) { s.quantity = Quantity::reflectance; },
                                         [](Spectrum& s) { s.quantity = Quantity::transmittance; },
                                         [](Spectrum& s) { s.geometry.incidence_deg = 0; },
                                         [](Spectrum& s) { s.geometry.viewing_cone_deg = 0; },
                                         [](Spectrum& s) { s.geometry.specular = Specular::included; },
                                         [](Spectrum& s) { s.geometry.specular = Specular::excluded; },
                                         [](Spectrum& s) { s.instrument = "CM-2600d"; },
                                         [](Spectrum& s) { s.bandpass = Bandpass{.width_nm = 10}; },
                                         [](Spectrum& s) { s.bandpass = Bandpass{.width_nm = 5}; },
                                         [](Spectrum& s) { s.notes[0].key = "layers"; },
                                         [](Spectrum& s) { s.notes[0].value = "printed"; },
                                         [](Spectrum& s) { s.notes.clear(); },
                                         [](Spectrum& s) { s.repeats[0][1] = 0.21; },
                                         [](Spectrum& s) { s.repeats.clear(); },
                                         [](Spectrum& s) { s.unit_rule = "percent: stated"; },
                                         [](Spectrum& s) { s.sigma_source = "repeats"; },
                                         [](Spectrum& s) { s.missing_nm = {405}; }};
    std::map<std::string, std::size_t> hashes = {{input_hash_of(example()), changes.size()}};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Spectrum changed = example();
        changes[i](changed);
        const auto [other, is_new] = hashes.try_emplace(input_hash_of(changed), i);
        EXPECT_TRUE(is_new) << i << " like " << other->second;
    }
}

TEST(InputHash, HasNoPartInWhereASpectrumCameFrom) {
    const std::vector<Change> changes = {[](Spectrum& s) { s.name = "leg"; }, [](Spectrum& s) { s.source = "b.csv"; },
                                         [](Spectrum& s) { s.line = 7; }, [](Spectrum& s) { s.site = "arm"; },
                                         [](Spectrum& s) { s.notes[0].line = 9; }};
    for (const Change& change : changes) {
        Spectrum changed = example();
        change(changed);
        EXPECT_EQ(input_hash_of(changed), input_hash_of(example()));
    }
}

class Roster : public test::TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        write_file_atomically(in_folder("a.csv"),
                              "nm,s1_arm,s1_leg,other\n400,0.1,0.2,0.3\n500,0.2,0.3,0.4\n600,0.3,0.4,0.5\n");
    }
    [[nodiscard]] StudyFile file() const {
        return {.source = "a.csv",
                .path = in_folder("a.csv"),
                .unit = {},
                .reader = {},
                .metadata = {{"study", "x"}, {"subject", "of the file"}},
                .names = {},
                .selected = {}};
    }
    [[nodiscard]] StudyFile selecting(const std::vector<std::string>& spectra) const {
        StudyFile selecting = file();
        for (const std::string& spectrum : spectra) {
            selecting.selected.push_back({.spectrum = spectrum,
                                          .metadata = {{"subject", "of the line"}},
                                          .where = "m.csv:" + std::to_string(selecting.selected.size() + 2)});
        }
        return selecting;
    }
};

std::vector<std::string> names_of(const StudySpectra& read) {
    std::vector<std::string> names;
    for (const RosterEntry& entry : read.entries) names.push_back(entry.refusal ? entry.refusal->reason : entry.name);
    return names;
}

using Names = std::vector<std::string>;

TEST_F(Roster, HasEverySpectrumOfAFile) {
    const StudySpectra read = read_study_file(file());
    EXPECT_EQ(names_of(read), (Names{"s1_arm", "s1_leg", "other"}));
    ASSERT_EQ(read.spectra.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(read.entries[i].number, i + 1);
        EXPECT_EQ(read.entries[i].source, "a.csv");
        EXPECT_EQ(read.entries[i].input_hash, input_hash_of(read.spectra[i]));
        EXPECT_EQ(read.entries[i].metadata, file().metadata);
    }
}

TEST_F(Roster, NamesTellMetadataAndWhatIsLeftOut) {
    StudyFile named = file();
    named.names = NamePattern{.expression = "^(s[0-9]+)_(.+)$", .fields = {"subject", "site"}};
    const StudySpectra read = read_study_file(named);
    EXPECT_EQ(names_of(read), (Names{"s1_arm", "s1_leg"}));
    EXPECT_EQ(read.left_out, 1U);
    EXPECT_EQ(read.entries[1].number, 2U);
    EXPECT_EQ(read.entries[1].metadata, (Metadata{{"study", "x"}, {"subject", "s1"}, {"site", "leg"}}));
}

TEST_F(Roster, AManifestChoosesByNameOrNumber) {
    const StudySpectra read = read_study_file(selecting({"s1_leg", "1"}));
    EXPECT_EQ(names_of(read), (Names{"s1_leg", "s1_arm"}));
    EXPECT_EQ(read.entries[0].number, 2U);
    EXPECT_EQ(read.entries[1].number, 1U);
    EXPECT_EQ(read.entries[0].metadata, (Metadata{{"study", "x"}, {"subject", "of the line"}}));
    EXPECT_EQ(names_of(read_study_file(selecting({""}))), (Names{"s1_arm", "s1_leg", "other"}));
}

TEST_F(Roster, WhatAManifestNamesInVainIsAResult) {
    const StudySpectra read = read_study_file(selecting({"s1_leg", "none", "4", "0", "2", ""}));
    EXPECT_EQ(names_of(read), (Names{"s1_leg", "m.csv:3: \"none\" is no spectrum of a.csv; see `skinfit inspect`",
                                     "m.csv:4: \"4\" is no spectrum of a.csv; see `skinfit inspect`",
                                     "m.csv:5: \"0\" is no spectrum of a.csv; see `skinfit inspect`",
                                     "m.csv:6: \"2\" is named twice of a.csv; see `skinfit inspect`",
                                     "m.csv:7: names no spectrum (other lines are about a.csv too); name one"}));
    ASSERT_EQ(read.spectra.size(), read.entries.size());
    for (std::size_t i = 1; i < read.entries.size(); ++i) {
        EXPECT_EQ(read.entries[i].refusal->status, FitStatus::failed);
        EXPECT_EQ(read.entries[i].number, 0U);
        EXPECT_EQ(read.entries[i].metadata, (Metadata{{"study", "x"}, {"subject", "of the line"}}));
    }
}

TEST_F(Roster, AFileThatCannotBeReadIsOneFailure) {
    std::filesystem::remove(in_folder("a.csv"));
    const StudySpectra read = read_study_file(file());
    ASSERT_EQ(read.entries.size(), 1U);
    EXPECT_EQ(read.entries[0].refusal->status, FitStatus::failed);
    EXPECT_NE(read.entries[0].refusal->reason.find("No such file"), std::string::npos);
    const std::string hash = read.entries[0].input_hash;
    EXPECT_EQ(read_study_file(file()).entries[0].input_hash, hash);
    write_file_atomically(in_folder("a.csv"), std::string(10, '\0'));
    EXPECT_NE(read_study_file(file()).entries[0].input_hash, hash);
}

TEST_F(Roster, WordsThatAreNotUtf8AreToldApartByTheirBytes) {
    StudyFile named = file();
    named.names = NamePattern{.expression = "^(.+)$", .fields = {"subject"}};
    write_file_atomically(in_folder("a.csv"), "nm,M\xfcller,M\xf6ller\n400,0.1,0.2\n500,0.2,0.3\n600,0.3,0.4\n");
    const StudySpectra read = read_study_file(named);
    EXPECT_EQ(names_of(read), (Names{"M\\xfcller", "M\\xf6ller"}));
    EXPECT_EQ(word_of(read.entries[1].metadata, "subject"), "M\\xf6ller");
}

/// A backtracking engine takes 2^30 steps for this, or a stack frame for each letter.
TEST_F(Roster, NamesAreMatchedInLinearTime) {
    StudyFile named = file();
    named.names = NamePattern{.expression = "(a+)+b", .fields = {"subject"}};
    const std::string hard(30, 'a');
    const std::string long_name(200'000, 'c');
    write_file_atomically(in_folder("a.csv"),
                          "nm," + hard + "," + long_name + ",aab\n400,0.1,0.2,0.3\n500,0.2,0.3,0.4\n");
    EXPECT_EQ(names_of(read_study_file(named)), Names{"aab"});
    named.names = NamePattern{.expression = "(.*)", .fields = {"subject"}};
    const StudySpectra read = read_study_file(named);
    ASSERT_EQ(read.entries.size(), 3U);
    EXPECT_EQ(word_of(read.entries[1].metadata, "subject"), long_name);
}

TEST_F(Roster, WhatRepeatsTheValuesOfAnotherIsRejected) {
    std::map<std::string, std::string> seen;
    StudySpectra first = read_study_file(file());
    refuse_duplicates(first, seen);
    for (const RosterEntry& entry : first.entries) EXPECT_FALSE(entry.refusal);
    StudyFile copy = file();
    copy.source = "b.csv";
    StudySpectra second = read_study_file(copy);
    second.spectra[2].value[0] += 1e-12;
    refuse_duplicates(second, seen);
    EXPECT_EQ(second.entries[0].refusal->status, FitStatus::rejected);
    EXPECT_EQ(second.entries[0].refusal->reason, "duplicate: has the same values as a.csv s1_arm");
    EXPECT_NE(second.entries[0].input_hash, first.entries[0].input_hash) << "what it repeats is part of its input";
    EXPECT_TRUE(second.entries[1].refusal);
    EXPECT_FALSE(second.entries[2].refusal);
}

TEST_F(Roster, TwoReadingsMayAgreeByChance) {
    write_file_atomically(in_folder("a.csv"), "nm,left,right\n400,0.1,0.1\n500,0.2,0.2\n");
    std::map<std::string, std::string> seen;
    StudySpectra read = read_study_file(file());
    ASSERT_EQ(read.entries.size(), 2U);
    refuse_duplicates(read, seen);
    EXPECT_FALSE(read.entries[1].refusal);
}

}  // namespace
}  // namespace skinfit
