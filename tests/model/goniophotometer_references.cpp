#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "core/file.hpp"
#include "core/text.hpp"
#include "model/constants.hpp"
#include "model/goniophotometer.hpp"
#include "tests/support/reference_spectrum.hpp"
#include "tests/support/statistics.hpp"

namespace skinfit {
namespace {

constexpr double reference_rays = 2e7;  // ../shared/README.md

/// One row of a reference file: a ring, or a bin in the plane of incidence.
struct ReferenceRow {
    int polar_bin;
    std::optional<int> azimuth_bin;
    double per_sr;
};

/// A BRDF of an independent Monte Carlo: [KA04, Table 1] with another `fold_aspect_ratio`, at 550 nm.
struct ReferenceBrdf {
    std::string name;
    Sample sample;
    double incidence_rad = 0.0;
    std::vector<ReferenceRow> rows;
};

double number(std::string_view text) {
    const std::optional<double> value = parse_number(text);
    if (!value) throw std::runtime_error("not a number: " + std::string(text));
    return *value;
}

/// The word after `key` in the header.
std::string_view word_after(std::string_view header, std::string_view key) {
    const std::size_t begin = header.find(key);
    if (begin == std::string_view::npos) throw std::runtime_error("header lacks " + std::string(key));
    const std::string_view rest = header.substr(begin + key.size());
    return rest.substr(0, rest.find_first_of("; "));
}

ReferenceRow parse_row(std::string_view line) {
    const std::vector<std::string_view> fields = split(line, ',');
    const int polar_bin = static_cast<int>(std::lround(number(fields.at(1)) / 5));
    if (fields[0] == "polar") return {polar_bin, std::nullopt, number(fields.at(4))};
    if (fields[0] == "inplane_back") return {polar_bin, 18, number(fields.at(4))};
    if (fields[0] == "inplane_forward") return {polar_bin, 0, number(fields.at(4))};
    throw std::runtime_error("unknown kind: " + std::string(fields[0]));
}

ReferenceBrdf load(const std::filesystem::path& path) {
    const std::string text = read_file(path);
    const std::vector<std::string_view> lines = split_lines(text);
    const std::string_view header = lines.at(0);
    ReferenceBrdf reference{.name = path.stem().string(), .sample = {}, .rows = {}};
    if (word_after(header, "; 550 ") != "nm") throw std::runtime_error("not at 550 nm");
    reference.sample.edition = word_after(header, "edition ") == "printed" ? Edition::printed : Edition::revised;
    reference.sample.skin.fold_aspect_ratio = number(word_after(header, "sigma "));
    reference.incidence_rad = number(word_after(header, "incidence ")) * rad_per_deg;
    for (std::size_t i = 2; i < lines.size(); ++i) {
        if (!lines[i].empty()) reference.rows.push_back(parse_row(lines[i]));
    }
    return reference;
}

std::vector<ReferenceBrdf> load_all(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().filename().string().starts_with("brdf_")) paths.push_back(entry.path());
    }
    std::ranges::sort(paths);
    std::vector<ReferenceBrdf> references;
    for (const std::filesystem::path& path : paths) references.push_back(load(path));
    return references;
}

/// The rays that a row counted, of `rays`.
double count_of(const ReferenceRow& row, double per_sr, double rays) {
    const AngularBins bins;
    return per_sr * bins.projected_solid_angle(row.polar_bin) * (row.azimuth_bin ? 1 : bins.azimuth) * rays;
}

TEST(GoniophotometerReferences, AreWholeCountsOverProjectedSolidAngles) {
    // Eight digits are given, so a count is known to 5e-8 of itself, at the worst.
    for (const ReferenceBrdf& reference : load_all(test::test_data_folder())) {
        ASSERT_EQ(reference.rows.size(), 54U);
        for (const ReferenceRow& row : reference.rows) {
            const double count = count_of(row, row.per_sr, reference_rays);
            EXPECT_NEAR(count, std::round(count), 5e-8 * count) << reference.name;
        }
    }
}

double p_value(const ReferenceBrdf& reference, const Sample& sample) {
    constexpr std::uint64_t rays = 4'000'000;
    const AngularSpectrum spectrum{
        .bins = {},
        .counts = goniophotometer(
            sample, {550},
            {.incidence = {reference.incidence_rad, reference.incidence_rad}, .rays = rays, .seed = 12, .bins = {}}),
        .weights = {1.0}};
    std::vector<double> z;
    for (const ReferenceRow& row : reference.rows) {
        const BrdfValue found = brdf(spectrum, Light::reflected, row.polar_bin, row.azimuth_bin);
        const auto count = [&](double per_sr, double of) {
            return static_cast<std::uint64_t>(std::llround(count_of(row, per_sr, of)));
        };
        z.push_back(test::z_between(
            test::Count{count(found.per_sr, static_cast<double>(rays)), rays},
            test::Count{count(row.per_sr, reference_rays), static_cast<std::uint64_t>(reference_rays)}));
    }
    return test::family_wise_p_value(z);
}

TEST(GoniophotometerReferences, AgreesWithTheKeptOne) {
    const std::vector<ReferenceBrdf> references = load_all(test::test_data_folder());
    ASSERT_EQ(references.size(), 1U);
    EXPECT_GT(p_value(references[0], references[0].sample), test::passing_p_value);
}

TEST(GoniophotometerReferences, AgreesWithAllInShared) {
    const std::filesystem::path folder = test::shared_folder() / "reference";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "../shared is absent";
    for (const ReferenceBrdf& reference : load_all(folder)) {
        EXPECT_GT(p_value(reference, reference.sample), test::passing_p_value) << reference.name;
    }
}

TEST(GoniophotometerReferences, FoldsFivePercentSteeperAreSeen) {
    for (const ReferenceBrdf& reference : load_all(test::test_data_folder())) {
        Sample steeper = reference.sample;
        steeper.skin.fold_aspect_ratio *= 1.05;
        EXPECT_LT(p_value(reference, steeper), test::passing_p_value) << reference.name;
    }
}

}  // namespace
}  // namespace skinfit
