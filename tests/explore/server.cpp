#include "explore/server.hpp"

#include <gtest/gtest.h>
#include <httplib.h>

#include <thread>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/json.hpp"
#include "explore/guard.hpp"
#include "explore/page.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit {
namespace {

/// A server that runs, and a client.
class Serving : public ::testing::Test {
protected:
    void SetUp() override {
        thread_ = std::thread([this] { server_.run(); });
        while (!client_.Get("/api/vocabulary")) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    void TearDown() override {
        server_.stop();
        thread_.join();
    }

    [[nodiscard]] httplib::Headers with_token() const { return {{token_header, server_.token()}}; }

    Api api_{test::no_cache(), std::nullopt};
    Server server_{api_, 0};
    httplib::Client client_{"127.0.0.1", server_.port()};
    std::thread thread_;
};

TEST_F(Serving, AnswersWithTheTokenInHeaderOrQueryAndNotWithout) {
    EXPECT_EQ(client_.Get("/api/vocabulary")->status, 403);
    EXPECT_EQ(client_.Get("/api/vocabulary", {{token_header, "wrong"}})->status, 403);
    EXPECT_EQ(client_.Get("/api/vocabulary", with_token())->status, 200);
    EXPECT_EQ(client_.Get("/api/vocabulary?token=" + server_.token())->status, 200);
    EXPECT_EQ(client_.Post("/api/simulate", with_token(), "{}", "application/json")->status, 200);
    EXPECT_EQ(client_.Post("/api/simulate", "{}", "application/json")->status, 403);
}

TEST_F(Serving, AnswersToItsOwnNameAlone) {
    httplib::Headers headers = with_token();
    headers.emplace("Host", "evil.example");
    EXPECT_EQ(client_.Get("/api/vocabulary", headers)->status, 421);
    EXPECT_EQ(client_.Get("/", {{"Host", "evil.example"}})->status, 421);
    httplib::Headers foreign = with_token();
    foreign.emplace("Origin", "http://evil.example");
    EXPECT_EQ(client_.Get("/api/vocabulary", foreign)->status, 403);
}

TEST_F(Serving, EveryAnswerCarriesThePolicy) {
    for (const char* path : {"/", "/api/vocabulary", "/nowhere", "/api/fit", "/api/report"}) {
        const httplib::Result result = client_.Get(path);
        const std::string policy = result->get_header_value("Content-Security-Policy");
        EXPECT_NE(policy.find("default-src 'none'"), std::string::npos) << path;
        EXPECT_EQ(policy.find("unsafe"), std::string::npos);
        EXPECT_EQ(result->get_header_value("X-Content-Type-Options"), "nosniff");
        EXPECT_EQ(result->get_header_value("Referrer-Policy"), "no-referrer");
        EXPECT_FALSE(result->has_header("Access-Control-Allow-Origin"));
    }
}

TEST_F(Serving, NoAnswerIsShownByABrowserThatIsSentToIt) {
    for (const char* path : {"/api/vocabulary", "/api/fit?name=1", "/api/report?name=1", "/nowhere"}) {
        const httplib::Result result = client_.Get(path, with_token());
        EXPECT_EQ(result->get_header_value("Content-Disposition"), "attachment; filename=\"answer.json\"") << path;
    }
}

TEST_F(Serving, AReportIsSavedUnderTheRulesOfEveryAnswer) {
    const std::string specimen = read_file(SKINFIT_SOURCE_DIR "/measurements/data/ncsu_113.csv");
    const httplib::Result file = client_.Post("/api/spectra?name=a.csv", with_token(), specimen, "text/csv");
    const Json order = {{"source", "a.csv"}, {"measured", Json::parse(file->body)["measured"]}};
    ASSERT_EQ(client_.Post("/api/fit", with_token(), order.dump(), "application/json")->status, 200);
    while (Json::parse(client_.Get("/api/fit?name=1", with_token())->body)["state"] == "running") {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(client_.Get("/api/report?name=1")->status, 403);
    const httplib::Result report = client_.Get("/api/report?name=1", with_token());
    ASSERT_EQ(report->status, 200) << report->body;
    EXPECT_EQ(report->get_header_value("Content-Type"), "text/html; charset=utf-8");
    EXPECT_EQ(report->get_header_value("Content-Disposition"), "attachment; filename=\"fit_1.html\"");
    EXPECT_EQ(report->get_header_value("X-Content-Type-Options"), "nosniff");
    // Shown in spite of that it could load and run nothing, not even its own style.
    EXPECT_NE(report->get_header_value("Content-Security-Policy").find("default-src 'none'"), std::string::npos);
    // Saved it has no headers: the policy inside it allows its own style and pictures, and nothing else.
    EXPECT_NE(report->body.find("content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'"),
              std::string::npos);
    EXPECT_EQ(report->body.find(server_.token()), std::string::npos);
}

TEST_F(Serving, ThePageHoldsNoSecret) {
    for (const EmbeddedFile& file : page_files()) {
        const httplib::Result result = client_.Get("/" + std::string(file.name));
        EXPECT_EQ(result->status, 200);
        EXPECT_EQ(result->body, file.text);
    }
}

TEST_F(Serving, LargeBodiesAreRefused) {
    const std::string large(largest_body_bytes + 1, ' ');
    const httplib::Result result = client_.Post("/api/spectra?name=a.csv", with_token(), large, "text/csv");
    // Refused before it has been read: the client sees the answer, or a connection that ends.
    if (result) {
        EXPECT_EQ(result->status, 413);
    }
    EXPECT_EQ(client_.Get("/api/vocabulary", with_token())->status, 200);
}

TEST_F(Serving, EncodedBodiesAndPartsAreRefused) {
    httplib::Headers encoded = with_token();
    encoded.emplace("Content-Encoding", "gzip");
    EXPECT_EQ(client_.Post("/api/simulate", encoded, "{}", "application/json")->status, 411);
    httplib::Headers part = with_token();
    part.emplace("Range", "bytes=0-1");
    EXPECT_EQ(client_.Get("/api/vocabulary", part)->status, 416);
}

TEST_F(Serving, APathLeadsToNoFile) {
    for (const char* path : {"/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/api/../etc/passwd"}) {
        EXPECT_EQ(client_.Get(path, with_token())->status, 404) << path;
    }
}

TEST_F(Serving, APortInUseIsRefused) {
    try {
        Server second(api_, server_.port());
        FAIL() << "both serve";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("in use"), std::string::npos);
    }
}

TEST_F(Serving, IsBoundToLoopbackAlone) {
    EXPECT_TRUE(server_.url().starts_with("http://127.0.0.1:"));
    // Another address of the same loopback device.
    httplib::Client elsewhere("127.0.0.2", server_.port());
    EXPECT_FALSE(elsewhere.Get("/"));
}

}  // namespace
}  // namespace skinfit
