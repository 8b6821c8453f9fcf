#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/unfinished.hpp"
#include "fit/gnuplot.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace skinfit {
namespace {

using namespace std::chrono_literals;

/// A shell script stands in for gnuplot.
class FailingGnuplot : public test::TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        path_ = std::getenv("PATH");
        ::setenv("PATH", (in_folder("").string() + ":" + path_).c_str(), 1);
    }
    void TearDown() override {
        ::setenv("PATH", path_.c_str(), 1);
        TemporaryFolder::TearDown();
    }

    void put_gnuplot(const std::string& script) const {
        write_file_atomically(in_folder("gnuplot"), "#!/bin/sh\n" + script + "\n");
        std::filesystem::permissions(in_folder("gnuplot"), std::filesystem::perms{0700});
    }
    [[nodiscard]] static std::string refusal() {
        return test::refusal_of([] { (void)gnuplot_picture("plot 1\n"); });
    }
    [[nodiscard]] static std::string refusal_saying(const std::string& why) {
        return "plot: gnuplot failed (" + why + "); check that gnuplot draws this kind of file (Debian: gnuplot-nox)";
    }

    /// Whether a process ends within a while; nobody may reap it.
    [[nodiscard]] static bool ends(pid_t process) {
        const std::string status = "/proc/" + std::to_string(process) + "/status";
        for (int i = 0; i < 1000; ++i) {
            bool is_zombie = false;
            const bool is_gone = !test::refusal_of([&] {
                                      is_zombie = read_file(status).find("State:\tZ") != std::string::npos;
                                  }).empty();
            if (is_gone || is_zombie) return true;
            std::this_thread::sleep_for(10ms);
        }
        return false;
    }

private:
    std::string path_;
};

TEST_F(FailingGnuplot, ItsLastComplaintIsShown) {
    // Longer than any string keeps inside itself.
    const std::string complaint = "line 1: " + std::string(3000, 'x');
    put_gnuplot("echo first >&2; echo '" + complaint + "' >&2; echo >&2; exit 1");
    EXPECT_EQ(refusal(), refusal_saying(complaint));
}

TEST_F(FailingGnuplot, WithoutAComplaintThatIsSaid) {
    put_gnuplot("exit 1");
    EXPECT_EQ(refusal(), refusal_saying("it gave no reason"));
    put_gnuplot("exit 0");
    EXPECT_EQ(refusal(), refusal_saying("it gave no reason")) << "a picture without a byte is none";
    put_gnuplot("kill -SEGV $$");
    EXPECT_EQ(refusal(), refusal_saying("it was ended by signal 11"));
}

TEST_F(FailingGnuplot, APictureOfManyBytesIsWhole) {
    put_gnuplot("head -c 1000000 /dev/zero");
    EXPECT_EQ(gnuplot_picture(""), std::string(1'000'000, '\0'));
}

TEST_F(FailingGnuplot, ThatHangsIsEndedWithWhatItStarted) {
    put_gnuplot("sleep 1000 & echo $! > " + in_folder("started").string() + "; wait");
    std::string complaint;
    std::jthread drawing([&] { complaint = refusal(); });
    while (!std::filesystem::exists(in_folder("started")) || read_file(in_folder("started")).empty()) {
        std::this_thread::sleep_for(1ms);
    }
    kill_children();
    drawing.join();
    EXPECT_EQ(complaint, refusal_saying("it was ended by signal 9"));
    const pid_t grandchild = std::stoi(read_file(in_folder("started")));
    EXPECT_TRUE(ends(grandchild)) << "what it had started still runs";
}

TEST_F(FailingGnuplot, IsLookedForBeforeLongWork) {
    EXPECT_EQ(test::refusal_of([] { require_gnuplot(); }), "");
    ::setenv("PATH", in_folder("").c_str(), 1);
    EXPECT_NE(test::refusal_of([] { require_gnuplot(); }).find("gnuplot cannot be run (No such file or directory)"),
              std::string::npos);
    put_gnuplot("exit 0");
    EXPECT_EQ(test::refusal_of([] { require_gnuplot(); }), "");
}

}  // namespace
}  // namespace skinfit
