#include "core/file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>

#include "core/file_replacement.hpp"
#include "core/input_error.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using FileTest = test::TemporaryFolder;
using test::refusal_of;

TEST_F(FileTest, ReadsBackTheBytesWritten) {
    std::string every_byte;
    for (int i = 0; i < 256; ++i) every_byte.push_back(static_cast<char>(i));
    for (const std::string& bytes : {std::string(), every_byte, std::string(1 << 20, 'x')}) {
        write_file_atomically(in_folder("a"), bytes);
        EXPECT_EQ(read_file(in_folder("a")), bytes);
        EXPECT_EQ(entries(), 1) << "a temporary file is left";
    }
}

TEST_F(FileTest, AReaderOfTheOldFileKeepsAllOfIt) {
    write_file_atomically(in_folder("a"), "old");
    std::filesystem::create_hard_link(in_folder("a"), in_folder("old"));
    write_file_atomically(in_folder("a"), "new");
    EXPECT_EQ(read_file(in_folder("old")), "old") << "the old file was overwritten, not replaced";
    EXPECT_EQ(read_file(in_folder("a")), "new");
}

TEST_F(FileTest, GivesAFileThePermissionsOfTheMask) {
    const mode_t before = ::umask(027);
    write_file_atomically(in_folder("a"), "x");
    ::umask(before);
    EXPECT_EQ(std::filesystem::status(in_folder("a")).permissions(), std::filesystem::perms{0640});
}

TEST_F(FileTest, RefusesToWriteIntoAMissingFolder) {
    const std::filesystem::path path = in_folder("missing") / "a";
    const std::string message = refusal_of([&] { write_file_atomically(path, "x"); });
    EXPECT_TRUE(message.starts_with(path.string() + ": cannot be written (No such file or directory)")) << message;
    EXPECT_EQ(entries(), 0);
}

TEST_F(FileTest, RefusesToReplaceAFolder) {
    std::filesystem::create_directory(in_folder("target"));
    write_file_atomically(in_folder("target") / "inside", "kept");
    const std::string message = refusal_of([&] { write_file_atomically(in_folder("target"), "x"); });
    EXPECT_NE(message.find("(Is a directory)"), std::string::npos) << message;
    EXPECT_EQ(read_file(in_folder("target") / "inside"), "kept");
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, KeepsTheOldFileWhenTheFolderIsReadOnly) {
    if (::geteuid() == 0) GTEST_SKIP() << "root writes into read-only folders";
    write_file_atomically(in_folder("a"), "old");
    const std::filesystem::path folder = in_folder("a").parent_path();
    std::filesystem::permissions(folder, std::filesystem::perms{0500});
    const std::string message = refusal_of([&] { write_file_atomically(in_folder("a"), "new"); });
    std::filesystem::permissions(folder, std::filesystem::perms{0700});
    EXPECT_NE(message.find("(Permission denied)"), std::string::npos) << message;
    EXPECT_EQ(read_file(in_folder("a")), "old");
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, AReplacementThatIsNotFinishedLeavesTheOldFileAlone) {
    write_file_atomically(in_folder("a"), "old");
    {
        FileReplacement file(in_folder("a"));
        file.append("ne");
        EXPECT_EQ(read_file(in_folder("a")), "old");
        EXPECT_EQ(entries(), 2);
    }
    EXPECT_EQ(read_file(in_folder("a")), "old");
    EXPECT_EQ(entries(), 1);
    FileReplacement file(in_folder("a"));
    file.append("ne");
    file.append("w");
    file.finish();
    EXPECT_EQ(read_file(in_folder("a")), "new");
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, AReplacementBeyondTheLimitOfFilesIsReportedAndRemoved) {
    // A limit on the size of files stands in for a full disk.
    struct rlimit before {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const struct rlimit small { .rlim_cur = 4096, .rlim_max = before.rlim_max };
    const auto signal_before = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string message = refusal_of([&] {
        FileReplacement file(in_folder("a"));
        for (int i = 0; i < 10; ++i) file.append(std::string(1000, 'x'));
    });
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, signal_before);
    EXPECT_TRUE(message.starts_with(in_folder("a").string() + ": cannot be written (File too large)")) << message;
    EXPECT_EQ(entries(), 0);
}

