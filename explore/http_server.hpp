#pragma once

#include <httplib.h>

#include "explore/connections.hpp"

namespace skinfit {

/// The server of httplib where a slow client keeps no other out: a new connection that finds all workers busy ends the
/// one that has waited longest.
class HttpServer : public httplib::Server {
public:
    HttpServer();

    /// Of the address 127.0.0.1, 0 for a free one; the port, or nothing where it cannot be had.
    [[nodiscard]] std::optional<int> bind(int port);

    [[nodiscard]] Connections& connections() { return connections_; }

private:
    bool process_and_close_socket(socket_t socket) override;

    Connections connections_;
};

}  // namespace skinfit
