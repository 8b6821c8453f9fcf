#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <boost/math/distributions/lognormal.hpp>
#include <cmath>

#include "core/stop.hpp"
#include "model/constants.hpp"
#include "study/manifest.hpp"
#include "study/planned_study.hpp"
#include "study/transport_plan.hpp"
#include "tests/study/transport_cohort.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/statistics.hpp"
#include "transport/skin_spectra.hpp"

/// Cohorts whose spectra the second physics makes.
namespace skinfit::test {
namespace {

SimulatedCohort simulated(const Json& json) {
    return simulate(cohort_of(json), without_cache());
}

/// The p-value that what `value` takes of the subjects has the distribution that `share` is of.
template <class Value, class Share>
double p_value(const SimulatedCohort& cohort, Value value, Share share) {
    std::vector<double> shares;
    for (const SimulatedSubject& subject : cohort.subjects) shares.push_back(share(value(subject)));
    return uniformity_p_value(shares);
}

TEST(TransportCohorts, ScatteringAndSkinHaveTheStatedDistributionsAndNoShiftedOnes) {
    Json json = transport_cohort_json();
    json["groups"] = Json::array({{{"name", "all"}, {"subjects", 1500}}});
    json["wavelengths"] = "600,640,650";
    json.erase("labels");
    const SimulatedCohort cohort = simulated(json);
    const auto check = [&cohort](const auto& value, const auto& share, double shift) {
        EXPECT_GT(p_value(cohort, value, share), passing_p_value);
        const auto shifted = [&](double x) { return std::clamp(share(x + shift), 0.0, 1.0); };
        EXPECT_LT(p_value(cohort, value, shifted), passing_p_value);
    };
    const auto log_normal_within = [](double median, double sigma_log, double lower, double upper) {
        const boost::math::lognormal_distribution<double> law(std::log(median), sigma_log);
        return [=](double x) { return (cdf(law, x) - cdf(law, lower)) / (cdf(law, upper) - cdf(law, lower)); };
    };
    // Shifts of about a third of a standard deviation.
    check([](const SimulatedSubject& each) { return each.scattering->at_500_nm_per_cm; },
          log_normal_within(46, 0.3, 20, 90), 4.5);
    check([](const SimulatedSubject& each) { return each.scattering->power; }, [](double x) { return x - 0.5; }, 0.1);
    check([](const SimulatedSubject& each) { return each.values.skin.melanosome_fraction; },
          log_normal_within(0.06, 0.7, 0.01, 0.5), 0.015);
    check([](const SimulatedSubject& each) { return each.values.skin.oxygen_saturation; },
          [](double x) { return (x - 0.3) / 0.65; }, 0.06);
}

TEST(TransportCohorts, ReadWhatTheTransportOfTheirSkinsReads) {
    Json json = transport_cohort_json();
    json["transport"]["port_diameter_mm"] = 5;
    json["population"]["scale"] = 0.9;
    const SimulatedCohort cohort = simulated(json);
    std::vector<LayeredSkin> skins;
    for (const SimulatedSubject& subject : cohort.subjects) {
        LayeredSkin skin;
        skin.scattering = *subject.scattering;
        skin.melanosome_fraction = subject.values.skin.melanosome_fraction;
        skin.oxygen_saturation = subject.values.skin.oxygen_saturation;
        skin.dermal_bilirubin_g_per_l = subject.values.skin.dermal_bilirubin_g_per_l;
        skins.push_back(skin);
    }
    const SkinReadings readings = skin_spectra(skins, cohort.wavelength_nm,
                                               {.incidence_rad = 8 * rad_per_deg,
                                                .gatherings = {{.spot_radius_cm = 0.25, .port_radius_cm = 0.25}},
                                                .photons = 1000,
                                                .seed = 5,
                                                .node_ratio = 1.35});
    for (std::size_t k = 0; k < skins.size(); ++k) {
        for (std::size_t i = 0; i < cohort.wavelength_nm.size(); ++i) {
            EXPECT_DOUBLE_EQ(cohort.subjects[k].noise_free[i], 0.9 * readings[k][0][i].value);
        }
    }
}

TEST(TransportCohorts, AreTheSameOnAnyNumberOfThreadsAndWhenSimulatedAgain) {
    const Cohort cohort = cohort_of(transport_cohort_json());
    const auto tables = [](const Cohort& of, std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const SimulatedCohort found = simulate(of, without_cache());
        return cohort_spectra_csv(of, found) + manifest_csv(of, found);
    };
    const std::string one = tables(cohort, 1);
    EXPECT_EQ(one, tables(cohort, 2));
    EXPECT_EQ(one, tables(cohort_of(cohort.resolved), 2));
    Json other = transport_cohort_json();
    other["seed"] = 6;
    EXPECT_NE(one, tables(cohort_of(other), 2));
}

TEST(TransportCohorts, TheStudyIsFittedWithoutKnowledgeOfTheSkin) {
    const Cohort cohort = cohort_of(transport_cohort_json());
    const Configuration fit = planned_fit(cohort);
    EXPECT_EQ(fit.preset, Preset::skin);
    EXPECT_EQ(fit.noise, 0.004);
    const Json study = study_json(cohort);
    ASSERT_EQ(study["assess"].size(), 3U) << study["assess"];
    EXPECT_EQ(study["assess"][1]["parameter"], "oxygen_saturation");
    EXPECT_EQ(study["assess"][2]["parameter"], "dermal_bilirubin_g_per_l");
    ASSERT_EQ(study["indicators"].size(), 1U) << "melanin means something else there";
    EXPECT_EQ(study["indicators"][0]["name"], "bilirubin");
    const std::vector<std::string> columns = manifest_columns(cohort);
    for (const char* column : {"true_scattering_at_500_nm_per_cm", "true_scattering_power", "true_oxygen_saturation"}) {
        EXPECT_EQ(std::ranges::count(columns, column), 1) << column;
    }
    Json seen = transport_cohort_json();
    seen["model"] = {{"viewing_cone_deg", 25}};
    EXPECT_EQ(planned_fit(cohort_of(seen)).engine, Engine::solver);
}

TEST(TransportCohorts, StopWhenAskedTo) {
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW((void)simulate(cohort_of(transport_cohort_json()), without_cache(),
                                {.stop = source.get_token(), .progress = {}}),
                 Cancelled);
}

TEST(TransportCohorts, RefuseWhatTheSecondPhysicsHasNot) {
    const auto expect = [](const char* patch, const std::string& message) {
        Json json = transport_cohort_json();
        json.merge_patch(Json::parse(patch));
        const std::string refusal = refusal_of([&] { (void)cohort_of(json); });
        EXPECT_NE(refusal.find(message), std::string::npos) << patch << "\n" << refusal;
    };
    expect(R"({"transport": {"photns": 5}})", "did you mean \"photons\"?");
    expect(R"({"transport": {"photons": 5}})", "cohort.json: transport.photons: 5 cannot be used");
    expect(R"({"transport": {"port_diameter_mm": 0}})", "cohort.json: transport.port_diameter_mm: 0");
    expect(R"({"transport": {"scattering_power": "steep"}})", "cohort.json: transport.scattering_power");
    expect(R"({"transport": {"scattering_power": {"lower": null}}})", "what is drawn needs lower and upper limits");
    expect(R"({"transport": {"scattering_power": {"lower": 2}}})", "the upper limit is not above the lower one");
    expect(R"({"transport": {"scattering_at_500_nm_per_cm": {"median": 900, "sigma_log": 0.01}}})", "no probability");
    expect(R"({"transport": []})", "cohort.json: transport");
    expect(R"({"population": {"bilirubin_g_per_l": 0.1}})", "the layered transport has no such parameter");
    expect(R"({"population": {"pheomelanin_eumelanin_ratio": {"kind": "uniform"}}})", "no such parameter");
    expect(R"({"population": {"oxygen_saturatoin": 0.1}})", "did you mean \"oxygen_saturation\"?");
    expect(R"({"model": {"parameters": {"fibril_radius_nm": 20}}})", "model.parameters");
    expect(R"({"model": {"engine": "solver"}})", "model.engine: cannot stand beside \"transport\"");
    expect(R"({"model": {"edition": "printed"}})", "model.edition: cannot stand beside \"transport\"");
    expect(R"({"model": {"bandpass_width_nm": 10}})", "the layered transport reads single wavelengths");
}

}  // namespace
}  // namespace skinfit::test
