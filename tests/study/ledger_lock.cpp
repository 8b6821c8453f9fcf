#include "study/ledger_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <string>

#include "tests/study/example_ledger.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using test::refusal_of;

class LockLaws : public test::TemporaryFolder {};

/// Another process that does `work` and then waits to be killed.
class Other {
public:
    template <class Work>
    explicit Other(const Work& work) {
        std::array<int, 2> pipe{};
        EXPECT_EQ(::pipe(pipe.data()), 0);
        process_ = ::fork();
        if (process_ == 0) {
            work();
            (void)!::write(pipe[1], "x", 1);
            while (true) ::pause();
        }
        char ready = 0;
        EXPECT_EQ(::read(pipe[0], &ready, 1), 1);
        ::close(pipe[0]);
        ::close(pipe[1]);
    }
    Other(const Other&) = delete;
    Other& operator=(const Other&) = delete;
    ~Other() { kill(); }

    void kill() {
        if (process_ <= 0) return;
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
        process_ = 0;
    }
    [[nodiscard]] pid_t process() const { return process_; }

private:
    pid_t process_ = 0;
};

TEST_F(LockLaws, ASecondIsRefusedAndTheHolderNamed) {
    const std::filesystem::path ledger = in_folder("ledger.sqlite");
    const LedgerLock lock(ledger);
    const std::string complaint = refusal_of([&] { const LedgerLock second(ledger); });
    EXPECT_NE(complaint.find(ledger.string() + ": is in use (process " + std::to_string(::getpid()) + " on "),
              std::string::npos)
        << complaint;
    EXPECT_EQ(refusal_of([&] { const LedgerLock other(in_folder("other.sqlite")); }), "");
}

TEST_F(LockLaws, IsFreeWhenItsHolderIsDone) {
    const std::filesystem::path ledger = in_folder("ledger.sqlite");
    { const LedgerLock lock(ledger); }
    LedgerLock lock(ledger);
    const LedgerLock moved(std::move(lock));
    EXPECT_NE(refusal_of([&] { const LedgerLock second(ledger); }), "");
}

TEST_F(LockLaws, IsFreeWhenItsProcessIsKilled) {
    const std::filesystem::path ledger = in_folder("ledger.sqlite");
    Other other([&] { new LedgerLock(ledger); });
    const std::string complaint = refusal_of([&] { const LedgerLock lock(ledger); });
    EXPECT_NE(complaint.find("process " + std::to_string(other.process()) + " on "), std::string::npos) << complaint;
    other.kill();
    EXPECT_EQ(refusal_of([&] { const LedgerLock lock(ledger); }), "");
}

TEST_F(LockLaws, WithoutAFolderThereIsNone) {
    const std::string complaint = refusal_of([&] { const LedgerLock lock(in_folder("no/ledger.sqlite")); });
    EXPECT_NE(complaint.find("cannot be written (No such file or directory)"), std::string::npos) << complaint;
}

/// Whatever a process that is killed had stored stands; what it was about to store does not.
TEST_F(LockLaws, AKilledWriterLosesNothingThatItStored) {
    const std::filesystem::path path = in_folder("ledger.sqlite");
    const std::vector<RosterEntry> roster = test::example_roster(3);
    Other other([&] {
        auto* const ledger = new Ledger(path, Ledger::Access::write);
        (void)ledger->take(roster, "settings");
        ledger->store(test::example_answers(test::example_roster(2)));
    });
    other.kill();
    const std::string shown = test::shown_by(path);
    Ledger ledger(path, Ledger::Access::write);
    EXPECT_EQ(ledger.pending("a.csv").size(), 1U);
    EXPECT_EQ(ledger.take(roster, "settings").kept, 2U);
    EXPECT_EQ(test::shown_by(path), shown);
}

}  // namespace
}  // namespace skinfit
