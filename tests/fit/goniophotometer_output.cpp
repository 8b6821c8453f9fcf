#include "fit/goniophotometer_output.hpp"

#include <gtest/gtest.h>

#include "core/file.hpp"
#include "core/text.hpp"
#include "tests/support/reference_spectrum.hpp"

namespace skinfit {
namespace {

GoniophotometerRun example(const Base& base) {
    GoniophotometerRun run;
    run.configuration = default_configuration();
    run.configuration.base = base;
    run.configuration.rays = 2000;
    run.wavelengths_nm = {450, 600};
    run.spectrum.weights = {1, 2};
    run.spectrum.counts =
        goniophotometer({.skin = {}, .base = base}, run.wavelengths_nm, {.incidence = {}, .rays = 2000, .bins = {}});
    return run;
}

/// The first four fields of each row of values: kind, bin and azimuth; the column names are the first row.
std::vector<std::string> places(const std::string& csv) {
    std::vector<std::string> result;
    for (const std::string_view line : split_lines(csv)) {
        if (line.empty() || line.starts_with('#')) continue;
        std::size_t end = 0;
        for (int comma = 0; comma < 4; ++comma) end = line.find(',', end) + 1;
        result.emplace_back(line.substr(0, end));
    }
    return result;
}

TEST(GoniophotometerOutput, HasTheRowsOfTheReferenceFiles) {
    const std::string reference = read_file(test::test_data_folder() / "brdf_revised_45deg_sigma0.5_550nm.csv");
    EXPECT_EQ(places(goniophotometer_csv(example({}))), places(reference));
}

TEST(GoniophotometerOutput, AppendsTransmittedLightWhereThereIsSome) {
    const std::vector<std::string> closed = places(goniophotometer_csv(example({})));
    const std::vector<std::string> open = places(goniophotometer_csv(example({Base::Kind::matched})));
    ASSERT_EQ(open.size(), closed.size() + 18);
    EXPECT_EQ(open[closed.size()], "transmitted_polar,0,5,-1,");
    GoniophotometerRun surface = example({Base::Kind::matched});
    surface.light = Light::surface;
    EXPECT_EQ(places(goniophotometer_csv(surface)), closed);
}

TEST(GoniophotometerOutput, JsonHoldsTheSameNumbersAndTheConfiguration) {
    const GoniophotometerRun run = example({Base::Kind::matched});
    const Json json = goniophotometer_json(run);
    EXPECT_EQ(json["brdf_per_sr"][4].get<double>(), brdf(run.spectrum, Light::reflected, 4).per_sr);
    EXPECT_EQ(json["all_bins"]["brdf_se"][4][7].get<double>(),
              brdf(run.spectrum, Light::reflected, 4, 7).standard_error);
    EXPECT_EQ(json["counts"][1]["transmitted"], run.spectrum.counts[1].totals.transmitted);
    EXPECT_EQ(json["configuration"]["rays"], 2000);
    EXPECT_EQ(json["settings"]["illuminant"], "equal_energy");
}

TEST(GoniophotometerOutput, ReciprocityStatesBothWays) {
    const GoniophotometerRun run = example({});
    const std::vector<ReciprocityPair> pairs = {{.polar_bin_a = 2,
                                                 .polar_bin_b = 6,
                                                 .azimuth_bin = 18,
                                                 .a_to_b = {.per_sr = 0.5, .standard_error = 0.03},
                                                 .b_to_a = {.per_sr = 0.25, .standard_error = 0.04},
                                                 .z = 5.0}};
    EXPECT_TRUE(reciprocity_csv(pairs, run).ends_with("\n10,15,30,35,180,0.5,0.03,0.25,0.04,5\n"));
    EXPECT_EQ(reciprocity_json(pairs, run)["pairs"][0]["brdf_b_to_a_per_sr"], 0.25);
}

}  // namespace
}  // namespace skinfit
