#include "explore/measured_request.hpp"

#include <set>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fit/configuration_json.hpp"
#include "fit/problem.hpp"
#include "measurements/text_reader.hpp"
#include "tests/explore/asking.hpp"

namespace skinfit {
namespace {

using test::Answer;
using Drawing = test::Asking;

const std::string specimen = SKINFIT_SOURCE_DIR "/measurements/data/ncsu_113.csv";

/// The specimen with `head` before its comments about geometry, which are left out.
std::string stating(const std::string& head, const std::string& left_out = "# incidence_deg# specular# note") {
    std::string text = head;
    const std::string whole = read_file(specimen);
    for (const std::string_view line : split_lines(whole)) {
        const std::string key(line.substr(0, line.find(':')));
        if (line.starts_with('#') && left_out.find(key) != std::string::npos) continue;
        text += std::string(line) + "\n";
    }
    return text;
}

/// The answer to a file that is good.
Json file_of(const Answer& answer) {
    EXPECT_EQ(answer.status, 200) << answer.json;
    return answer.json;
}

/// Files that differ in what they state, one for each thing that a file decides.
std::vector<std::string> all_kinds() {
    std::string of_transmittance =
        stating("# quantity: transmittance\n# layers: 2\n", "# incidence_deg# specular# note# quantity");
    of_transmittance.replace(of_transmittance.find(",reflectance"), std::string_view(",reflectance").size(), ",value");
    return {read_file(specimen),
            stating(""),
            stating("# incidence_deg: 60\n# specular: included\n"),
            stating("# viewing_cone_deg: 5\n# specular: excluded\n# incidence_deg: 45\n"),
            stating("# instrument: ncsu_45_0\n"),
            stating("# bandpass_shape: gaussian\n# bandpass_width_nm: 30\n"),
            stating("# edition: printed\n"),
            stating("# layers: 2\n# base: 1.33\n"),
            of_transmittance};
}

TEST_F(Drawing, IsTheModelOfTheFitWhateverTheFileStates) {
    for (const std::string& text : all_kinds()) {
        const Json file = file_of(ask("POST", "/api/spectra", text, "a.csv"));
        const Json stated = {
            {"engine", "solver"}, {"starts", 1}, {"wavelengths", "400:700:5"}, {"free", {"melanosome_fraction"}}};
        const Answer started =
            post("/api/fit", {{"configuration", stated}, {"source", "a.csv"}, {"measured", file["measured"]}});
        ASSERT_EQ(started.status, 200) << started.json;
        const Json state = ended(started.json["name"].get<std::string>());
        ASSERT_EQ(state["state"], "done") << state;
        const Json& report = state["documents"]["report"];
        Json as_fitted = stated;
        for (const auto& [name, found] : report["parameters"].items()) as_fitted["parameters"][name] = found["value"];
        const Answer drawn = post(
            "/api/simulate", {{"configuration", as_fitted}, {"source", "a.csv"}, {"measured", file["statements"]}});
        ASSERT_EQ(drawn.status, 200) << drawn.json;
        const Json& model = drawn.json["models"][0];
        ASSERT_EQ(model["wavelength_nm"], report["wavelength_nm"]);
        for (std::size_t i = 0; i < model["reading"].size(); ++i) {
            // One computation, by the same solver, from numbers that JSON holds to the last bit.
            EXPECT_NEAR(model["reading"][i].get<double>(), report["modelled"][i].get<double>(), 1e-12)
                << text.substr(0, 80);
        }
        for (const std::string_view name : measurement_settings) {
            EXPECT_EQ(model["measurement"][std::string(name)], report["configuration"][std::string(name)]) << name;
        }
    }
}

TEST_F(Drawing, AStatementDrawsWhatItsSpectrumDraws) {
    for (const std::string& text : all_kinds()) {
        const Json file = file_of(ask("POST", "/api/spectra", text, "a.csv"));
        const Json whole = post("/api/simulate", {{"measured", file["measured"]}}).json;
        EXPECT_EQ(post("/api/simulate", {{"measured", file["statements"]}}).json, whole);
        EXPECT_LT(file["statements"].dump().size(), file["measured"].dump().size() / 2);
    }
}

TEST_F(Drawing, SaysWhoDecidesTheMeasurement) {
    const Json file =
        file_of(ask("POST", "/api/spectra", stating("# incidence_deg: 45\n# edition: printed\n"), "a.csv"));
    const auto decided = [&](const Json& configuration, const Json& measured) {
        const Answer answer = post("/api/simulate", {{"configuration", configuration}, {"measured", measured}});
        EXPECT_EQ(answer.status, 200) << answer.json;
        return answer.status == 200 ? answer.json["models"][0]["decided_by"] : Json::object();
    };
    const Json by_file = decided(Json::object(), file["statements"]);
    EXPECT_EQ(by_file["incidence_deg"], "file");
    EXPECT_EQ(by_file["edition"], "file");
    EXPECT_EQ(by_file["specular"], "default");
    const Json by_page = decided({{"incidence_deg", 10}, {"edition", "revised"}}, file["statements"]);
    EXPECT_EQ(by_page["incidence_deg"], "stated");
    EXPECT_EQ(by_page["edition"], "stated");
    EXPECT_EQ(decided({{"instrument", "ncsu_45_0"}}, file["statements"])["incidence_deg"], "instrument");
    const Json by_nobody = decided(Json::object(), Json::array());
    for (const auto& [name, who] : by_nobody.items()) EXPECT_EQ(who, "default") << name;
}

TEST_F(Drawing, DrawsAModelForEachGeometryAndNoMoreThanFour) {
    Json statements = Json::array();
    const auto add = [&](const std::string& head) {
        statements.push_back(file_of(ask("POST", "/api/spectra", stating(head), "a.csv"))["statements"][0]);
    };
    add("# incidence_deg: 45\n");
    add("# incidence_deg: 10\n");
    add("# incidence_deg: 45\n# site: arm\n");
    const Json models = post("/api/simulate", {{"measured", statements}}).json["models"];
    ASSERT_EQ(models.size(), 2U);
    EXPECT_EQ(models[0]["spectra"], Json({0, 2}));
    EXPECT_EQ(models[1]["spectra"], Json::array({1}));
    EXPECT_EQ(models[1]["measurement"]["incidence_deg"], 10);
    EXPECT_EQ(post("/api/export", {{"measured", statements}}).json["simulations"].size(), 2U);
    // What the page states holds for all of them.
    EXPECT_EQ(post("/api/simulate", {{"configuration", {{"incidence_deg", 30}}}, {"measured", statements}})
                  .json["models"]
                  .size(),
              1U);
    for (const char* angle : {"20", "30", "40"}) add(std::string("# incidence_deg: ") + angle + "\n");
    const Answer refused = post("/api/simulate", {{"source", "a.csv"}, {"measured", statements}});
    EXPECT_EQ(refused.status, 400);
    EXPECT_NE(refused.json["error"].get<std::string>().find("more than 4 geometries"), std::string::npos);
}

TEST_F(Drawing, TheSettingsAreThoseThatAFileDecides) {
    // With nothing stated, resolving for one of the files changes settings of the list alone; each is changed by some.
    std::set<std::string> changed;
    const Json stated =
        to_json(measured_models({.stated = Json::object(), .source = "", .spectra = {}}).front().configuration);
    for (const std::string& text : all_kinds()) {
        const Json file = file_of(ask("POST", "/api/spectra", text, "a.csv"));
        const Json request = {{"measured", file["statements"]}};
        const Json configuration = to_json(measured_models(measured_request(request)).front().configuration);
        for (const auto& [name, value] : configuration.items()) {
            if (value != stated[name]) changed.insert(name);
        }
    }
    EXPECT_EQ(changed, std::set<std::string>(measurement_settings.begin(), measurement_settings.end()));
}

TEST_F(Drawing, OnlyEnginesThatFitAreOffered) {
    const Json offered = ask("GET", "/api/vocabulary").json["fit_engines"];
    const Spectrum spectrum = read_spectrum(specimen);
    for (const std::string_view engine : engine_names) {
        const bool is_offered = std::find(offered.begin(), offered.end(), engine) != offered.end();
        const Configuration configuration = configured(default_configuration(), {{"engine", engine}}, "test");
        if (is_offered) {
            EXPECT_NO_THROW((void)make_problem(configuration, std::span(&spectrum, 1))) << engine;
        } else {
            EXPECT_THROW((void)make_problem(configuration, std::span(&spectrum, 1)), InputError) << engine;
        }
    }
}

TEST_F(Drawing, TheSampleIsTheShippedSpecimen) {
    const Json sample = ask("GET", "/api/sample").json;
    EXPECT_EQ(sample, file_of(ask("POST", "/api/spectra", read_file(specimen), "ncsu_113.csv")));
}

TEST_F(Drawing, AnEnviCubeIsRefusedWithTheCommandThatReadsIt) {
    const std::string header = "ENVI\nsamples = 2\nlines = 1\nbands = 3\ndata type = 12\n";
    const std::string data("\x01\x00\x02\x00\x00\x03", 6);
    for (const auto& [name, bytes] : {std::pair{"hand.hdr", header},
                                      {"HAND.HDR", header},
                                      {"noname", header},
                                      {"hand.img", data},
                                      {"HAND.BIL", data},
                                      {"hand.dat", data},
                                      {"lib.sli", data}}) {
        const Answer answer = ask("POST", "/api/spectra", bytes, name);
        EXPECT_EQ(answer.status, 400);
        const std::string error = answer.json["error"].get<std::string>();
        EXPECT_TRUE(error.starts_with(std::string(name) + ": is ")) << error;
        for (const char* words : {"ENVI cube", "two files", "skinfit fit FILE", "skinfit explore FILE"}) {
            EXPECT_NE(error.find(words), std::string::npos) << error;
        }
    }
    // A text file of such a name is read, and one that is too large says so.
    EXPECT_EQ(ask("POST", "/api/spectra", read_file(specimen), "specimen.dat").status, 200);
    const ApiAnswer large = api_.answer(
        {.method = "POST", .path = "/api/spectra", .name = "big.csv", .size = "33554432", .body = "wavelength_nm"});
    EXPECT_EQ(large.status, 400);
    EXPECT_NE(large.body.find("has 32.0 MiB (a page sends 16 MiB at most)"), std::string::npos) << large.body;
}

}  // namespace
}  // namespace skinfit
