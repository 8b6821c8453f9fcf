#include "study/manifest_reader.hpp"

#include <gtest/gtest.h>

#include "tests/study/example_ledger.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit {
namespace {

std::string complaint(std::string_view text) {
    return test::refusal_of([&] { (void)parse_manifest(text, "m.csv"); });
}

/// The table that all of `tables` mean.
void expect_same_rows(const std::vector<std::string>& tables) {
    const std::vector<ManifestRow> first = parse_manifest(tables.front(), "m.csv");
    for (const std::string& table : tables) {
        const std::vector<ManifestRow> rows = parse_manifest(table, "m.csv");
        ASSERT_EQ(rows.size(), first.size()) << table;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_EQ(rows[i].file, first[i].file) << table;
            EXPECT_EQ(rows[i].selected.spectrum, first[i].selected.spectrum) << table;
            EXPECT_EQ(rows[i].selected.metadata, first[i].selected.metadata) << table;
        }
    }
}

TEST(Manifest, NamesFilesSpectraAndMetadata) {
    const std::vector<ManifestRow> rows =
        parse_manifest("subject,file,spectrum,site\ns1,a.csv,left,arm\ns2,b.csv,,\n", "m.csv");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].file, "a.csv");
    EXPECT_EQ(rows[0].selected.spectrum, "left");
    EXPECT_EQ(rows[0].selected.metadata, (Metadata{{"subject", "s1"}, {"site", "arm"}}));
    EXPECT_EQ(rows[0].selected.where, "m.csv:2");
    EXPECT_EQ(rows[1].selected.spectrum, "");
    EXPECT_EQ(rows[1].selected.metadata, (Metadata{{"subject", "s2"}, {"site", ""}}));
    EXPECT_EQ(rows[1].selected.where, "m.csv:3");
}

TEST(Manifest, IsTheSameInAllItsDresses) {
    expect_same_rows({"file,subject\na.csv,x\nb.csv,y\n", "file,subject\r\na.csv,x\r\nb.csv,y\r\n",
                      "file,subject\ra.csv,x\rb.csv,y",
                      "\xEF\xBB\xBF"
                      "file,subject\na.csv,x\nb.csv,y\n",
                      "file;subject\na.csv;x\nb.csv;y\n", "file\tsubject\na.csv\tx\nb.csv\ty\n",
                      "# made by hand\n\nfile,subject\n\na.csv,x\n  # not c.csv,z\nb.csv,y\n\n",
                      " file , \"subject\" \n\"a.csv\", x\nb.csv,\"y\"\n",
                      "\"file\",\"subject\"\n\"1\",\"a.csv\",\"x\"\n\"2\",\"b.csv\",\"y\"\n",
                      ",file,subject\n0,a.csv,x\n7,b.csv,y\n", "sep=;\nFile;subject\na.csv;x\nb.csv;y\n"});
}

TEST(Manifest, QuotedCellsHoldSeparatorsAndQuotes) {
    const std::vector<ManifestRow> rows =
        parse_manifest("file,note\n\"a, b.csv\",\"says \"\"no\"\"; never\"\n", "m.csv");
    EXPECT_EQ(rows.at(0).file, "a, b.csv");
    EXPECT_EQ(rows.at(0).selected.metadata, (Metadata{{"note", "says \"no\"; never"}}));
    EXPECT_EQ(parse_manifest("\"a,b,c\";file\nx;a.csv\n", "m.csv").at(0).file,
              "a.csv");  // what is quoted parts nothing
    EXPECT_EQ(parse_manifest("file\na.csv\n", "m.csv").at(0).file, "a.csv");
}

TEST(Manifest, KeepsWordsOfAllLanguages) {
    EXPECT_EQ(parse_manifest("file,subject\na.csv,M\xc3\xbcller\n", "m.csv").at(0).selected.metadata[0].second,
              "M\xc3\xbcller");
}

TEST(Manifest, RefusesWhatItCannotMean) {
    const std::string remedy = R"(; a manifest has a header with a column "file", perhaps "spectrum", and metadata)";
    const std::vector<std::pair<std::string, std::string>> table = {
        {"", "m.csv: lists no spectrum (it has no line below the header)" + remedy},
        {"# only a comment\n", "m.csv: lists no spectrum (it has no line below the header)" + remedy},
        {"file,subject\n", "m.csv: lists no spectrum (it has no line below the header)" + remedy},
        {"\nname,subject\na,b\n", "m.csv:2: has no column \"file\" (nothing says where the spectra are)" + remedy},
        {"file,a,a\nx,1,2\n", "m.csv:1: names \"a\" twice (only one could be meant)" + remedy},
        {"file,,a\nx,1,2\n", "m.csv:1: column 2 has no name (it says nothing)" + remedy},
        {"file,a,\nx,1,2\n", "m.csv:1: column 3 has no name (it says nothing)" + remedy},
        {"file,a\nx,1\ny\n", "m.csv:3: has 1 cell (the header names 2 columns)" + remedy},
        {"file,a\nx,1,2\n", "m.csv:2: has 3 cells (the header names 2 columns)" + remedy},
        {"file,a\n,1\n", "m.csv:2: names no file (nothing can be read)" + remedy},
        {"file,a\nx,M\xfcller\n",
         "m.csv:2: is not UTF-8 (words of other encodings cannot be told apart); export the table as CSV in UTF-8"},
        {std::string("file,a\nx,\0\n", 11),
         "m.csv:2: holds the control byte 0x00 (plain text is needed; this is a binary, spreadsheet or UTF-16 file); "
         "export it as plain text or CSV in UTF-8"}};
    for (const auto& [text, said] : table) EXPECT_EQ(complaint(text), said);
    for (const std::string column :
         {"unit", "quantity", "specular", "incidence_deg", "sigma", "exclude_nm", "reader"}) {
        EXPECT_NE(complaint("file," + column + "\nx,1\n").find("would not change"), std::string::npos) << column;
    }
    EXPECT_EQ(complaint("file,a\nx,1\n"), "");
}

}  // namespace
}  // namespace skinfit
