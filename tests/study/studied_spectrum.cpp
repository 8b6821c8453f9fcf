#include "study/studied_spectrum.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "fit/prior_json.hpp"
#include "study/study_tasks.hpp"
#include "tests/study/example_rows.hpp"

namespace skinfit {
namespace {

using test::example_answer;

void expect_same(const StudiedSpectrum& a, const StudiedSpectrum& b) {
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.reason, b.reason);
    ASSERT_EQ(a.parameters.size(), b.parameters.size());
    for (std::size_t i = 0; i < a.parameters.size(); ++i) {
        const ParameterEstimate& one = a.parameters[i];
        const ParameterEstimate& other = b.parameters[i];
        EXPECT_EQ(one.name, other.name);
        EXPECT_EQ(one.value, other.value);
        EXPECT_EQ(one.sigma, other.sigma);
        EXPECT_EQ(one.interval_95.lower, other.interval_95.lower);
        EXPECT_EQ(one.interval_95.upper, other.interval_95.upper);
        EXPECT_EQ(one.bounds.lower, other.bounds.lower);
        EXPECT_EQ(one.bounds.upper, other.bounds.upper);
        EXPECT_EQ(one.status, other.status);
        EXPECT_EQ(one.quantiles, other.quantiles);
        EXPECT_EQ(one.decided_by_prior, other.decided_by_prior);
        EXPECT_EQ(one.split_by_model, other.split_by_model);
        ASSERT_EQ(one.prior.has_value(), other.prior.has_value());
        if (one.prior) {
            EXPECT_EQ(to_json(*one.prior), to_json(*other.prior));
        }
    }
    EXPECT_EQ(a.correlation, b.correlation);
    ASSERT_EQ(a.tissue.size(), b.tissue.size());
    for (std::size_t i = 0; i < a.tissue.size(); ++i) {
        EXPECT_EQ(a.tissue[i].name, b.tissue[i].name);
        EXPECT_EQ(a.tissue[i].value, b.tissue[i].value);
        ASSERT_EQ(a.tissue[i].interval_95.has_value(), b.tissue[i].interval_95.has_value());
        if (a.tissue[i].interval_95) {
            EXPECT_EQ(a.tissue[i].interval_95->lower, b.tissue[i].interval_95->lower);
            EXPECT_EQ(a.tissue[i].interval_95->upper, b.tissue[i].interval_95->upper);
        }
        EXPECT_EQ(a.tissue[i].quantiles, b.tissue[i].quantiles);
    }
    ASSERT_EQ(a.indices.size(), b.indices.size());
    for (std::size_t i = 0; i < a.indices.size(); ++i) {
        EXPECT_EQ(a.indices[i].name, b.indices[i].name);
        EXPECT_EQ(a.indices[i].value, b.indices[i].value);
        EXPECT_EQ(a.indices[i].sigma, b.indices[i].sigma);
    }
    EXPECT_EQ(a.rmse, b.rmse);
    EXPECT_EQ(a.chi2, b.chi2);
    EXPECT_EQ(a.degrees_of_freedom, b.degrees_of_freedom);
    EXPECT_EQ(a.p_value, b.p_value);
    EXPECT_EQ(a.seconds, b.seconds);
}

TEST(StudiedSpectrum, ComesBackFromJsonToTheLastBit) {
    const StudiedSpectrum studied = example_answer();
    const std::string text = to_json(studied).dump();
    expect_same(studied_from_json(Json::parse(text)), studied);
    EXPECT_EQ(to_json(studied_from_json(Json::parse(text))).dump(), text);
    const std::string lists = parameters_json(studied.parameters).dump() + indices_json(studied.indices).dump();
    EXPECT_EQ(lists.find("null"), lists.rfind("null")) << "the one sigma that there is not";
    expect_same(studied_from_json(to_json(StudiedSpectrum())), StudiedSpectrum());
}

/// As a ledger of an earlier release holds it.
TEST(StudiedSpectrum, AnEstimateThatSaysNothingOfPriorsHasNone) {
    Json old = parameters_json({test::example_estimate("oxygen_saturation", 0.5, 0.1)});
    old[0].erase("decided_by_prior");
    EXPECT_FALSE(parameters_from_json(old)[0].decided_by_prior);
    EXPECT_FALSE(parameters_from_json(old)[0].prior);
}

TEST(StudiedSpectrum, EveryStatusHasAName) {
    for (const std::string_view name : fit_status_names) EXPECT_EQ(name_of(fit_status_named(name)), name);
    EXPECT_THROW((void)fit_status_named("fit"), std::out_of_range);
    for (const Status status :
         {Status::free, Status::fixed, Status::at_lower_bound, Status::at_upper_bound, Status::not_identifiable}) {
        StudiedSpectrum studied = example_answer();
        studied.parameters[0].status = status;
        expect_same(studied_from_json(to_json(studied)), studied);
    }
}

TEST(StudyTasks, OfSpectraComeBack) {
    const SpectraTask given{.file = 7, .spectra = {{1, "a", "x"}, {70000, "b", "y"}}};
    const auto task = std::get<SpectraTask>(task_in(bytes_of(given)));
    EXPECT_EQ(task.file, 7U);
    ASSERT_EQ(task.spectra.size(), 2U);
    EXPECT_EQ(task.spectra[1].number, 70000U);
    EXPECT_EQ(task.spectra[1].name, "b");
    EXPECT_EQ(task.spectra[1].input_hash, "y");
    EXPECT_TRUE(std::get<SpectraTask>(task_in(bytes_of(SpectraTask{.file = 0, .spectra = {}}))).spectra.empty());
}

TEST(StudyTasks, OfTilesComeBack) {
    const auto task =
        std::get<TileTask>(task_in(bytes_of(TileTask{.cube = 3, .tile = {.first_line = 640, .lines = 64}})));
    EXPECT_EQ(task.cube, 3U);
    EXPECT_EQ(task.tile.first_line, 640U);
    EXPECT_EQ(task.tile.lines, 64U);
}

TEST(StudyTasks, AnswersComeBackToTheLastBit) {
    SpectraDone done;
    done.answers.push_back(
        {.key = {.source = "a,b.csv", .number = 12, .name = "M\xfcller"}, .studied = example_answer()});
    done.answers.push_back({.key = {.source = "b.csv", .number = 1, .name = ""},
                            .studied = {.status = FitStatus::failed, .reason = "a: b (c); d"}});
    const auto back = std::get<SpectraDone>(done_in(bytes_of(done)));
    ASSERT_EQ(back.answers.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(back.answers[i].key.source, done.answers[i].key.source);
        EXPECT_EQ(back.answers[i].key.number, done.answers[i].key.number);
        EXPECT_EQ(back.answers[i].key.name, done.answers[i].key.name);
        expect_same(back.answers[i].studied, done.answers[i].studied);
    }
}

TEST(StudyTasks, TilesComeBackWithAllTheirBytes) {
    std::string bytes;
    for (int c = 0; c < 256; ++c) bytes += static_cast<char>(c);
    const FittedTile tile{.tile = {.first_line = 8, .lines = 4},
                          .pixels = {0, 1, 2, 3, 4, std::uint64_t{1} << 40},
                          .bytes = bytes,
                          .seconds = 1.0 / 3.0};
    const TileDone done{.cube = 2, .tile = tile, .problem = "none"};
    const auto back = std::get<TileDone>(done_in(bytes_of(done)));
    EXPECT_EQ(back.cube, 2U);
    EXPECT_EQ(back.tile.tile.first_line, 8U);
    EXPECT_EQ(back.tile.tile.lines, 4U);
    EXPECT_EQ(back.tile.pixels, done.tile.pixels);
    EXPECT_EQ(back.tile.bytes, done.tile.bytes);
    EXPECT_EQ(back.tile.seconds, done.tile.seconds);
    EXPECT_EQ(back.problem, "none");
}

}  // namespace
}  // namespace skinfit
