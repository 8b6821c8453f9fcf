#include "explore/http_server.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstring>

namespace skinfit {
namespace {

constexpr const char* loopback = "127.0.0.1";
constexpr int progress_timeout_ms = 5000;    // chosen: without a byte of a request or answer a connection ends
constexpr int keep_alive_timeout_ms = 2000;  // chosen: between two requests of one connection

/// As many threads as a browser opens connections, and no more of them waiting than a few browsers open: who comes
/// later waits to be accepted.
class BoundedPool : public httplib::ThreadPool {
public:
    explicit BoundedPool(Connections& connections) : httplib::ThreadPool(threads), connections_(&connections) {}

    void enqueue(std::function<void()> work) override {
        std::unique_lock lock(mutex_);
        room_.wait(lock, [this] { return pending_ < most_pending; });
        ++pending_;
        const bool are_all_busy = pending_ > threads;
        lock.unlock();
        httplib::ThreadPool::enqueue([this, work = std::move(work)] {
            work();
            const std::scoped_lock done(mutex_);
            --pending_;
            room_.notify_one();
        });
        if (are_all_busy) (void)connections_->end_longest_waiting();
    }

private:
    static constexpr std::size_t threads = 12;
    static constexpr std::size_t most_pending = 48;
    Connections* connections_;
    std::mutex mutex_;
    std::condition_variable room_;
    std::size_t pending_ = 0;
};

/// A second server on a port that is in use is refused, unlike by httplib's own options.
void take_port_alone(int socket) {
    const int yes = 1;
    (void)::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

/// The bytes of one connection.
class SocketStream : public httplib::Stream {
public:
    explicit SocketStream(int socket) : socket_(socket) {}

    [[nodiscard]] bool is_readable() const override { return has_buffered() || is_ready(POLLIN, progress_timeout_ms); }
    [[nodiscard]] bool is_writable() const override { return is_ready(POLLOUT, progress_timeout_ms); }
    /// Whether a request has begun within the time of `keep_alive_timeout_ms`.
    [[nodiscard]] bool has_request() const { return has_buffered() || is_ready(POLLIN, keep_alive_timeout_ms); }

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
        return is_writable() ? ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT) : -1;
    }

    /// Every client is of this machine; nobody asks for more.
    void get_remote_ip_and_port(std::string& ip, int& /*port*/) const override { ip = loopback; }
    void get_local_ip_and_port(std::string& ip, int& /*port*/) const override { ip = loopback; }
    [[nodiscard]] socket_t socket() const override { return socket_; }

private:
    [[nodiscard]] bool has_buffered() const { return begin_ < end_; }

    [[nodiscard]] bool is_ready(short events, int timeout_ms) const {
        pollfd waiting{.fd = socket_, .events = events, .revents = 0};
        int ready = 0;
        do {
            ready = ::poll(&waiting, 1, timeout_ms);
        } while (ready < 0 && errno == EINTR);
        return ready > 0;
    }

    int socket_;
    std::array<char, 16384> buffer_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
};

}  // namespace

HttpServer::HttpServer() {
    new_task_queue = [this] { return new BoundedPool(connections_); };
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

bool HttpServer::process_and_close_socket(socket_t socket) {
    bool is_good = true;
    {
        const Connections::Served served(connections_, socket);
        SocketStream stream(socket);
        bool is_closed = false;
        for (std::size_t left = keep_alive_max_count_; is_good && !is_closed && left > 0; --left) {
            if (svr_sock_ == INVALID_SOCKET || !stream.has_request()) break;
            is_good = process_request(stream, left == 1, is_closed, nullptr);
        }
    }
    (void)::shutdown(socket, SHUT_RDWR);
    (void)::close(socket);
    return is_good;
}

}  // namespace skinfit
