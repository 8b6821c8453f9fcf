#include <cmath>
#include <optional>

#include "core/json.hpp"
#include "core/text.hpp"
#include "tests/cli/cli_test.hpp"
#include "tests/report/tag_balance.hpp"

namespace skinfit::test {
namespace {

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// What stands between the first `open` of `text` and the next `close`.
std::string between(const std::string& text, const std::string& open, const std::string& close) {
    const std::size_t at = text.find(open);
    if (at == std::string::npos) return {};
    const std::size_t begin = at + open.size();
    return text.substr(begin, text.find(close, begin) - begin);
}

std::string unescaped(std::string text) {
    const std::vector<std::pair<std::string, std::string>> references = {
        {"&quot;", "\""}, {"&#39;", "'"}, {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}};
    for (const auto& [reference, character] : references) {
        for (std::size_t at = text.find(reference); at != std::string::npos; at = text.find(reference, at + 1)) {
            text.replace(at, reference.size(), character);
        }
    }
    return text;
}

class ReportRuns : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        const Outcome simulated =
            run({"simulate", "--set", "wavelengths=400:700:20", "--set", "rays=1000", "--out", "skin.csv"});
        ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
    }

    [[nodiscard]] Outcome fit(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments = {"fit", "skin.csv", "--column", "reflectance", "--set", "rays=1000"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    [[nodiscard]] std::string page() const { return read_file(folder() / "fit.html"); }
};

TEST_F(ReportRuns, TheReportIsOneFileThatNeedsNoOther) {
    ASSERT_LE(fit({"--report", "fit.html"}).exit_code, 1);
    const std::string text = page();
    EXPECT_EQ(tag_complaint(text), "");
    EXPECT_LT(text.size(), 2'000'000U);
    for (const char* title : {"Spectrum", "Parameters", "How sure", "Colour", "Where the light goes",
                              "Quality of the data", "Searches", "Provenance", "References"}) {
        EXPECT_TRUE(holds(text, ">" + std::string(title) + "</h2>")) << title;
    }
    for (const char* never : {"<script", "<link", "<iframe", "@import", "url(", "src=\"http", "href=\"http"}) {
        EXPECT_FALSE(holds(text, never)) << never;
    }
    const std::string before_references = text.substr(0, text.find("id=\"references\""));
    EXPECT_FALSE(holds(before_references, "http:")) << "an address outside the text of references";
    EXPECT_FALSE(holds(before_references, "https:")) << "an address outside the text of references";
    EXPECT_TRUE(holds(text, "fit skin.csv --column reflectance --set rays=1000 --report fit.html</code>"));
}

TEST_F(ReportRuns, TheReportHoldsTheReportForPrograms) {
    const Outcome outcome = fit({"--report", "fit.html", "--format", "json"});
    const std::string json = unescaped(between(page(), "Result and configuration as JSON</summary>", "</code>"));
    ASSERT_TRUE(holds(json, "{"));
    EXPECT_EQ(Json::parse(json.substr(json.find('{'))), Json::parse(outcome.out));
}

/// The cells of the row of the table that `name` heads.
std::vector<std::string> row_of(const std::string& text, const std::string& name) {
    const std::string row = between(text, "<th scope=\"row\">" + name + "</th>", "</tr>");
    std::vector<std::string> cells;
    for (std::size_t at = row.find("<td"); at != std::string::npos; at = row.find("<td", at + 1)) {
        const std::size_t begin = row.find('>', at) + 1;
        cells.push_back(row.substr(begin, row.find("</td>", begin) - begin));
    }
    return cells;
}

/// Whether `cell` is `value`, to the digits that it prints.
bool is_rounded(const std::string& cell, double value) {
    const std::optional<double> printed = parse_number(cell);
    if (!printed) return false;
    const std::size_t point = cell.find('.');
    const double unit =
        point == std::string::npos ? 1.0 : std::pow(10.0, -static_cast<double>(cell.size() - point - 1));
    return std::abs(*printed - value) <= 0.5 * unit * (1.0 + 1e-9);
}

TEST_F(ReportRuns, TheTableOfParametersSaysWhatTheReportForProgramsSays) {
    const Json json = Json::parse(fit({"--report", "fit.html", "--format", "json", "--set", "noise=0.003"}).out);
    int rows = 0;
    for (const auto& [name, parameter] : json["parameters"].items()) {
        if (parameter["status"] != "free") continue;
        const std::vector<std::string> cells = row_of(page(), name);
        ASSERT_GE(cells.size(), 3U) << name;
        const std::string& interval = cells[2];
        const std::size_t to = interval.find(" to ");
        ASSERT_NE(to, std::string::npos) << interval;
        EXPECT_TRUE(is_rounded(cells[0], parameter["value"])) << name << " " << cells[0];
        EXPECT_TRUE(is_rounded(cells[1], parameter["sigma"])) << name << " " << cells[1];
        EXPECT_TRUE(is_rounded(interval.substr(0, to), parameter["interval_95"][0])) << name << " " << interval;
        EXPECT_TRUE(is_rounded(interval.substr(to + 4), parameter["interval_95"][1])) << name << " " << interval;
        EXPECT_FALSE(is_rounded(cells[0], parameter["value"].get<double>() + parameter["sigma"].get<double>()));
        ++rows;
    }
    EXPECT_GT(rows, 0);
}

TEST_F(ReportRuns, SeveralSpectraAreReportedTogether) {
    ASSERT_EQ(run({"simulate", "--set", "wavelengths=400:700:20", "--set", "rays=1000", "--set", "base=matched",
                   "--out", "ear.csv"})
                  .exit_code,
              0);
    const Outcome outcome =
        run({"fit", "ear.csv", "--column", "reflectance", "--column", "transmittance", "--set", "rays=1000", "--set",
             "base=matched", "--own", "oxygen_saturation", "--report", "fit.html", "--plot", "fit.svg"});
    ASSERT_LE(outcome.exit_code, 1) << outcome.err;
    const std::string text = page();
    EXPECT_EQ(tag_complaint(text), "");
    for (const char* part : {">Spectra</h2>", "Each spectrum&#39;s part of the misfit", "oxygen_saturation[2]",
                             "it is a transmittance", R"(<th scope="col" class="number">transmitted</th>)"}) {
        EXPECT_TRUE(holds(text, part)) << part;
    }
}

TEST_F(ReportRuns, APosteriorIsDrawn) {
    ASSERT_LE(fit({"--report", "fit.html", "--uncertainty", "posterior"}).exit_code, 1);
    EXPECT_TRUE(holds(page(), "Histograms of the posterior"));
    EXPECT_LT(page().size(), 2'000'000U);
}

TEST_F(ReportRuns, ThePlotIsOfTheKindItsNameSays) {
    ASSERT_LE(fit({"--plot", "fit.svg"}).exit_code, 1);
    EXPECT_TRUE(holds(read_file(folder() / "fit.svg"), "<svg"));
    ASSERT_LE(fit({"--plot", "fit.png"}).exit_code, 1);
    EXPECT_TRUE(read_file(folder() / "fit.png").starts_with("\x89PNG"));
    ASSERT_LE(fit({"--plot", "fit.pdf"}).exit_code, 1);
    EXPECT_TRUE(read_file(folder() / "fit.pdf").starts_with("%PDF"));
}

TEST_F(ReportRuns, WhatCannotBeWrittenIsRefusedBeforeTheFit) {
    const std::string before = read_file(folder() / "skin.csv");
    const std::vector<std::pair<std::vector<std::string>, std::string>> refusals = {
        {{"--report", "skin.csv"}, "is a file that is read"},
        {{"--report", "absent/fit.html"}, "cannot be written"},
        {{"--report", "a.html", "--out", "a.html"}, "is the file of --out too"},
        {{"--plot", "a.svg", "--report", "./a.svg"}, "is the file of --report too"},
        {{"--plot", "fit.gif"}, "unknown suffix"},
        {{"--plot", "absent/fit.svg"}, "cannot be written"},
    };
    for (const auto& [options, problem] : refusals) {
        const Outcome outcome = fit(options);
        EXPECT_EQ(outcome.exit_code, 2) << problem;
        EXPECT_TRUE(holds(outcome.err, problem)) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
    EXPECT_EQ(read_file(folder() / "skin.csv"), before);
    EXPECT_FALSE(std::filesystem::exists(folder() / "a.html"));
}

}  // namespace
}  // namespace skinfit::test
