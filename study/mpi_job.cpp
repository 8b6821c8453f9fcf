#include "study/mpi_job.hpp"

#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <optional>

namespace skinfit {
namespace {

enum Tag : int { ask_tag = 1, task_tag, result_tag, dismissal_tag, farewell_tag };

constexpr int leader = 0;

/// A number in front of bytes.
std::string addressed(std::size_t number, const std::string& bytes) {
    std::string message(sizeof(std::uint64_t), '\0');
    const std::uint64_t wide = number;
    std::memcpy(message.data(), &wide, sizeof wide);
    return message + bytes;
}

DoneTask taken_apart(const std::string& message) {
    std::uint64_t number = 0;
    std::memcpy(&number, message.data(), sizeof number);
    return {.number = number, .result = message.substr(sizeof number)};
}

void send(int rank, Tag tag, const std::string& bytes) {
    MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_CHAR, rank, tag, MPI_COMM_WORLD);
}

struct Message {
    int rank;
    int tag;
    std::string bytes;
};

/// What has arrived, if anything has.
std::optional<Message> arrived() {
    int is_there = 0;
    MPI_Status status{};
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status);
    if (is_there == 0) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_CHAR, &size);
    Message message{
        .rank = status.MPI_SOURCE, .tag = status.MPI_TAG, .bytes = std::string(static_cast<std::size_t>(size), '\0')};
    MPI_Recv(message.bytes.data(), size, MPI_CHAR, message.rank, message.tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
}

}  // namespace

MpiJob::MpiJob() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    waiting_.assign(static_cast<std::size_t>(size_), 0);
}

MpiJob::~MpiJob() {
    if (leads()) {
        for (int rank = 1; rank < size_; ++rank) send(rank, dismissal_tag, {});
        // Results that are on their way are taken off it, so that no process waits for its to be received.
        for (int left = size_ - 1; left > 0;) {
            const std::optional<Message> message = arrived();
            if (message && message->tag == farewell_tag) --left;
        }
    }
    MPI_Finalize();
}

RemoteWorkers MpiJob::followers() {
    return {.receive = [this] { return receive(); },
            .give = [this](std::size_t number, const std::string& task) { return give(number, task); }};
}

std::vector<DoneTask> MpiJob::receive() {
    std::vector<DoneTask> done;
    while (const std::optional<Message> message = arrived()) {
        std::size_t& waiting = waiting_[static_cast<std::size_t>(message->rank)];
        if (message->tag == ask_tag) {
            waiting += taken_apart(message->bytes).number;
        } else {
            ++waiting;
            done.push_back(taken_apart(message->bytes));
        }
    }
    return done;
}

bool MpiJob::give(std::size_t number, const std::string& task) {
    for (std::size_t rank = 1; rank < waiting_.size(); ++rank) {
        if (waiting_[rank] == 0) continue;
        --waiting_[rank];
        send(static_cast<int>(rank), task_tag, addressed(number, task));
        return true;
    }
    return false;
}

void MpiJob::follow(WorkerThreads& threads) const {
    send(leader, ask_tag, addressed(threads.capacity(), {}));
    while (true) {
        if (const std::optional<Message> message = arrived()) {
            if (message->tag == dismissal_tag) {
                send(leader, farewell_tag, {});
                return;
            }
            const DoneTask task = taken_apart(message->bytes);
            threads.give(task.number, task.result);
        }
        if (const std::optional<DoneTask> done = threads.take(std::chrono::milliseconds(1))) {
            send(leader, result_tag, addressed(done->number, done->result));
        }
    }
}

}  // namespace skinfit
