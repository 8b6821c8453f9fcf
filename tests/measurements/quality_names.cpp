#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "core/file.hpp"
#include "measurements/quality_checks.hpp"

namespace skinfit {
namespace {

/// The first group of all matches in the sources of the checks.
std::set<std::string> found_in(const std::vector<std::string>& files, const std::string& expression) {
    const std::regex pattern(expression);
    std::set<std::string> found;
    for (const std::string& file : files) {
        const std::string text = read_file(std::filesystem::path(SKINFIT_SOURCE_DIR) / "measurements" / file);
        for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
            found.insert((*match)[1].str());
        }
    }
    return found;
}

TEST(QualityNames, AreThoseOfAllFindings) {
    const std::set<std::string> names(quality_check_names.begin(), quality_check_names.end());
    EXPECT_EQ(names.size(), quality_check_names.size());
    EXPECT_EQ(found_in({"quality_values.cpp", "quality_shape.cpp", "quality_sets.cpp"},
                       R"re((?:\.name = |falls\(spectrum, )"(\w+)")re"),
              names);
}

TEST(QualityNames, AreThoseThatTheChecksAreExplainedUnder) {
    EXPECT_EQ(found_in({"quality_checks.hpp"}, R"re(/// `(\w+)`[:,])re"),
              std::set<std::string>(quality_check_names.begin(), quality_check_names.end()));
}

}  // namespace
}  // namespace skinfit
