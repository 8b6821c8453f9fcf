#pragma once

#include <httplib.h>

#include <atomic>
#include <cstddef>
#include <optional>

namespace skinfit {

/// How much is asked of the workers of a server. Counted by any thread.
struct Demand {
    std::atomic<std::size_t> connections = 0;  ///< served, or waiting for a worker
    std::atomic<bool> ends = false;            ///< the server is to end
};

/// The server of httplib where a slow client keeps no other out: where connections wait for a worker, one whose request
/// does not come, or whose answer is not taken, is ended soon.
class HttpServer : public httplib::Server {
public:
    HttpServer();

    /// Takes `port` of 127.0.0.1, or a free one for 0; gives it, or nothing where it cannot be had.
    [[nodiscard]] std::optional<int> bind(int port);

    /// Ends the server, and soon all connections that are not being answered.
    void end();

private:
    bool process_and_close_socket(socket_t socket) override;

    Demand demand_;
};

}  // namespace skinfit
