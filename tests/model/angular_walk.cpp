#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include "core/file.hpp"
#include "core/text.hpp"
#include "model/angular_solver.hpp"
#include "model/chromophores.hpp"
#include "model/random_walk.hpp"
#include "model/viewing_cone.hpp"
#include "tests/model/angular_samples.hpp"

/// The angular solver against random walks of the same law.
namespace skinfit {
namespace {

/// The chance that a chi-square variable of an even number of degrees of freedom exceeds `value`: a finite sum.
double exceedance(double value, int degrees_of_freedom) {
    double term = std::exp(-0.5 * value);
    double sum = 0.0;
    for (int k = 0; k < degrees_of_freedom / 2; ++k) {
        sum += term;
        term *= 0.5 * value / (k + 1);
    }
    return sum;
}

/// Pearson's test of counts against expected shares, which sum to one. Rare kinds are counted together.
class PearsonTest {
public:
    void add(std::uint64_t count, double share, std::uint64_t rays) {
        const double expected = share * static_cast<double>(rays);
        if (expected < 25.0) {
            rare_count_ += static_cast<double>(count);
            rare_expected_ += expected;
            return;
        }
        add_cell(static_cast<double>(count), expected);
    }
    /// The last kind is fixed by the others; one more is dropped from the degrees of freedom where that makes the
    /// number even, which can only raise the test's false alarms, to at most twice the rate for ten cells or more.
    [[nodiscard]] double p_value() {
        if (rare_expected_ >= 25.0) add_cell(rare_count_, rare_expected_);
        const int freedom = cells_ - 1;
        return exceedance(statistic_, freedom + freedom % 2);
    }

private:
    void add_cell(double count, double expected) {
        statistic_ += (count - expected) * (count - expected) / expected;
        ++cells_;
    }
    double statistic_ = 0.0;
    double rare_count_ = 0.0;
    double rare_expected_ = 0.0;
    int cells_ = 0;
};

constexpr double passing_p_value = 1e-6;

double p_value(const WalkCounts& walk, const AngularResponse& response) {
    PearsonTest test;
    test.add(walk.surface_reflected, response.surface.share, walk.rays);
    test.add(walk.subsurface_reflected, response.reflected.share, walk.rays);
    test.add(walk.transmitted, response.transmitted.share, walk.rays);
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
        test.add(walk.absorbed[layer], response.absorbed[layer], walk.rays);
    }
    return test.p_value();
}

AngularSolver finest(const Sample& sample, double incidence_rad) {
    return {sample, {.incidence_rad = incidence_rad, .resolution = AngularResolution::for_accuracy(2e-5)}};
}

class AgainstWalk : public testing::TestWithParam<AngularCase> {};

TEST_P(AgainstWalk, CountsHaveTheSolversShares) {
    const std::vector<double> wavelengths_nm = {420, 560, 680};
    const auto walks = random_walk(GetParam().sample, wavelengths_nm,
                                   {.incidence_rad = GetParam().incidence_rad, .rays = 200'000, .seed = 20});
    const AngularSolver solver = finest(GetParam().sample, GetParam().incidence_rad);
    for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
        EXPECT_GT(p_value(walks[i], solver.shares(wavelengths_nm[i])), passing_p_value) << wavelengths_nm[i] << " nm";
    }
}

class AgainstReference : public testing::TestWithParam<AngularCase> {};

TEST_P(AgainstReference, SharesAgree) {
    const std::filesystem::path path =
        std::filesystem::path(SKINFIT_SOURCE_DIR) / ".." / "shared" / "reference" / (GetParam().name + ".csv");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "../shared is absent";
    const AngularSolver solver(GetParam().sample, {.incidence_rad = GetParam().incidence_rad});
    constexpr double accuracy = 1e-4;  // of the default resolution
    const std::string text = read_file(path);
    int compared = 0;
    for (const std::string_view line : split_lines(text)) {
        const std::vector<std::string_view> fields = split(line, ',');
        if (fields.size() != 6 || !parse_number(fields[0])) continue;
        const auto field = [&](std::size_t i) { return *parse_number(fields[i]); };
        const AngularResponse response = solver.shares(field(0));
        // Four standard errors: a false alarm in 16000; the files hold fewer than 400 numbers and do not change.
        EXPECT_NEAR(response.surface.share + response.reflected.share, field(1), 4.0 * field(2) + accuracy);
        EXPECT_NEAR(response.transmitted.share, field(3), 4.0 * field(4) + accuracy);
        ++compared;
    }
    EXPECT_GT(compared, 0);
}

INSTANTIATE_TEST_SUITE_P(Angular, AgainstReference, testing::ValuesIn(reference_cases()), case_name);
INSTANTIATE_TEST_SUITE_P(Angular, AgainstWalk, testing::ValuesIn(all_angular_cases()), case_name);

TEST(AgainstWalkPower, ATenthMoreFibrilRadiusIsNoticed) {
    Sample sample;
    const auto walk = random_walk(sample, {560}, {.incidence_rad = 0.7, .rays = 1'000'000, .seed = 21});
    EXPECT_GT(p_value(walk[0], finest(sample, 0.7).shares(560)), passing_p_value);
    sample.skin.fibril_radius_nm *= 1.1;
    EXPECT_LT(p_value(walk[0], finest(sample, 0.7).shares(560)), passing_p_value);
}

/// Where rays leave: counts per bin of the exit cosine, [side][bin].
struct ExitCounts {
    std::array<std::vector<std::uint64_t>, side_count> count;
};

ExitCounts count_exits(const Sample& sample, double wavelength_nm, double incidence_rad, std::uint64_t rays,
                       const std::vector<double>& edges) {
    const LayerStack stack = layer_stack(sample, wavelength_nm);
    const PerLayer<double> depth = optical_depth(sample.skin, Extinction::at(wavelength_nm, sample.edition));
    ExitCounts counts;
    counts.count.fill(std::vector<std::uint64_t>(edges.size() - 1));
    for (std::uint64_t ray = 0; ray < rays; ++ray) {
        RandomWalk walk(stack, RandomRay(22, ray));
        const RandomWalk::FirstHit first = walk.first_hit(std::cos(incidence_rad));
        if (first.reflected) continue;
        double last_cosine = 0.0;
        const Exit exit = walk.below_surface(first.refracted_cosine, [&](int layer, double cosine, double xi) {
            last_cosine = cosine;
            return xi < std::exp(-depth[static_cast<std::size_t>(layer)] / cosine);
        });
        if (exit == Exit::absorbed) continue;
        const bool top = exit == Exit::reflected;
        const bool untouched = !top && stack.base == Base::Kind::matched;
        const FresnelInterface& interface = stack.between(top ? 0 : stack.layers - 1, top ? -1 : stack.layers);
        const double cosine = untouched ? last_cosine : interface.transmitted_cosine(last_cosine);
        const auto bin = std::upper_bound(edges.begin() + 1, edges.end() - 1, cosine) - edges.begin() - 1;
        ++counts.count[top ? 0 : 1][static_cast<std::size_t>(bin)];
    }
    return counts;
}

/// The p-value of the counts of one side with all other rays as one more kind.
double exit_p_value(const AngularSolver& solver, double wavelength_nm, Side side, std::uint64_t rays,
                    const std::vector<double>& edges, const std::vector<std::uint64_t>& counts) {
    const std::vector<double> shares = solver.exit_shares(wavelength_nm, side, edges);
    PearsonTest test;
    double other_share = 1.0;
    std::uint64_t other_count = rays;
    for (std::size_t bin = 0; bin < shares.size(); ++bin) {
        test.add(counts[bin], shares[bin], rays);
        other_share -= shares[bin];
        other_count -= counts[bin];
    }
    test.add(other_count, other_share, rays);
    return test.p_value();
}

TEST(ExitShares, HaveTheDistributionOfTheWalk) {
    constexpr std::uint64_t rays = 400'000;
    const std::vector<double> edges = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1.0};
    for (const AngularCase& angular : reference_cases()) {
        const bool has_bottom = angular.sample.base.kind != Base::Kind::hypodermis;
        const ExitCounts counts = count_exits(angular.sample, 620, angular.incidence_rad, rays, edges);
        const AngularSolver solver = finest(angular.sample, angular.incidence_rad);
        EXPECT_GT(exit_p_value(solver, 620, Side::top, rays, edges, counts.count[0]), passing_p_value) << angular.name;
        if (!has_bottom) continue;
        // No ray turns back downwards in two layers or in the revised dermis: the last completed run is the one that
        // leaves.
        EXPECT_GT(exit_p_value(solver, 620, Side::bottom, rays, edges, counts.count[1]), passing_p_value)
            << angular.name;
    }
}

/// The p-value of the rays in a cone and outside it where they leave through the top, and of all others.
double view_p_value(const ViewedCounts& walk, double walked_cone_rad, const AngularResponse& response) {
    const double viewed_share = response.viewed.share * white_share(walked_cone_rad);
    const std::uint64_t unseen = walk.totals.subsurface_reflected - walk.viewed;
    PearsonTest test;
    test.add(walk.viewed, viewed_share, walk.totals.rays);
    test.add(unseen, response.reflected.share - viewed_share, walk.totals.rays);
    test.add(walk.totals.rays - walk.totals.subsurface_reflected, 1.0 - response.reflected.share, walk.totals.rays);
    return test.p_value();
}

TEST(ViewingConeAgainstWalk, TheWalkLeavesIntoTheConeAsSolved) {
    const std::vector<double> wavelengths_nm = {460, 640};
    for (const double cone_rad : {0.15, 0.7}) {
        for (const AngularCase& angular : all_angular_cases()) {
            const WalkOptions options{.incidence_rad = angular.incidence_rad, .rays = 200'000, .seed = 23};
            const auto walks = viewed_walk(angular.sample, wavelengths_nm, options, cone_rad);
            const AngularSolver solver(angular.sample, {.incidence_rad = angular.incidence_rad,
                                                        .viewing_cone_rad = cone_rad,
                                                        .resolution = AngularResolution::for_accuracy(2e-5)});
            for (std::size_t i = 0; i < wavelengths_nm.size(); ++i) {
                EXPECT_GT(view_p_value(walks[i], cone_rad, solver.shares(wavelengths_nm[i])), passing_p_value)
                    << angular.name << ", " << wavelengths_nm[i] << " nm, cone " << cone_rad;
            }
        }
    }
}

TEST(ViewingConeAgainstWalk, ATwentiethMoreConeIsNoticed) {
    const WalkOptions options{.incidence_rad = 0.8, .rays = 400'000, .seed = 24};
    const ViewedCounts walk = viewed_walk(Sample{}, {640}, options, 0.5).front();
    const auto solved = [](double cone_rad) {
        return AngularSolver(Sample{}, {.incidence_rad = 0.8, .viewing_cone_rad = cone_rad}).shares(640);
    };
    EXPECT_GT(view_p_value(walk, 0.5, solved(0.5)), passing_p_value);
    EXPECT_LT(view_p_value(walk, 0.525, solved(0.525)), passing_p_value);
}

}  // namespace
}  // namespace skinfit
