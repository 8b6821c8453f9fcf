#include "core/file_replacement.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <string>
#include <thread>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/unfinished.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

namespace fs = std::filesystem;
using test::refusal_of;

const std::string leftover_name = ".skinfit-0123456789abcdef.part";

class FileReplacements : public test::TemporaryFolder {
protected:
    [[nodiscard]] fs::perms permissions(const std::string& name) const {
        return fs::status(in_folder(name)).permissions();
    }

    /// Another process that does `work` and ends as `work` says, or waits to be killed.
    template <class Work>
    static pid_t forked(const Work& work) {
        std::array<int, 2> pipe{};
        EXPECT_EQ(::pipe(pipe.data()), 0);
        const pid_t process = ::fork();
        if (process == 0) {
            work();
            (void)!::write(pipe[1], "x", 1);
            while (true) ::pause();
        }
        ::close(pipe[1]);
        char ready = 0;
        (void)!::read(pipe[0], &ready, 1);
        ::close(pipe[0]);
        return process;
    }
};

TEST_F(FileReplacements, NoLinkIsFollowedOrReplaced) {
    write_file_atomically(in_folder("victim"), "kept");
    fs::create_directory(in_folder("folder"));
    for (const std::string target : {"victim", "missing", "folder", "/dev/null", "link"}) {
        fs::create_symlink(target, in_folder("link"));
        for (const auto& write : {+[](const fs::path& path) { write_file_atomically(path, "x"); },
                                  +[](const fs::path& path) { write_scratch_file_atomically(path, {}); },
                                  +[](const fs::path& path) { check_writable(path); }}) {
            const std::string complaint = refusal_of([&] { write(in_folder("link")); });
            EXPECT_TRUE(complaint.starts_with(in_folder("link").string() + ": cannot be written (it is a link"))
                << target << ": " << complaint;
        }
        EXPECT_EQ(fs::read_symlink(in_folder("link")), target);
        fs::remove(in_folder("link"));
    }
    EXPECT_EQ(read_file(in_folder("victim")), "kept");
    EXPECT_EQ(entries(), 2);
}

TEST_F(FileReplacements, PipesAndDevicesAreNotReplaced) {
    ASSERT_EQ(::mkfifo(in_folder("pipe").c_str(), 0600), 0);
    const std::string complaint = refusal_of([&] { const FileReplacement file(in_folder("pipe")); });
    EXPECT_NE(complaint.find("(it is a pipe or a device)"), std::string::npos) << complaint;
    EXPECT_TRUE(fs::is_fifo(in_folder("pipe")));
}

TEST_F(FileReplacements, AFileKeepsItsPermissions) {
    for (const fs::perms kept : {fs::perms{0600}, fs::perms{0640}, fs::perms{0664}, fs::perms{0755}}) {
        write_file_atomically(in_folder("a"), "old");
        fs::permissions(in_folder("a"), kept);
        write_file_atomically(in_folder("a"), "new");
        EXPECT_EQ(permissions("a"), kept);
        EXPECT_EQ(read_file(in_folder("a")), "new");
    }
    write_scratch_file_atomically(in_folder("a"), {});
    EXPECT_EQ(permissions("a"), fs::perms{0600}) << "a scratch file is its owner's alone";
}

TEST_F(FileReplacements, AFileThatMustNotBeWrittenIsNotReplaced) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write every file";
    write_file_atomically(in_folder("a"), "old");
    fs::permissions(in_folder("a"), fs::perms{0400});
    EXPECT_NE(refusal_of([&] { write_file_atomically(in_folder("a"), "new"); }).find("(Permission denied)"),
              std::string::npos);
    EXPECT_EQ(read_file(in_folder("a")), "old");
}

