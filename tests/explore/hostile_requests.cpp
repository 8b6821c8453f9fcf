// Before httplib, whose <resolv.h> makes a macro of a name that Eigen uses.
#include "explore/server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "explore/guard.hpp"

namespace skinfit {
namespace {

using Clock = std::chrono::steady_clock;

std::size_t resident_bytes() {
    std::ifstream file("/proc/self/statm");
    std::size_t all = 0;
    std::size_t resident = 0;
    file >> all >> resident;
    return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::ptrdiff_t open_files() {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
}

/// Requests that no browser sends, each of 4 KiB or more, so that a server that kept them would be seen to grow.
class Hostile {
public:
    Hostile(const Server& server, unsigned seed) : server_(&server), random_(seed) {}

    [[nodiscard]] std::string request() {
        const std::string host = "Host: 127.0.0.1:" + std::to_string(server_->port()) + "\r\n";
        const std::string token = std::string(token_header) + ": " + server_->token() + "\r\n";
        const std::string pad = "X-Pad: " + std::string(4096, 'x') + "\r\n";
        switch (random_() % 14) {
            case 0:
                return noise(5000);
            case 1:
                return "GET /" + std::string(9000, 'a') + " HTTP/1.1\r\n" + host + "\r\n";
            case 2:
                return "POST /api/simulate HTTP/1.1\r\n" + host + token + pad + "Content-Length: -1\r\n\r\n{}";
            case 3:
                return "POST /api/simulate HTTP/1.1\r\n" + host + token + pad +
                       "Content-Length: 99999999999999999999\r\n\r\n{}";
            case 4:
                return "POST /api/simulate HTTP/1.1\r\n" + host + token + pad +
                       "Transfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n{}";
            case 5:
                return body(host + token + pad, noise(500));
            case 6:
                return body(host + token + pad, "{\"configuration\": " + std::string(3000, '['));
            case 7:
                return body(host + pad, "{}");
            case 8:
                return "GET /../../etc/passwd HTTP/1.1\r\n" + host + token + pad + "\r\n";
            case 9:
                return "GET / HTTP/1.1\r\nHost: evil.example\r\n" + pad + "\r\n";
            case 10:
                return "POST /api/spectra?name=%00%ff%2e%2e HTTP/1.1\r\n" + host + token + pad +
                       "Content-Length: 600\r\n\r\n" + noise(600);
            case 11:
                return "DELETE /api/fit?name=" + noise(40) + " HTTP/1.1\r\n" + host + token + pad + "\r\n";
            case 12:
                return "GET / HTTP/1.1\r\n" + host + "Range: bytes=0-0,1-1,2-2,0-,-1\r\n" + pad + "\r\n";
            default:
                return mangled(body(host + token + pad, "{\"configuration\": {}}"));
        }
    }

private:
    static std::string body(const std::string& headers, const std::string& text) {
        return "POST /api/simulate HTTP/1.1\r\n" + headers + "Content-Length: " + std::to_string(text.size()) +
               "\r\n\r\n" + text;
    }
    [[nodiscard]] std::string noise(std::size_t size) {
        std::string text(size, ' ');
        for (char& c : text) c = static_cast<char>(random_());
        return text;
    }
    [[nodiscard]] std::string mangled(std::string text) {
        for (int i = 0; i < 8; ++i) text[random_() % text.size()] = static_cast<char>(random_());
        return text;
    }

    const Server* server_;
    std::mt19937 random_;
};

/// Sends `bytes` on a connection of its own and waits for the server to end it.
void send_and_close(int port, const std::string& bytes) {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
        (void)::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        (void)::shutdown(socket, SHUT_WR);
        std::array<char, 4096> answer{};
        while (::recv(socket, answer.data(), answer.size(), 0) > 0) {
        }
    }
    ::close(socket);
}

TEST(HostileRequests, FiveHundredASecondForTenSecondsNeitherCrashNorLeak) {
    constexpr int clients = 4;
    constexpr auto spacing = std::chrono::milliseconds(8);  // of each: 500 a second together
    constexpr auto lasting = std::chrono::seconds(10);
    Api api(DiskCache{.folder = std::nullopt, .warn = {}, .inform = {}}, std::nullopt);
    Server server(api, 0);
    std::thread serving([&server] { server.run(); });
    std::atomic<std::size_t> requests = 0;
    std::atomic<std::size_t> bytes = 0;
    const auto attack = [&](Clock::time_point end, unsigned seed) {
        Hostile hostile(server, seed);
        for (Clock::time_point next = Clock::now(); next < end; next += spacing) {
            std::this_thread::sleep_until(next);
            const std::string request = hostile.request();
            send_and_close(server.port(), request);
            ++requests;
            bytes += request.size();
        }
    };
    attack(Clock::now() + std::chrono::seconds(1), 0);  // pools and tables have their size afterwards
    const std::size_t resident_before = resident_bytes();
    const std::ptrdiff_t files_before = open_files();
    requests = bytes = 0;
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < clients; ++i) threads.emplace_back(attack, Clock::now() + lasting, i + 1);
    for (std::thread& thread : threads) thread.join();
    const std::size_t resident_after = resident_bytes();
    RecordProperty("requests", static_cast<int>(requests));
    RecordProperty("resident_growth_bytes", static_cast<int>(resident_after) - static_cast<int>(resident_before));
    // Had the server kept the requests, it would have grown by all they hold: half of that is a leak.
    EXPECT_LT(resident_after, resident_before + bytes / 2);
    EXPECT_GE(requests, 4900U);
    httplib::Client client("127.0.0.1", server.port());
    const httplib::Result result =
        client.Post("/api/simulate", {{token_header, server.token()}}, "{}", "application/json");
    ASSERT_TRUE(result);
    EXPECT_EQ(result->status, 200);
    client.stop();
    server.stop();
    serving.join();
    EXPECT_LE(open_files(), files_before);
}

}  // namespace
}  // namespace skinfit
