#include "explore/api.hpp"

#include <set>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "explore/configuration_request.hpp"
#include "fit/configuration_json.hpp"
#include "fit/fit.hpp"
#include "fit/fit_scale.hpp"
#include "fit/inspection.hpp"
#include "fit/report.hpp"
#include "measurements/text_reader.hpp"
#include "model/parameters.hpp"
#include "tests/explore/asking.hpp"
#include "tests/report/tag_balance.hpp"

namespace skinfit {
namespace {

using test::Answer;
using Asked = test::Asking;

const std::string specimen = SKINFIT_SOURCE_DIR "/measurements/data/ncsu_113.csv";

TEST_F(Asked, VocabularyIsThatOfTheParameterTableAndTheConfiguration) {
    const Json found = ask("GET", "/api/vocabulary").json;
    ASSERT_EQ(found["parameters"].size(), parameter_count);
    for (const ParameterInfo& info : parameter_table()) {
        const Json& row = found["parameters"][static_cast<std::size_t>(info.parameter)];
        EXPECT_EQ(row["name"], info.name);
        EXPECT_EQ(row["unit"], info.unit);
        EXPECT_EQ(row["lower"].get<double>(), info.lower);
        EXPECT_EQ(row["highest"].get<double>(), info.highest);
        EXPECT_EQ(row["logarithmic"].get<bool>(), has_logarithmic_scale(info.parameter));
        const auto& groups = found["groups"];
        EXPECT_NE(std::find(groups.begin(), groups.end(), row["group"]), groups.end()) << info.name;
        if (!row["usual"].is_null()) {
            EXPECT_LT(row["usual"]["lower"].get<double>(), row["usual"]["upper"].get<double>());
        }
    }
    EXPECT_EQ(found["schema"], configuration_schema());
    EXPECT_EQ(to_json(configured(default_configuration(), found["configuration"], "test")),
              to_json(explore_configuration()));
}

TEST_F(Asked, WhatIsNoRequestIsAnError) {
    for (const char* body : {"", "{", "[]", "7", "\"text\"", "{\"configuration\": 7}", "{\"configuration\": [1]}",
                             R"({"configuration": {"parameters": 3}})", R"({"configuration": {"free": 3}})",
                             R"({"configuration": {}, "configuration": {}})", "\xff\xfe\x00"}) {
        const Answer answer = ask("POST", "/api/simulate", body);
        EXPECT_EQ(answer.status, 400) << body << answer.json;
        EXPECT_FALSE(answer.json["error"].get<std::string>().empty());
    }
    std::string deep = "{\"configuration\": ";
    for (int i = 0; i < 100'000; ++i) deep += "[";
    EXPECT_EQ(ask("POST", "/api/simulate", deep).status, 400);
}

TEST_F(Asked, UnknownAddressesAreNotFound) {
    EXPECT_EQ(ask("GET", "/api/nowhere").status, 404);
    EXPECT_EQ(ask("GET", "/api/simulate").status, 404);
    EXPECT_EQ(ask("GET", "/api/fit", "", "1").status, 404);
    EXPECT_EQ(ask("GET", "/api/fit", "", "../../etc/passwd").status, 404);
    EXPECT_EQ(ask("DELETE", "/api/fit", "", "99999999999999999999").status, 404);
}

TEST_F(Asked, NoRequestReachesTheDisk) {
    // Both are good files, which the same words on the command line would read.
    const std::string instrument = SKINFIT_SOURCE_DIR "/configs/instruments/nist_sphere.json";
    for (const Json& configuration :
         {Json{{"instrument", instrument}}, Json{{"configuration", {{"instrument", instrument}}}}}) {
        const Answer answer = simulate(configuration);
        EXPECT_EQ(answer.status, 400);
        EXPECT_NE(answer.json["error"].get<std::string>().find("nist_sphere"), std::string::npos);
    }
    EXPECT_EQ(simulate({{"instrument", "nist_sphere"}}).status, 200);
    const Answer upload = ask("POST", "/api/spectra", "not a spectrum", specimen);
    EXPECT_EQ(upload.status, 400);
}

TEST_F(Asked, AnUploadedFileIsTheFile) {
    const Answer answer = ask("POST", "/api/spectra", read_file(specimen), "ncsu_113.csv");
    ASSERT_EQ(answer.status, 200) << answer.json;
    const Spectrum spectrum = read_spectrum(specimen);
    ASSERT_EQ(answer.json["measured"].size(), 1U);
    const Json& measured = answer.json["measured"][0];
    EXPECT_EQ(measured["wavelength_nm"].get<std::vector<double>>(), spectrum.wavelength_nm);
    EXPECT_EQ(measured["value"].get<std::vector<double>>(), spectrum.value);
    EXPECT_EQ(answer.json["source"], "ncsu_113.csv");
    EXPECT_EQ(answer.json["findings"], findings_json(findings_in(std::span(&spectrum, 1))));
}

TEST_F(Asked, AFileFromTheCommandLineIsInTheVocabulary) {
    Api with_file(test::no_cache(), read_spectra(specimen));
    const ApiAnswer answer = with_file.answer({.method = "GET", .path = "/api/vocabulary", .name = "", .body = ""});
    EXPECT_EQ(Json::parse(answer.body)["file"]["measured"].size(), 1U);
}

TEST(Asking, AFileOfTooManySpectraIsRefusedAtTheStart) {
    std::string rows = "wavelength_nm";
    for (int i = 1; i <= 201; ++i) rows += ",s" + std::to_string(i);
    for (const char* nm : {"400", "500", "600"}) {
        rows += std::string("\n") + nm;
        for (int i = 1; i <= 201; ++i) rows += ",0.3";
    }
    EXPECT_THROW(Api(test::no_cache(), parse_spectra(rows + "\n", "many.csv")), InputError);
}

TEST_F(Asked, ExportsRunAgain) {
    const Json stated = {{"edition", "printed"}, {"parameters", {{"melanosome_fraction", 0.1}}}};
    const Json found = post("/api/export", {{"configuration", stated}}).json;
    Json again = simulate(found["configuration"]).json;
    Json first = simulate(stated).json;
    EXPECT_EQ(again["decided_by"]["layers"], "stated") << "an export states all that was decided";
    EXPECT_EQ(again.erase("decided_by") + first.erase("decided_by"), 2U);
    EXPECT_EQ(again, first);
    const Spectrum simulated =
        parse_spectrum(found["simulations"][0]["csv"].get<std::string>(), "simulation.csv", {.column = "reflectance"});
    const Json reading = simulate(stated).json["reading"];
    ASSERT_EQ(simulated.value.size(), reading.size());
    for (std::size_t i = 0; i < reading.size(); ++i) {
        EXPECT_NEAR(simulated.value[i], reading[i].get<double>(), 5e-7);  // printed with six decimals or more
    }
}

TEST_F(Asked, SensitivityIsThatOfTheCommand) {
    const Answer answer = post("/api/sensitivity", {{"configuration", {{"wavelengths", "450:650:50"}}}});
    ASSERT_EQ(answer.status, 200) << answer.json;
    EXPECT_EQ(answer.json["derivative"]["melanosome_fraction"].size(), 5U);
}

TEST_F(Asked, AFitIsThatOfTheLibrary) {
    const Json upload = ask("POST", "/api/spectra", read_file(specimen), "ncsu_113.csv").json;
    const Json order = {
        {"configuration", {{"wavelength_min_nm", 450}}}, {"source", "ncsu_113.csv"}, {"measured", upload["measured"]}};
    const Answer started = post("/api/fit", order);
    ASSERT_EQ(started.status, 200) << started.json;
    const Json state = ended(started.json["name"].get<std::string>());
    ASSERT_EQ(state["state"], "done") << state;
    Configuration configuration = explore_configuration();
    configuration.wavelength_min_nm = 450;
    const FitResult expected = fit_spectrum(configuration, read_spectrum(specimen), {.cache = test::no_cache()});
    const Json report = json_report(expected);
    EXPECT_EQ(state["documents"]["report"]["parameters"], report["parameters"]);
    EXPECT_EQ(state["documents"]["report"]["verdict"], report["verdict"]);
    EXPECT_EQ(state["documents"]["report"]["configuration"], report["configuration"]);
    EXPECT_NE(state["documents"]["text"].get<std::string>().find("verdict"), std::string::npos);
}

TEST_F(Asked, TheReportOfAFitIsThePageOfItsResult) {
    const Json upload = ask("POST", "/api/spectra", read_file(specimen), "ncsu_113.csv").json;
    const Answer started = post("/api/fit", {{"source", "ncsu_113.csv"}, {"measured", upload["measured"]}});
    ASSERT_EQ(started.status, 200) << started.json;
    const std::string name = started.json["name"].get<std::string>();
    const Json documents = ended(name)["documents"];
    const ApiAnswer report = api_.answer({.method = "GET", .path = "/api/report", .name = name, .body = ""});
    ASSERT_EQ(report.status, 200) << report.body;
    EXPECT_EQ(report.saved_as, "fit_" + name + ".html");
    EXPECT_TRUE(report.body.starts_with("<!DOCTYPE html>"));
    EXPECT_EQ(test::tag_complaint(report.body), "");
    EXPECT_NE(report.body.find("class=\"badge"), std::string::npos);
    EXPECT_NE(report.body.find("data:image/svg+xml;base64,"), std::string::npos);
    EXPECT_LT(report.body.size(), std::size_t{2} << 20U);
    // What it promises of the block that it holds.
    EXPECT_NE(report.body.find("a page sent a spectrum of ncsu_113.csv. A command repeats it: skinfit fit FILE "
                               "--config result.json"),
              std::string::npos);
    const Configuration again = configured(default_configuration(), documents["report"], "result.json");
    const FitResult repeated = fit_spectrum(again, read_spectrum(specimen), {.cache = test::no_cache()});
    EXPECT_EQ(json_report(repeated)["parameters"], documents["report"]["parameters"]);
}

TEST_F(Asked, ThereIsNoReportOfAFitThatIsNotDone) {
    EXPECT_EQ(ask("GET", "/api/report", "", "1").status, 404);
    EXPECT_EQ(ask("GET", "/api/report", "", "../fit").status, 404);
    const Json upload = ask("POST", "/api/spectra", read_file(specimen), "ncsu_113.csv").json;
    const Json endless = {{"configuration", {{"engine", "solver"}, {"starts", 1000}}},
                          {"measured", upload["measured"]}};
    const std::string name = post("/api/fit", endless).json["name"].get<std::string>();
    EXPECT_EQ(ask("GET", "/api/report", "", name).status, 404);
    EXPECT_EQ(ask("DELETE", "/api/fit", "", name).status, 200);
    EXPECT_EQ(ended(name)["state"], "cancelled");
    EXPECT_EQ(ask("GET", "/api/report", "", name).status, 404);
}

TEST_F(Asked, AFitThatMakesNoSenseFailsWithItsReason) {
    EXPECT_EQ(post("/api/fit", {{"measured", Json::array()}}).status, 400);
    EXPECT_EQ(post("/api/fit", {{"measured", "text"}}).status, 400);
    EXPECT_EQ(post("/api/fit", Json::object()).status, 400);
    const Json flat = {
        {{"name", "flat"}, {"wavelength_nm", {500, 550, 600, 650, 660, 670}}, {"values", {.3, .3, .3, .3, .3, .3}}}};
    const Answer started = post("/api/fit", {{"measured", flat}});
    ASSERT_EQ(started.status, 200) << started.json;
    const Json state = ended(started.json["name"].get<std::string>());
    EXPECT_EQ(state["state"], "failed");
    EXPECT_NE(state["error"].get<std::string>().find("all 6 values"), std::string::npos) << state;
}

TEST_F(Asked, ACancelledFitStopsSoon) {
    const Json upload = ask("POST", "/api/spectra", read_file(specimen), "ncsu_113.csv").json;
    // A search without derivatives over the solver from a thousand starts takes hours.
    for (const char* solver : {"ceres", "sbplx", "slsqp", "bobyqa", "crs2"}) {
        const Json configuration = {{"engine", "solver"}, {"solver", solver}, {"starts", 1000}};
        const Answer started = post("/api/fit", {{"configuration", configuration}, {"measured", upload["measured"]}});
        ASSERT_EQ(started.status, 200) << started.json;
        const std::string name = started.json["name"].get<std::string>();
        while (ask("GET", "/api/fit", "", name).json["progress"]["stage"] != "searching") {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        EXPECT_EQ(ask("DELETE", "/api/fit", "", name).status, 200);
        EXPECT_EQ(ended(name)["state"], "cancelled") << solver;
    }
}

TEST_F(Asked, SoDoesOneThatIsEstimatingItsUncertainty) {
    const Json upload = ask("POST", "/api/spectra", read_file(specimen), "ncsu_113.csv").json;
    for (const char* uncertainty : {"posterior", "profile"}) {
        const Json configuration = {{"engine", "solver"}, {"starts", 1}, {"uncertainty", uncertainty}};
        const Answer started = post("/api/fit", {{"configuration", configuration}, {"measured", upload["measured"]}});
        ASSERT_EQ(started.status, 200) << started.json;
        const std::string name = started.json["name"].get<std::string>();
        while (ask("GET", "/api/fit", "", name).json["progress"]["stage"] != "estimating the uncertainty") {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        EXPECT_EQ(ask("DELETE", "/api/fit", "", name).status, 200);
        EXPECT_EQ(ended(name)["state"], "cancelled") << uncertainty;
    }
}

TEST_F(Asked, SoDoesOneThatIsRecordingWalks) {
    const Json upload = ask("POST", "/api/spectra", read_file(specimen), "ncsu_113.csv").json;
    const Json configuration = {{"engine", "paths"}, {"rays", 3'000'000}};
    const Answer started = post("/api/fit", {{"configuration", configuration}, {"measured", upload["measured"]}});
    ASSERT_EQ(started.status, 200) << started.json;
    const std::string name = started.json["name"].get<std::string>();
    while (ask("GET", "/api/fit", "", name).json["progress"]["stage"] != "preparing the model") {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    EXPECT_EQ(ask("DELETE", "/api/fit", "", name).status, 200);
    const Json state = ended(name);
    EXPECT_EQ(state["state"], "cancelled");
    EXPECT_EQ(state["progress"]["stage"], "preparing the model");
}

TEST_F(Asked, NoMoreThanTwoFitsRun) {
    const Json upload = ask("POST", "/api/spectra", read_file(specimen), "ncsu_113.csv").json;
    const Json order = {{"configuration", {{"engine", "solver"}, {"starts", 1000}}}, {"measured", upload["measured"]}};
    EXPECT_EQ(post("/api/fit", order).status, 200);
    EXPECT_EQ(post("/api/fit", order).status, 200);
    EXPECT_EQ(post("/api/fit", order).status, 429);
    EXPECT_EQ(ask("DELETE", "/api/fit", "", "1").status, 200);
    EXPECT_EQ(ended("1")["state"], "cancelled");
    EXPECT_EQ(post("/api/fit", order).status, 200);
    // The end of the test ends the others.
}

}  // namespace
}  // namespace skinfit