TEST_F(FileReplacements, OwnerAndGroupStay) {
    if (::geteuid() != 0) GTEST_SKIP() << "only root gives files away";
    write_file_atomically(in_folder("a"), "old");
    constexpr uid_t nobody = 65534;
    ASSERT_EQ(::chown(in_folder("a").c_str(), nobody, nobody), 0);
    write_file_atomically(in_folder("a"), "new");
    struct stat status {};
    ASSERT_EQ(::stat(in_folder("a").c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, nobody);
    EXPECT_EQ(status.st_gid, nobody);
}

/// The mask belongs to the process: a thread that changed it for a moment would open the files of the others.
TEST_F(FileReplacements, OtherThreadsMakeFilesByTheMaskMeanwhile) {
    const mode_t before = ::umask(077);
    std::atomic<bool> over = false;
    std::jthread writer([&] {
        for (int i = 0; i < 3000; ++i) write_scratch_file_atomically(in_folder("a"), {});
        over = true;
    });
    int open_to_others = 0;
    while (!over) {
        const int descriptor = ::open(in_folder("b").c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
        struct stat status {};
        ASSERT_EQ(::fstat(descriptor, &status), 0);
        ::close(descriptor);
        fs::remove(in_folder("b"));
        open_to_others += (status.st_mode & 077U) != 0 ? 1 : 0;
    }
    writer.join();
    ::umask(before);
    EXPECT_EQ(open_to_others, 0);
}

TEST_F(FileReplacements, WhatAKilledProcessLeavesIsRemovedByTheNext) {
    const pid_t process = forked([&] {
        auto* const file = new FileReplacement(in_folder("a"));
        file->append("half");
    });
    EXPECT_EQ(entries(), 1);
    check_writable(in_folder("b"));
    EXPECT_EQ(entries(), 1) << "it is being written";
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
    EXPECT_EQ(entries(), 1);
    check_writable(in_folder("b"));
    EXPECT_EQ(entries(), 0);
}

TEST_F(FileReplacements, AProcessThatEndsAtOnceLeavesNothing) {
    write_file_atomically(in_folder("a"), "old");
    const pid_t process = forked([&] {
        auto* const file = new FileReplacement(in_folder("a"));
        file->append("half");
        end_process(7);
    });
    int status = 0;
    ASSERT_EQ(::waitpid(process, &status, 0), process);
    EXPECT_EQ(WEXITSTATUS(status), 7);
    EXPECT_EQ(entries(), 1);
    EXPECT_EQ(read_file(in_folder("a")), "old");
}

TEST_F(FileReplacements, LeftoversAreKnownByNameKindOwnerAndLock) {
    for (const std::string name : {"skinfit-0123456789abcdef.part", ".skinfit-0123456789abcde.part",
                                   ".skinfit-0123456789ABCDEF.part", ".skinfit-0123456789abcdef.par", "a.part"}) {
        write_file_atomically(in_folder(name), "kept");
    }
    fs::create_directory(in_folder(".skinfit-000000000000000a.part"));
    fs::create_symlink("a.part", in_folder(".skinfit-000000000000000b.part"));
    const std::ptrdiff_t others = entries();
    write_file_atomically(in_folder(leftover_name), "half");
    const int descriptor = ::open(in_folder(leftover_name).c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
    remove_leftovers(in_folder(""));
    EXPECT_EQ(entries(), others + 1) << "somebody holds it";
    ::close(descriptor);
    remove_leftovers(in_folder(""));
    EXPECT_EQ(entries(), others);
    EXPECT_FALSE(fs::exists(in_folder(leftover_name)));
    if (::geteuid() != 0) return;
    write_file_atomically(in_folder(leftover_name), "another user's");
    ASSERT_EQ(::chown(in_folder(leftover_name).c_str(), 65534, 65534), 0);
    remove_leftovers(in_folder(""));
    EXPECT_TRUE(fs::exists(in_folder(leftover_name)));
}

TEST_F(FileReplacements, LongNamesCanBeWritten) {
    const std::string name(255, 'n');
    write_file_atomically(in_folder(name), "x");
    EXPECT_EQ(read_file(in_folder(name)), "x");
}

TEST_F(FileReplacements, AFileIsMadeOnceOnly) {
    make_file_if_missing(in_folder("a"), "first");
    make_file_if_missing(in_folder("a"), "second");
    EXPECT_EQ(read_file(in_folder("a")), "first");
    EXPECT_EQ(entries(), 1);
    EXPECT_NE(refusal_of([&] { make_file_if_missing(in_folder("missing") / "a", "x"); }).find("cannot be written"),
              std::string::npos);
}

}  // namespace
}  // namespace skinfit
