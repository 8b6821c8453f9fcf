#include "explore/guard.hpp"

#include <gtest/gtest.h>

namespace skinfit {
namespace {

const Access access{.port = 8080, .token = "0123456789abcdef0123456789abcdef"};

RequestParts good() {
    return {.method = "POST",
            .path = "/api/simulate",
            .host = "127.0.0.1:8080",
            .origin = "http://127.0.0.1:8080",
            .token = access.token};
}

int status_of(const RequestParts& request) {
    const std::optional<RequestRefusal> refused = refusal(request, access);
    return refused ? refused->status : 200;
}

TEST(Guard, LetsItsOwnPageAsk) {
    EXPECT_EQ(status_of(good()), 200);
    RequestParts local = good();
    local.host = "localhost:8080";
    local.origin = "http://localhost:8080";
    EXPECT_EQ(status_of(local), 200);
    local.origin = "";  // no browser
    EXPECT_EQ(status_of(local), 200);
}

TEST(Guard, AnswersToNoOtherName) {
    for (const char* host : {"", "evil.example", "evil.example:8080", "127.0.0.1", "127.0.0.1:8081", "127.0.0.1:80800",
                             "127.0.0.1:8080.evil.example", "localhost", "[::1]:8080", "0.0.0.0:8080"}) {
        RequestParts request = good();
        request.host = host;
        EXPECT_EQ(status_of(request), 421) << host;
    }
}

TEST(Guard, RefusesOtherSites) {
    for (const char* origin : {"null", "http://evil.example", "https://127.0.0.1:8080", "http://127.0.0.1",
                               "http://127.0.0.1:8081", "http://localhost:8080.evil.example", "127.0.0.1:8080"}) {
        RequestParts request = good();
        request.origin = origin;
        EXPECT_EQ(status_of(request), 403) << origin;
    }
}

TEST(Guard, NeedsTheTokenForEveryAnswer) {
    for (const char* token : {"", "0", "0123456789abcdef0123456789abcdeF"}) {
        for (const char* path : {"/api/vocabulary", "/api/fit", "/", "/nowhere"}) {
            RequestParts request = good();
            request.path = path;
            request.token = token;
            EXPECT_EQ(status_of(request), 403) << path << " " << token;
        }
    }
}

TEST(Guard, RefusesBodiesOfUnknownSizeAndParts) {
    RequestParts encoded = good();
    encoded.is_encoded = true;
    EXPECT_EQ(status_of(encoded), 411);
    RequestParts part = good();
    part.asks_for_part = true;
    EXPECT_EQ(status_of(part), 416);
}

}  // namespace
}  // namespace skinfit
