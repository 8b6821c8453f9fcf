#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

namespace skinfit {

/// The connections that the workers of a server serve, one each, and which of them only wait: for the rest of a
/// request, for another one, or for an answer to be taken. A client that drips its request waits for ever; it is ended
/// where its worker is needed. Calls may come from any thread; `Served` and `Answering` belong to the thread of the
/// worker.
class Connections {
public:
    using Clock = std::chrono::steady_clock;

    /// The calling worker serves `socket` until the end of the object, which comes before the socket is closed.
    class Served {
    public:
        Served(Connections& all, int socket);
        ~Served();
        Served(const Served&) = delete;
        Served& operator=(const Served&) = delete;

    private:
        Connections* all_;
    };

    /// The calling worker computes an answer until the end of the object: its connection does not wait meanwhile.
    class Answering {
    public:
        explicit Answering(Connections& all);
        ~Answering();
        Answering(const Answering&) = delete;
        Answering& operator=(const Answering&) = delete;

    private:
        Connections* all_;
    };

    /// Ends the connection that has waited longest, whose worker is free at once. False where none waits.
    bool end_longest_waiting();

    /// Ends all that have waited for that long.
    void end_waiting(Clock::duration at_least);

private:
    struct Connection {
        int socket;
        std::optional<Clock::time_point> waits_since;  ///< none while it is answered, or once it has been ended
    };
    static void end(Connection& connection);

    std::mutex mutex_;
    std::map<std::thread::id, Connection> served_;
};

}  // namespace skinfit
