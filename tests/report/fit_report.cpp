#include "report/fit_report.hpp"

#include <gtest/gtest.h>

#include "core/text.hpp"
#include "report/references.hpp"
#include "tests/fit/example_result.hpp"
#include "tests/report/tag_balance.hpp"

namespace skinfit {
namespace {

constexpr const char* hostile = "<b>\"arm\" & 'leg'</b>\xff";

std::string report_of(const FitResult& result) {
    return html_report(result, {.command_line = "skinfit fit 'a b.csv'"});
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(FitReport, IsWellFormedForEveryKindOfResult) {
    for (const FitResult& result :
         {test::example_result(), test::good_result(), test::sampled_result(), test::profiled_result()}) {
        EXPECT_EQ(test::tag_complaint(report_of(result)), "");
    }
}

TEST(FitReport, IsAFunctionOfItsInput) {
    EXPECT_EQ(report_of(test::example_result()), report_of(test::example_result()));
}

TEST(FitReport, EscapesWhatFilesSay) {
    FitResult result = test::good_result();
    result.spectra.front().name = hostile;
    result.spectra.front().source = hostile;
    result.reasons = {hostile};
    result.findings = {{.name = "spike", .spectrum = hostile, .message = hostile, .remedy = hostile}};
    const std::string report = report_of(result);
    EXPECT_EQ(test::tag_complaint(report), "");
    EXPECT_FALSE(holds(report, "<b>"));
    EXPECT_EQ(report.find('\xff'), std::string::npos);
}

TEST(FitReport, SaysTheVerdictBeforeTheFirstSection) {
    const std::string report = report_of(test::example_result());
    const std::size_t verdict = report.find("<span class=\"badge doubtful\">suspect</span>");
    ASSERT_NE(verdict, std::string::npos);
    EXPECT_LT(verdict, report.find("<h2"));
    EXPECT_TRUE(holds(report_of(test::good_result()), "<span class=\"badge good\">consistent</span>"));
    FitResult failed = test::good_result();
    failed.verdict = Verdict::failed;
    EXPECT_TRUE(holds(report_of(failed), "<span class=\"badge bad\">failed</span>"));
}

TEST(FitReport, SaysWhyASpectrumHasNoColour) {
    FitResult result = test::good_result();
    EXPECT_TRUE(holds(report_of(result), "CIEDE2000 between the two"));
    result.spectra.front().wavelength_nm = {450, 550, 700};
    EXPECT_TRUE(holds(report_of(result), "do not reach from 420 to 680 nm"));
    result.spectra.front().configuration.quantity = Quantity::transmittance;
    EXPECT_TRUE(holds(report_of(result), "it is a transmittance"));
}

TEST(FitReport, MarksWhatIsAtABoundOrNotIdentifiable) {
    const std::string report = report_of(test::example_result());
    for (const char* remark : {"AT UPPER BOUND", "NONE FOUND", "NOT IDENTIFIABLE", "WEAK"}) {
        EXPECT_TRUE(holds(report, remark)) << remark;
    }
    EXPECT_FALSE(holds(report_of(test::good_result()), "BOUND"));
}

TEST(FitReport, HasTheTissueAndSaysWhereTheModelSplitsIt) {
    const std::string report = report_of(test::split_result());
    EXPECT_TRUE(holds(report, "In the tissue"));
    EXPECT_TRUE(holds(report, "dermal_hemoglobin_umol_per_l"));
    EXPECT_TRUE(holds(report,
                      "SPLIT BY THE MODEL: papillary_blood_fraction and reticular_blood_fraction; the spectrum "
                      "does not say how the two share what it shows (correlation -0.72)"));
    EXPECT_FALSE(holds(report_of(test::good_result()), "SPLIT BY THE MODEL"));
}

TEST(FitReport, SaysWhereItComesFrom) {
    const FitResult result = test::good_result();
    const std::string by_command = report_of(result);
    EXPECT_TRUE(holds(by_command, "<dt>command</dt>"));
    EXPECT_FALSE(holds(by_command, "<dt>made by</dt>"));
    const std::string by_other = html_report(result, {.command_line = "", .other = "a page & <b>more</b>"});
    EXPECT_FALSE(holds(by_other, "<dt>command</dt>"));
    EXPECT_TRUE(holds(by_other, "<dt>made by</dt><dd>a page &amp; &lt;b&gt;more&lt;/b&gt;</dd>"));
}

TEST(FitReport, DrawsProfilesWhereThereAreSome) {
    EXPECT_TRUE(holds(report_of(test::profiled_result()), "<h3>Profiles</h3>"));
    EXPECT_FALSE(holds(report_of(test::example_result()), "<h3>Profiles</h3>"));
}

TEST(FitReport, SpellsOutWhatItCites) {
    const std::string report = report_of(test::example_result());
    for (const char* key : {"KA04", "PRAHL98", "SHARMA05", "CHARDON91"}) {
        EXPECT_TRUE(holds(report, "<dt>[" + std::string(key) + "]</dt>")) << key;
    }
}

TEST(References, AreThoseCitedInTheOrderOfTheList) {
    const std::string open = "[";
    const auto cited = cited_references(open + "PRAHL98] and " + open + "KA04, Eq. 3], not BRULS84");
    ASSERT_EQ(cited.size(), 2U);
    EXPECT_EQ(cited[0].first, "KA04");
    EXPECT_EQ(cited[1].first, "PRAHL98");
    EXPECT_TRUE(holds(cited[0].second, "doi:"));
    EXPECT_TRUE(cited_references("").empty());
}

}  // namespace
}  // namespace skinfit
