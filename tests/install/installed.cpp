#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/text.hpp"
#include "tests/cli/cli_test.hpp"
#include "tests/install/this_build.hpp"

namespace skinfit::test {
namespace {

const std::filesystem::path projects = SKINFIT_SOURCE_DIR "/tests/install";
const std::string specimen = "share/skinfit/measurements/data/ncsu_113.csv";

class Installed : public CliTest {
protected:
    [[nodiscard]] std::filesystem::path prefix() const { return folder() / "prefix"; }
    [[nodiscard]] std::string at(const std::string& path) const { return (prefix() / path).string(); }
    [[nodiscard]] Outcome run_installed(const std::vector<std::string>& arguments) const {
        std::vector<std::string> words = {at("bin/skinfit")};
        words.insert(words.end(), arguments.begin(), arguments.end());
        return run_words(words, folder());
    }
};

/// The line of a report that begins with `name`.
std::string row_of(std::string_view report, std::string_view name) {
    for (const std::string_view line : split_lines(report)) {
        if (trimmed(line).starts_with(name)) return std::string(trimmed(line));
    }
    return {};
}

/// The reflectance of the example's table, by wavelength, in the order of the melanosome fractions.
std::map<std::string, std::vector<double>> example_table(std::string_view text) {
    std::map<std::string, std::vector<double>> reflectance;
    for (const std::string_view line : split_lines(text)) {
        const std::vector<std::string_view> cells = split(line, ',');
        if (cells.size() == 3 && line.starts_with("0.")) {
            reflectance[std::string(cells[1])].push_back(std::stod(std::string(cells[2])));
        }
    }
    return reflectance;
}

TEST_F(Installed, TheProgramAloneFitsWhatIsInstalledWithIt) {
    const Outcome installed = install_build(prefix(), "program");
    ASSERT_EQ(installed.exit_code, 0) << installed.err;
    EXPECT_FALSE(std::filesystem::exists(prefix() / "include"));
    for (const std::string document :
         {"README.md", "CITATION.cff", "copyright", "docs/files.md", "model/REFERENCES.md"})
        EXPECT_TRUE(std::filesystem::exists(prefix() / "share/doc/skinfit" / document)) << document;

    const Outcome fitted =
        run_installed({"fit", at(specimen), "--config", at("share/skinfit/configs/fit_with_scale.json"), "--set",
                       "rays=2000", "--report", "fit.html"});
    EXPECT_LE(fitted.exit_code, 1) << fitted.err;
    EXPECT_NE(row_of(fitted.out, "scale"), "") << fitted.out;
    EXPECT_TRUE(std::filesystem::exists(folder() / "fit.html"));
#ifdef NDEBUG  // asserts name their source
    EXPECT_FALSE(names_this_build(at("bin/skinfit")));
#endif
}

TEST_F(Installed, TheExampleStudyRunsInACopy) {
    const Outcome installed = install_build(prefix(), "program");
    ASSERT_EQ(installed.exit_code, 0) << installed.err;
    std::filesystem::copy(prefix() / "share/skinfit", folder() / "copy", std::filesystem::copy_options::recursive);
    const Outcome studied = run_installed({"study", "run", "copy/configs/study_example.json"});
    EXPECT_EQ(studied.exit_code, 0) << studied.err;
    EXPECT_NE(studied.out.find("2 spectra: 0 pending, 2 fitted"), std::string::npos) << studied.out;
}

TEST_F(Installed, AnotherProjectFindsTheLibraries) {
    const Outcome installed = install_build(prefix());
    ASSERT_EQ(installed.exit_code, 0) << installed.err;
    for (const std::string header : {"fit/fit.hpp", "transport/skin_spectra.hpp"})
        EXPECT_TRUE(std::filesystem::exists(prefix() / "include/skinfit" / header)) << header;
    const std::filesystem::path build = folder() / "build";
    const Outcome built = build_project(projects / "headers", build, prefix());
    ASSERT_EQ(built.exit_code, 0) << built.out << built.err;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(prefix())) {
        const bool is_cmake = entry.path().extension() == ".cmake";
        EXPECT_FALSE(is_cmake && names_this_build(entry.path())) << entry.path();
    }

    const Outcome example = run_words({(build / "example/example").string(), at(specimen)}, folder());
    ASSERT_EQ(example.exit_code, 0) << example.err;
    const auto table = example_table(example.out);
    ASSERT_EQ(table.size(), 3U) << example.out;
    for (const auto& [wavelength, reflectance] : table) {
        ASSERT_EQ(reflectance.size(), 3U) << example.out;
        EXPECT_TRUE(std::ranges::is_sorted(reflectance, std::greater_equal<>()))
            << "more melanin is darker, " << wavelength;
        EXPECT_LT(reflectance.front(), 1.0);
        EXPECT_GT(reflectance.back(), 0.0);
    }
    const std::string row = row_of(example.out, "melanosome_fraction  ");
    EXPECT_NE(row, "") << example.out;
    EXPECT_EQ(row, row_of(run_installed({"fit", at(specimen)}).out, "melanosome_fraction  "));
}

TEST_F(Installed, AnotherVersionIsRefused) {
    const Outcome installed = install_build(prefix(), "development");
    ASSERT_EQ(installed.exit_code, 0) << installed.err;
    put("CMakeLists.txt",
        "cmake_minimum_required(VERSION 3.25)\nproject(other LANGUAGES CXX)\nfind_package(skinfit 99 REQUIRED)\n");
    const Outcome built = build_project(folder(), folder() / "build", prefix());
    EXPECT_NE(built.exit_code, 0);
    EXPECT_NE(built.err.find("compatible with requested version \"99\""), std::string::npos) << built.err;
}

}  // namespace
}  // namespace skinfit::test
