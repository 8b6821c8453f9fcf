#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "fit/configuration_json.hpp"
#include "fit/problem.hpp"
#include "tests/fit/synthetic.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit::test {
namespace {

Spectrum any_spectrum() {
    Spectrum spectrum{.name = "any",
                      .source = "any.csv",
                      .wavelength_nm = grid_nm(400, 700, 10),
                      .value = {},
                      .sigma = {},
                      .quantity = {},
                      .geometry = {},
                      .unit_rule = ""};
    for (std::size_t i = 0; i < spectrum.wavelength_nm.size(); ++i) {
        spectrum.value.push_back(0.2 + 0.01 * static_cast<double>(i));
    }
    return spectrum;
}

std::string refusal(const Configuration& configuration) {
    const Spectrum spectrum = any_spectrum();
    return refusal_of([&] { (void)make_problem(configuration, spectrum); });
}

/// `configuration` changed as one of the ways out of a refusal says.
Configuration followed(Configuration configuration, const std::string& complaint, const std::string& way) {
    static const std::regex assignment(R"(set (\w+=[\w.]+))");
    static const std::regex fixed(R"(--fix (\w+))");
    static const std::regex named(R"(free parameter (\w+)|set (\w+)=0 and fix it)");
    std::smatch found;
    if (std::regex_search(way, found, assignment))
        configuration = configured_by_assignment(configuration, found.str(1));
    if (std::regex_search(way, found, fixed)) return with_freedom(configuration, found.str(1), false, "--fix");
    if (way.find("fix it") != std::string::npos && std::regex_search(complaint, found, named)) {
        return with_freedom(configuration, found[1].matched ? found.str(1) : found.str(2), false, "--fix");
    }
    if (way.find("leave it out") != std::string::npos) configuration.viewing_cone_deg.reset();
    return configuration;
}

std::vector<std::string> ways_out(const std::string& complaint) {
    std::string remedy = complaint.substr(complaint.rfind("; ") + 2);
    std::vector<std::string> ways;
    for (std::size_t at = remedy.find(", or "); at != std::string::npos; at = remedy.find(", or ")) {
        ways.push_back(remedy.substr(0, at));
        // Behind the "or" a setting stands without "set".
        remedy = (ways.back().starts_with("set ") && remedy.substr(at + 5).find('=') < 12 ? "set " : "") +
                 remedy.substr(at + 5);
    }
    ways.push_back(remedy);
    return ways;
}

/// Whether every way that messages name leads on, without coming back; else says which does not.
std::string dead_end(const Configuration& configuration, std::set<std::string> seen) {
    const std::string complaint = refusal(configuration);
    if (complaint.empty()) return "";
    if (!seen.insert(to_json(configuration).dump()).second) return "advice goes in a circle: " + complaint;
    for (const std::string& way : ways_out(complaint)) {
        const std::string end = dead_end(followed(configuration, complaint, way), seen);
        if (!end.empty()) return complaint + "\n" + end;
    }
    return "";
}

TEST(Advice, LeadsOutOfEveryRefusalOfSettingsAndFreeParameters) {
    std::size_t refused = 0;
    for (const std::string_view engine : engine_names) {
        for (const std::string settings :
             {"{}", R"({"layers": 2})", R"({"quantity": "transmittance"})", R"({"specular": "excluded"})",
              R"({"specular": "included", "viewing_cone_deg": 5})", R"({"viewing_cone_deg": 5})",
              R"({"viewing_cone_deg": 5, "quantity": "transmittance"})",
              R"({"viewing_cone_deg": 5, "parameters": {"specular_fraction": 0.5}})"}) {
            Configuration configuration = configured_by_text(default_configuration(), settings, "c.json");
            configuration = configured_by_word(configuration, "engine", engine, "engine");
            for (const ParameterInfo& row : parameter_table()) {
                const Configuration freed = with_freedom(configuration, row.name, true, "--free");
                if (!refusal(freed).empty()) ++refused;
                EXPECT_EQ(dead_end(freed, {}), "") << engine << " " << settings << " " << row.name;
            }
        }
    }
    EXPECT_GT(refused, 300U);
}

TEST(Advice, WhatHasNoEffectIsNotRecommendedToAnotherEngine) {
    for (const std::string_view engine : engine_names) {
        if (engine == "walk") continue;
        const Configuration configuration = configured_by_word(default_configuration(), "engine", engine, "engine");
        EXPECT_NE(refusal(with_freedom(configuration, "fold_aspect_ratio", true, "--free")).find("has no effect"),
                  std::string::npos);
    }
}

}  // namespace
}  // namespace skinfit::test
