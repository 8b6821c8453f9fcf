#include "explore/connections.hpp"

#include <sys/socket.h>

#include <algorithm>

namespace skinfit {

Connections::Served::Served(Connections& all, int socket) : all_(&all) {
    const std::scoped_lock lock(all_->mutex_);
    all_->served_.insert_or_assign(std::this_thread::get_id(), Connection{socket, Clock::now()});
}

Connections::Served::~Served() {
    const std::scoped_lock lock(all_->mutex_);
    all_->served_.erase(std::this_thread::get_id());
}

Connections::Answering::Answering(Connections& all) : all_(&all) {
    const std::scoped_lock lock(all_->mutex_);
    const auto found = all_->served_.find(std::this_thread::get_id());
    if (found != all_->served_.end()) found->second.waits_since.reset();
}

Connections::Answering::~Answering() {
    const std::scoped_lock lock(all_->mutex_);
    const auto found = all_->served_.find(std::this_thread::get_id());
    if (found != all_->served_.end()) found->second.waits_since = Clock::now();
}

void Connections::end(Connection& connection) {
    // Its worker sees the end of the connection and closes the socket.
    (void)::shutdown(connection.socket, SHUT_RDWR);
    connection.waits_since.reset();
}

bool Connections::end_longest_waiting() {
    const std::scoped_lock lock(mutex_);
    Connection* longest = nullptr;
    for (auto& [worker, connection] : served_) {
        if (!connection.waits_since) continue;
        if (longest == nullptr || connection.waits_since < longest->waits_since) longest = &connection;
    }
    if (longest == nullptr) return false;
    end(*longest);
    return true;
}

void Connections::end_waiting(Clock::duration at_least) {
    const std::scoped_lock lock(mutex_);
    const Clock::time_point since = Clock::now() - at_least;
    for (auto& [worker, connection] : served_) {
        if (connection.waits_since && *connection.waits_since <= since) end(connection);
    }
}

}  // namespace skinfit
