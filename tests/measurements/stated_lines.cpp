#include <gtest/gtest.h>

#include <cmath>

#include "measurements/file_statements.hpp"
#include "measurements/words.hpp"
#include "tests/support/refusal.hpp"

/// What single lines state, before any table is read.
namespace skinfit {
namespace {

FileStatements stated(std::string_view line) {
    const Comment comment{.line = 1, .text = line};
    return statements_in("a.csv", {}, std::span(&comment, 1));
}

TEST(KeyedLine, EndsItsKeyAtACommaOnlyWhereBothSidesAreShort) {
    EXPECT_EQ(keyed_line("Technique,Raman")->value, "Raman");
    EXPECT_EQ(keyed_line("Mode: SCI, 8 mm")->value, "SCI, 8 mm");
    EXPECT_FALSE(keyed_line("Spectra of skin as absorbance, measured by me"));
    EXPECT_FALSE(keyed_line("Skin, measured by me in May of that year"));
}

TEST(DeclaredFill, IsMissingWhereTheFileSaysSo) {
    EXPECT_EQ(stated("missing value: -1").fill, std::vector<double>{-1});
    EXPECT_EQ(stated("Missing value code: 0").fill, std::vector<double>{0});
    EXPECT_TRUE(stated("missing values: 3").fill.empty()) << "a count";
    std::vector<double> values{0.1, -1, -9999};
    EXPECT_EQ(take_out_fill_numbers(values, std::vector<double>{-1}), -1);
    EXPECT_TRUE(std::isnan(values[1]) && std::isnan(values[2]));
}

TEST(DeclaredScan, IsDoubtedWhereTheTableEndsElsewhere) {
    const std::vector<double> nm{400, 410, 420};
    for (const std::string_view line : {"Start wavelength: 300", "End wavelength: 800 nm", "Scan range: 400 - 800 nm",
                                        "Wavelength range: 300-420", "Data interval: 5 nm", "DELTAX\t5", "step: 1"}) {
        EXPECT_EQ(doubts_about_scans(stated(line).scans, nm).size(), 1U) << line;
    }
    for (const std::string_view line : {"Start wavelength: 420", "Start (nm),400", "Scan range: 395 - 425 nm",
                                        "Data interval: 10 nm", "DELTAX\t-10", "start: 10:05", "Step: 5 s"}) {
        EXPECT_TRUE(doubts_about_scans(stated(line).scans, nm).empty()) << line;
    }
}

TEST(DeclaredCount, MayBeThatOfTheSpectra) {
    const std::vector<double> nm{400, 410, 420};
    const auto refusal = [&](std::string_view line, std::size_t spectra) {
        return test::refusal_of([&] { check_declared("a.csv", stated(line).declared, nm, {}, spectra); });
    };
    EXPECT_NE(refusal("NPOINTS: 61", 1), "");
    EXPECT_NE(refusal("NPOINTS: 61", 2), "");
    EXPECT_NE(refusal("FIRSTX: 300", 2), "");
    EXPECT_EQ(refusal("NPOINTS: 3", 2), "");
    EXPECT_EQ(refusal("Number of points: 2", 2), "");
    EXPECT_EQ(refusal("Number of points: 6", 2), "");
    EXPECT_EQ(refusal("MAXY: 9", 2), "") << "of which spectrum is not said";
}

}  // namespace
}  // namespace skinfit
