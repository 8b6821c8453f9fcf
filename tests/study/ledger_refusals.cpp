#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "study/cube_ledger.hpp"
#include "study/ledger_schema.hpp"
#include "tests/study/example_ledger.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using test::example_answers;
using test::example_roster;
using test::refusal_of;

constexpr std::size_t spectra = 60;

class Refusals : public test::TemporaryFolder {
protected:
    [[nodiscard]] std::filesystem::path path() const { return in_folder("ledger.sqlite"); }
    void write_ledger() const {
        Ledger ledger(path(), Ledger::Access::write);
        (void)ledger.take(example_roster(spectra), "settings");
        ledger.store(example_answers(example_roster(spectra - 1)));
        take_cubes(ledger, {{.source = "c.hdr", .metadata = {}, .input_hash = "i", .problem = {}, .tiles = {{0, 4}}}},
                   "settings");
        store_tile(ledger, "c.hdr", {.tile = {0, 4}, .pixels = {1, 2, 3}, .bytes = "bytes"});
    }
    /// What opening, either way, and reading say of the file; who refuses it leaves its bytes alone.
    [[nodiscard]] std::vector<std::string> complaints() const {
        const std::string before = read_file(path());
        std::vector<std::string> said;
        said.push_back(refusal_of([&] {
            const Ledger ledger(path(), Ledger::Access::read);
            (void)ledger.counts();
            (void)ledger.rows();
            (void)cube_rows(ledger);
        }));
        said.push_back(refusal_of([&] { const Ledger ledger(path(), Ledger::Access::write); }));
        EXPECT_TRUE(said[1].empty() || read_file(path()) == before) << said[1];
        return said;
    }
    void expect_complaint(const std::string& words) const {
        for (const std::string& said : complaints()) {
            EXPECT_NE(said.find(path().string() + ": " + words), std::string::npos) << said;
        }
    }
    void make_database(const std::vector<std::string>& statements) const {
        SQLite::Database database(path().string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        for (const std::string& statement : statements) (void)database.tryExec(statement);
    }
};

TEST_F(Refusals, OfAFileThatIsNoDatabase) {
    write_file_atomically(path(), std::string(5000, 'a'));
    expect_complaint("is no ledger (file is not a database)");
}

TEST_F(Refusals, OfADatabaseOfAnotherProgram) {
    make_database({"CREATE TABLE spectra (id INTEGER)"});
    expect_complaint("is no ledger (it is a database of another program)");
}

TEST_F(Refusals, OfAnEmptyDatabaseOfAnotherProgram) {
    make_database({"PRAGMA application_id = 42"});
    expect_complaint("is no ledger (it is a database of another program)");
}

TEST_F(Refusals, OfALaterVersion) {
    write_ledger();
    make_database({"PRAGMA user_version = 1"});
    expect_complaint("has tables of version 1 (this program knows version 2); use the program that wrote it");
}

TEST_F(Refusals, OfALedgerThatIsNotThere) {
    EXPECT_EQ(refusal_of([&] { const Ledger ledger(path(), Ledger::Access::read); }),
              path().string() + ": there is no ledger (the study has not been run); run it with `skinfit study run`");
    EXPECT_EQ(entries(), 0);
    EXPECT_NE(refusal_of([&] {
                  const Ledger ledger(in_folder("no/l.sqlite"), Ledger::Access::write);
              }).find("cannot be opened"),
              std::string::npos);
}

TEST_F(Refusals, OfATruncatedLedger) {
    write_ledger();
    const std::string whole = read_file(path());
    ASSERT_EQ(complaints(), (std::vector<std::string>{"", ""}));
    ASSERT_GT(whole.size(), 40000U);
    for (const std::size_t size : {whole.size() - 4096, whole.size() / 2, std::size_t{8192}, std::size_t{100}}) {
        write_file_atomically(path(), whole.substr(0, size));
        for (const std::string& said : complaints()) {
            EXPECT_TRUE(said.find(": is damaged (") != std::string::npos ||
                        said.find(": is no ledger (") != std::string::npos)
                << size << ": " << said;
        }
    }
}

/// Whatever bits have changed: either nothing is said, or that the ledger is damaged, no ledger or of another version;
/// never is there another exception. Many places must be noticed for the test to mean anything.
TEST_F(Refusals, OfALedgerWithChangedBits) {
    write_ledger();
    const std::string whole = read_file(path());
    std::size_t noticed = 0;
    std::uint64_t state = 5;
    for (int i = 0; i < 150; ++i) {
        std::string other = whole;
        for (int k = 0; k < 3; ++k) {
            state = state * 6364136223846793005U + 1442695040888963407U;
            const std::size_t at = (state >> 20U) % (i % 3 == 0 ? 100 : whole.size());
            other[at] = static_cast<char>(other[at] ^ (1 << (state >> 60U) % 8));
        }
        write_file_atomically(path(), other);
        for (const std::string& said : complaints()) noticed += said.empty() ? 0U : 1U;
    }
    EXPECT_GT(noticed, 60U);
}

/// Text that is no JSON any more, in pages that are in order.
TEST_F(Refusals, OfTextsThatMakeNoSense) {
    for (const std::string change :
         {"UPDATE spectra SET parameters = '[{\"name\":1}]'", "UPDATE spectra SET correlation = '[nu'",
          "UPDATE spectra SET metadata = '{\"a\":1}'", R"(UPDATE spectra SET indices = '[{"name":"x"}]')",
          "UPDATE tiles SET counts = '{\"fit\":1}'", "UPDATE cubes SET metadata = '['"}) {
        write_ledger();
        make_database({change});
        EXPECT_NE(complaints()[0].find(path().string() + ": is damaged ("), std::string::npos) << change;
        std::filesystem::remove(path());
    }
}

/// Fills the ledger until `store` complains; what was stored before must stand.
std::string fill(Ledger& ledger, std::size_t& stored) {
    const std::vector<Ledger::Answer> answers = example_answers(example_roster(spectra));
    return refusal_of([&] {
        for (stored = 0; stored < answers.size(); ++stored) ledger.store({&answers[stored], 1});
    });
}

TEST_F(Refusals, OfAFullDatabaseKeepWhatWasStored) {
    Ledger ledger(path(), Ledger::Access::write);
    (void)ledger.take(example_roster(spectra), "settings");
    const int pages = ledger.database().execAndGet("PRAGMA page_count").getInt();
    ledger.database().exec("PRAGMA max_page_count = " + std::to_string(pages + 4));
    std::size_t stored = 0;
    EXPECT_EQ(fill(ledger, stored), path().string() +
                                        ": cannot grow (database or disk is full); make space and run the study "
                                        "again: everything stored so far is kept");
    EXPECT_GT(stored, 0U);
    EXPECT_EQ(ledger.pending("a.csv").size(), spectra - stored);
    ledger.database().exec("PRAGMA max_page_count = 1000000");  // there is space again
    EXPECT_EQ(fill(ledger, stored), "");
    EXPECT_TRUE(ledger.pending("a.csv").empty());
}

/// The exit status of a process that does `work`.
int in_child(const std::function<int()>& work) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(work());
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A file that may not grow, as on a full disk.
TEST_F(Refusals, OfAFileThatCannotGrowKeepWhatWasStored) {
    const int status = in_child([&] {
        Ledger ledger(path(), Ledger::Access::write);
        (void)ledger.take(example_roster(spectra), "settings");
        ::signal(SIGXFSZ, SIG_IGN);
        const auto size = std::filesystem::file_size(path().string() + "-wal") + 60000;
        const rlimit limit{.rlim_cur = size, .rlim_max = RLIM_INFINITY};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        std::size_t stored = 0;
        const std::string said = fill(ledger, stored);
        if (said.find("ledger.sqlite: cannot ") == std::string::npos || stored == 0) return 1;
        if (ledger.pending("a.csv").size() != spectra - stored) return 2;
        const rlimit none{.rlim_cur = RLIM_INFINITY, .rlim_max = RLIM_INFINITY};
        ::setrlimit(RLIMIT_FSIZE, &none);
        return fill(ledger, stored).empty() && ledger.pending("a.csv").empty() ? 0 : 3;
    });
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(Ledger(path(), Ledger::Access::read).pending("a.csv").empty());
}

/// In a folder that may only be read, with a name that a URI would misread: a reader reads, a writer is refused; with
/// answers that lie in a log beside the ledger, the reader is refused too, since it could not see them.
TEST_F(Refusals, OfAFolderThatMayOnlyBeRead) {
    constexpr uid_t nobody = 65534;
    if (::getuid() != 0) GTEST_SKIP() << "only root can become somebody else";
    const std::filesystem::path folder = in_folder("100%41 ?#");
    std::filesystem::create_directory(folder);
    write_ledger();
    const std::filesystem::path there = folder / "ledger.sqlite";
    std::filesystem::copy_file(path(), there);
    for (const std::filesystem::path& each : {in_folder(""), folder}) {
        std::filesystem::permissions(each, std::filesystem::perms(0755));
    }
    const auto as_nobody = [&](const std::function<int()>& work) {
        return in_child([&] { return ::setuid(nobody) == 0 ? work() : 9; });
    };
    EXPECT_EQ(as_nobody([&] { return Ledger(there, Ledger::Access::read).rows().size() == spectra ? 0 : 1; }), 0);
    EXPECT_EQ(as_nobody([&] {
                  const std::string said = refusal_of([&] { const Ledger ledger(there, Ledger::Access::write); });
                  return said.find("cannot be opened") != std::string::npos ? 0 : 1;
              }),
              0);
    write_file_atomically(there.string() + "-wal", std::string(100, 'x'));
    EXPECT_EQ(as_nobody([&] {
                  const std::string said = refusal_of([&] { (void)Ledger(there, Ledger::Access::read).rows(); });
                  return said.find("cannot be opened") != std::string::npos ? 0 : 1;
              }),
              0);
}

}  // namespace
}  // namespace skinfit
