// Before httplib, whose <resolv.h> makes a macro of a name that Eigen uses.
#include "explore/server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "explore/guard.hpp"
#include "tests/fit/synthetic.hpp"

namespace skinfit {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int slow_count = 100;
constexpr milliseconds patience{2000};  // of whoever moves a slider

/// What a slow client sends at once, and what it adds to that byte by byte; nothing where it says no more.
struct Slowness {
    std::string name;
    std::string begin;
    std::string drip;
};

/// A hundred connections that never come to an end of their requests, or never read an answer. One that the server ends
/// comes again.
class SlowClients {
public:
    SlowClients(int port, Slowness slowness) : port_(port), slowness_(std::move(slowness)) {
        for (int& socket : sockets_) socket = connected();
        thread_ = std::jthread([this](const std::stop_token& stop) { drip(stop); });
    }
    ~SlowClients() {
        thread_.request_stop();
        thread_.join();
        for (const int socket : sockets_) ::close(socket);
    }
    SlowClients(const SlowClients&) = delete;
    SlowClients& operator=(const SlowClients&) = delete;

private:
    [[nodiscard]] int connected() const {
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        const int small = 2048;
        (void)::setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port_));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        (void)::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address);
        (void)::send(socket, slowness_.begin.data(), slowness_.begin.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        return socket;
    }

    void drip(const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            std::this_thread::sleep_for(milliseconds(50));
            for (int& socket : sockets_) {
                char byte = 0;
                const ssize_t sent =
                    ::send(socket, slowness_.drip.data(), slowness_.drip.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
                const bool is_ended = ::recv(socket, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
                if (!is_ended && (sent >= 0 || errno == EAGAIN)) continue;
                ::close(socket);
                socket = connected();
            }
        }
    }

    int port_;
    Slowness slowness_;
    std::array<int, slow_count> sockets_{};
    std::jthread thread_;
};

class SlowServing : public ::testing::Test {
protected:
    void SetUp() override {
        thread_ = std::thread([this] { server_.run(); });
        while (!httplib::Client("127.0.0.1", server_.port()).Get("/nowhere")) {
            std::this_thread::sleep_for(milliseconds(1));
        }
    }
    void TearDown() override {
        server_.stop();
        thread_.join();
    }

    [[nodiscard]] std::vector<Slowness> kinds() const {
        const std::string host = "Host: 127.0.0.1:" + std::to_string(server_.port()) + "\r\n";
        const std::string token = std::string(token_header) + ": " + server_.token() + "\r\n";
        const std::string body = "POST /api/simulate HTTP/1.1\r\n" + host + token + "Content-Length: 9999999\r\n\r\n";
        std::string unread;
        for (int i = 0; i < 2000; ++i) unread += "GET /app.js HTTP/1.1\r\n" + host + "\r\n";
        return {{.name = "silent", .begin = "", .drip = ""},
                {.name = "a first line that drips", .begin = "G", .drip = "E"},
                {.name = "a header that drips", .begin = "GET / HTTP/1.1\r\n" + host + "X-Pad: ", .drip = "x"},
                {.name = "a body that drips", .begin = body, .drip = "["},
                {.name = "answers that nobody reads", .begin = unread, .drip = ""}};
    }

    Api api_{test::no_cache(), std::nullopt};
    Server server_{api_, 0};
    std::thread thread_;
};

TEST_F(SlowServing, AHundredSlowClientsDelayNobody) {
    for (const Slowness& slowness : kinds()) {
        const SlowClients slow(server_.port(), slowness);
        std::this_thread::sleep_for(milliseconds(200));
        for (int i = 0; i < 10; ++i) {
            const Clock::time_point begin = Clock::now();
            httplib::Client client("127.0.0.1", server_.port());
            const httplib::Result result =
                client.Post("/api/simulate", {{token_header, server_.token()}}, "{}", "application/json");
            const auto lasted = std::chrono::duration_cast<milliseconds>(Clock::now() - begin);
            ASSERT_TRUE(result) << slowness.name;
            EXPECT_EQ(result->status, 200) << slowness.name;
            ASSERT_LT(lasted, patience) << slowness.name << ", request " << i;
        }
    }
}

TEST_F(SlowServing, TheServerEndsInSpiteOfThem) {
    for (const Slowness& slowness : kinds()) {
        Server server(api_, 0);
        std::thread serving([&server] { server.run(); });
        while (!httplib::Client("127.0.0.1", server.port()).Get("/nowhere")) {
            std::this_thread::sleep_for(milliseconds(1));
        }
        const SlowClients slow(server.port(), slowness);
        std::this_thread::sleep_for(milliseconds(200));
        const Clock::time_point begin = Clock::now();
        server.stop();
        serving.join();
        EXPECT_LT(Clock::now() - begin, patience) << slowness.name;
    }
}

TEST_F(SlowServing, AConnectionServesManyRequestsAlsoSentAtOnce) {
    httplib::Client client("127.0.0.1", server_.port());
    client.set_keep_alive(true);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(client.Get("/nowhere")->status, 403);
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(server_.port()));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    const std::string request =
        "GET /nowhere HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server_.port()) + "\r\n\r\n";
    const std::string three = request + request + request;
    ASSERT_EQ(::send(socket, three.data(), three.size(), 0), static_cast<ssize_t>(three.size()));
    ASSERT_EQ(::shutdown(socket, SHUT_WR), 0);
    std::string answer;
    std::array<char, 4096> part{};
    for (ssize_t size = 0; (size = ::recv(socket, part.data(), part.size(), 0)) > 0;) answer.append(part.data(), size);
    ::close(socket);
    std::size_t answers = 0;
    for (std::size_t at = 0; (at = answer.find("HTTP/1.1 403", at)) != std::string::npos; ++at) ++answers;
    EXPECT_EQ(answers, 3U);
}

}  // namespace
}  // namespace skinfit
