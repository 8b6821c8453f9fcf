#include "explore/http_server.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>

namespace skinfit {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr const char* loopback = "127.0.0.1";
constexpr std::size_t workers = 24;       // chosen: twelve for each of two browser windows
constexpr std::size_t most_pending = 96;  // chosen: who comes later waits to be accepted
// Chosen. For the next byte; for the next request; and, where others wait, for a whole request or answer: of this
// machine it comes within a millisecond.
constexpr milliseconds byte_patience{5000};
constexpr milliseconds request_patience{2000};
constexpr milliseconds patience_in_demand{50};
constexpr int send_buffer_bytes = 1 << 17;  // chosen: of an answer that is not taken, no more waits in the system
constexpr milliseconds glance{20};          // how often a worker that waits looks whether others do

class BoundedPool : public httplib::ThreadPool {
public:
    explicit BoundedPool(Demand& demand) : httplib::ThreadPool(workers), demand_(&demand) {}

    void enqueue(std::function<void()> work) override {
        std::unique_lock lock(mutex_);
        room_.wait(lock, [this] { return demand_->connections < most_pending; });
        ++demand_->connections;
        lock.unlock();
        httplib::ThreadPool::enqueue([this, work = std::move(work)] {
            work();
            const std::scoped_lock done(mutex_);
            --demand_->connections;
            room_.notify_one();
        });
    }

private:
    Demand* demand_;
    std::mutex mutex_;
    std::condition_variable room_;
};

/// A second server on a port that is in use is refused, unlike by httplib's own options.
void take_port_alone(int socket) {
    const int yes = 1;
    (void)::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

/// The bytes of one connection. A read or write fails where the client takes too long.
class SocketStream : public httplib::Stream {
public:
    SocketStream(int socket, const Demand& demand) : socket_(socket), demand_(&demand) {}

    /// Waits for the next request; none comes after an answer that could not be sent.
    [[nodiscard]] bool has_request() {
        if (failed_) return false;
        begin_waiting(false);
        const bool has = has_buffered() || comes(POLLIN, request_patience);
        begin_waiting(false);
        return has;
    }

    [[nodiscard]] bool is_readable() const override { return has_buffered() || comes(POLLIN, byte_patience); }
    [[nodiscard]] bool is_writable() const override { return comes(POLLOUT, byte_patience); }

    ssize_t read(char* bytes, std::size_t size) override {
        if (!has_buffered()) {
            if (!is_readable()) return -1;
            const ssize_t received = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
            if (received <= 0) return received;
            begin_ = 0;
            end_ = static_cast<std::size_t>(received);
        }
        const std::size_t taken = std::min(size, end_ - begin_);
        std::memcpy(bytes, buffer_.data() + begin_, taken);
        begin_ += taken;
        return static_cast<ssize_t>(taken);
    }

    ssize_t write(const char* bytes, std::size_t size) override {
        if (!writes_) begin_waiting(true);  // the time it took to find the answer is not the client's
        const ssize_t sent = is_writable() ? ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT) : -1;
        failed_ = sent < 0;
        return sent;
    }

    /// Every client is of this machine; nobody asks for more.
    void get_remote_ip_and_port(std::string& ip, int& /*port*/) const override { ip = loopback; }
    void get_local_ip_and_port(std::string& ip, int& /*port*/) const override { ip = loopback; }
    [[nodiscard]] socket_t socket() const override { return socket_; }

private:
    [[nodiscard]] bool has_buffered() const { return begin_ < end_; }

    void begin_waiting(bool writes) {
        writes_ = writes;
        since_ = Clock::now();
    }

    /// A client that drips is never late with the next byte, but with the whole.
    [[nodiscard]] bool keeps_others_waiting() const {
        const bool in_demand = demand_->connections > workers || demand_->ends;
        return in_demand && Clock::now() - since_ > patience_in_demand;
    }

    [[nodiscard]] bool comes(short event, milliseconds patience) const {
        const Clock::time_point end = Clock::now() + patience;
        while (!keeps_others_waiting()) {
            pollfd waiting{.fd = socket_, .events = event, .revents = 0};
            const int ready = ::poll(&waiting, 1, static_cast<int>(glance.count()));
            if (ready > 0) return true;
            if ((ready < 0 && errno != EINTR) || Clock::now() > end) return false;
        }
        return false;
    }

    int socket_;
    const Demand* demand_;
    std::array<char, 16384> buffer_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
    bool writes_ = false;
    bool failed_ = false;                     ///< httplib does not say when an answer could not be sent
    Clock::time_point since_ = Clock::now();  ///< the client is waited for
};

}  // namespace

HttpServer::HttpServer() {
    new_task_queue = [this] { return new BoundedPool(demand_); };
    set_socket_options(take_port_alone);
    set_tcp_nodelay(true);
    set_keep_alive_max_count(100'000);
}

std::optional<int> HttpServer::bind(int port) {
    const int taken = port == 0 ? bind_to_any_port(loopback) : bind_to_port(loopback, port) ? port : -1;
    if (taken <= 0) return std::nullopt;
    // httplib lets five wait to be accepted; the next would try again after a second.
    (void)::listen(svr_sock_, SOMAXCONN);
    return taken;
}

void HttpServer::end() {
    demand_.ends = true;
    stop();
}

bool HttpServer::process_and_close_socket(socket_t socket) {
    (void)::setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &send_buffer_bytes, sizeof send_buffer_bytes);
    SocketStream stream(socket, demand_);
    bool is_good = true;
    bool is_closed = false;
    for (std::size_t left = keep_alive_max_count_; is_good && !is_closed && left > 0; --left) {
        if (demand_.ends || !stream.has_request()) break;
        is_good = process_request(stream, left == 1, is_closed, nullptr);
    }
    (void)::shutdown(socket, SHUT_RDWR);
    (void)::close(socket);
    return is_good;
}

}  // namespace skinfit