TEST_F(FileTest, ReportsAFullDisk) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "/dev/full is absent";
    const std::string message = refusal_of([] { write_file_atomically("/dev/full", "x"); });
    EXPECT_NE(message.find("(No space left on device)"), std::string::npos) << message;
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(FileTest, WritesToDevicesWithoutReplacingThem) {
    write_file_atomically("/dev/null", "x");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(FileTest, WritesToADescriptorThatTheShellSentToAFile) {
    const std::filesystem::path target = in_folder("redirected");
    std::FILE* const stream = std::fopen(target.c_str(), "w");
    ASSERT_NE(stream, nullptr);
    const std::string name = "/dev/fd/" + std::to_string(::fileno(stream));
    write_file_atomically(name, "first, ");
    write_file_atomically(name, "second");
    std::fclose(stream);
    EXPECT_EQ(read_file(target), "first, second");
    EXPECT_EQ(entries(), 1);
}

TEST_F(FileTest, ReadRefusalsNameThePathAndTheReason) {
    const std::string missing = refusal_of([&] { (void)read_file(in_folder("missing")); });
    EXPECT_TRUE(missing.starts_with(in_folder("missing").string() + ": cannot be read (No such file or directory)"))
        << missing;
    const std::string folder = refusal_of([&] { (void)read_file(in_folder("")); });
    EXPECT_NE(folder.find("is a folder"), std::string::npos) << folder;
    for (const std::string& message : {missing, folder}) EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST_F(FileTest, ReadsOrdinaryFilesOnly) {
    ASSERT_EQ(::mkfifo(in_folder("pipe").c_str(), 0600), 0);
    EXPECT_EQ(refusal_of([&] { (void)read_file(in_folder("pipe")); }),
              in_folder("pipe").string() +
                  ": is a pipe or a device (an ordinary file is needed here); write its content to a file first");
    EXPECT_NE(refusal_of([&] { (void)read_file("/dev/zero"); }).find("is a pipe or a device"), std::string::npos);
    std::filesystem::create_symlink("loop", in_folder("loop"));
    EXPECT_NE(refusal_of([&] { (void)read_file(in_folder("loop")); }).find("(Too many levels of symbolic links)"),
              std::string::npos);
}

TEST_F(FileTest, ReadsWhatComesThroughAPipe) {
    const std::string text(300'000, 'x');
    const std::filesystem::path pipe = in_folder("pipe");
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const auto write_later = [&](std::chrono::milliseconds delay, const std::string& bytes) {
        return std::jthread([=, path = pipe.string()] {
            const int descriptor = ::open(path.c_str(), O_WRONLY);
            std::this_thread::sleep_for(delay);
            std::size_t written = 0;
            while (written < bytes.size()) {
                const ssize_t count = ::write(descriptor, bytes.data() + written, bytes.size() - written);
                if (count <= 0) break;
                written += static_cast<std::size_t>(count);
            }
            ::close(descriptor);
        });
    };
    {
        const std::jthread writer = write_later(std::chrono::milliseconds(0), text);
        EXPECT_EQ(read_input(pipe), text);
    }
    {
        const std::jthread writer = write_later(std::chrono::milliseconds(6000), text);
        EXPECT_EQ(read_input(pipe), text) << "its writer is there, and slow";
    }
    {
        const std::jthread writer = write_later(std::chrono::milliseconds(0), "");
        EXPECT_EQ(read_input(pipe), "");
    }
    EXPECT_NE(refusal_of([&] { (void)read_input(pipe); }).find("is a pipe into which nobody writes (5 s have been"),
              std::string::npos);
    EXPECT_NE(refusal_of([&] { (void)read_input("/dev/zero"); }).find("is a pipe or a device"), std::string::npos);
    EXPECT_NE(refusal_of([&] { (void)read_input(in_folder("")); }).find("is a folder"), std::string::npos);
}

TEST_F(FileTest, ReadsOnAsLongAsItIsAskedTo) {
    write_file_atomically(in_folder("a"), std::string(1 << 20, 'x'));
    std::size_t asked = 0;
    const std::string beginning = read_input(in_folder("a"), [&](std::string_view so_far) {
        asked = so_far.size();
        return so_far.size() < 100'000;
    });
    EXPECT_EQ(beginning.size(), asked);
    EXPECT_GE(asked, 100'000U);
    EXPECT_LT(asked, 400'000U);
    EXPECT_EQ(read_input(in_folder("a"), [](std::string_view) { return true; }), std::string(1 << 20, 'x'));
}

TEST_F(FileTest, RefusesFilesAboveItsLimitWithoutReadingThem) {
    write_file_atomically(in_folder("large"), "");
    std::filesystem::resize_file(in_folder("large"), largest_file_bytes + 1);  // a hole: no disk is used
    EXPECT_EQ(refusal_of([&] { (void)read_file(in_folder("large")); }),
              in_folder("large").string() + ": is too large (at most 2 GiB are read at once); split it");
}

TEST_F(FileTest, ReadsFilesThatDoNotKnowTheirSize) {
    if (!std::filesystem::exists("/proc/self/status")) GTEST_SKIP() << "/proc is absent";
    EXPECT_TRUE(read_file("/proc/self/status").starts_with("Name:"));
}

TEST_F(FileTest, MakesAFolderAndThoseAboveItOrSaysWhyNot) {
    const std::filesystem::path folder = in_folder("above") / "below";
    make_folder(folder, "--output");
    make_folder(folder, "--output");
    EXPECT_TRUE(std::filesystem::is_directory(folder));
    write_file_atomically(folder / "file", "x");
    const std::string message = refusal_of([&] { make_folder(folder / "file", "--output"); });
    EXPECT_TRUE(message.starts_with("--output: no folder that can be written (")) << message;
}

}  // namespace
}  // namespace skinfit
