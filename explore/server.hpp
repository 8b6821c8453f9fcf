#pragma once

#include <memory>
#include <string>

#include "explore/api.hpp"

namespace skinfit {

/// The largest body of a request, bytes.
inline constexpr std::size_t largest_body_bytes = std::size_t{16} << 20U;

/// Serves the page and answers its requests, on 127.0.0.1 alone.
class Server {
public:
    /// Takes `port`, or a free one for 0. `api` must outlive it. Throws InputError where the port cannot be had.
    Server(Api& api, int port);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// On which it listens.
    [[nodiscard]] int port() const;
    /// Without which nothing is served.
    [[nodiscard]] const std::string& token() const;
    /// Where a browser finds the page; it holds the token.
    [[nodiscard]] std::string url() const;

    /// Answers requests until `stop`, which another thread calls.
    void run();
    void stop();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace skinfit
