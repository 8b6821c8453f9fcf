#include "model/disk_cache.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <span>

#include "core/file.hpp"
#include "model/ensemble_cache.hpp"
#include "model/ensemble_file.hpp"
#include "model/stored_file.hpp"
#include "tests/model/cache_test.hpp"

namespace skinfit::test {
namespace {

namespace fs = std::filesystem;

const std::vector<double> wavelengths_nm = {450, 550};
constexpr WalkOptions walk{.incidence_rad = 0.1, .rays = 200, .seed = 3};

/// A cache in which one recording lies.
class DiskCacheTest : public CacheTest {
protected:
    void SetUp() override {
        CacheTest::SetUp();
        get();
        file = fs::directory_iterator(folder)->path();
        warnings.clear();
        made = 0;
    }
    void get() { (void)cached_ensemble({}, wavelengths_nm, walk, cache()); }
    /// Expects that the recording is made again, and that the first warning says why.
    void expect_made_again(const std::string& why, std::size_t warned) {
        warnings.clear();
        made = 0;
        get();
        EXPECT_EQ(made, 1) << why;
        ASSERT_EQ(warnings.size(), warned) << why;
        EXPECT_NE(warnings.front().find("is " + why), std::string::npos) << warnings.front();
    }
    [[nodiscard]] std::ptrdiff_t entries() const {
        return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
    }

    fs::path file;
};

TEST_F(DiskCacheTest, APipeInItHangsNothing) {
    fs::remove(file);
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    expect_made_again("no ordinary file", 2);
    EXPECT_NE(warnings.back().find("nothing is kept for the next run"), std::string::npos) << warnings.back();
    EXPECT_TRUE(fs::is_fifo(file));
}

TEST_F(DiskCacheTest, ALinkInItIsNotFollowed) {
    fs::rename(file, folder / "elsewhere");
    fs::create_symlink("elsewhere", file);
    const std::string before = read_file(folder / "elsewhere");
    expect_made_again("a link", 2);
    EXPECT_TRUE(fs::is_symlink(file));
    EXPECT_EQ(read_file(folder / "elsewhere"), before);
}

TEST_F(DiskCacheTest, WhatOthersCouldHaveWrittenIsNotBelieved) {
    EXPECT_EQ(fs::status(file).permissions(), fs::perms{0600});
    for (const fs::perms open : {fs::perms{0620}, fs::perms{0602}, fs::perms{0666}}) {
        fs::permissions(file, open);
        expect_made_again("open to changes by other users", 1);
        EXPECT_EQ(fs::status(file).permissions(), fs::perms{0600});
    }
    if (::geteuid() != 0) GTEST_SKIP() << "only root gives files away";
    ASSERT_EQ(::chown(file.c_str(), 65534, 65534), 0);
    expect_made_again("of another user", 1);
    get();
    EXPECT_EQ(made, 1) << "and the new one is believed";
}

/// A file of ours with a right checksum whose numbers do not fit.
TEST_F(DiskCacheTest, AFileThatIsNotAsLongAsItSaysIsNotRead) {
    const std::string key = ensemble_key({}, wavelengths_nm, walk);
    for (const std::uint64_t count : {std::uint64_t{1}, std::uint64_t{1} << 40U, ~std::uint64_t{0}}) {
        const std::array<std::uint64_t, 4> header = {200, count, count, 0};
        const std::string_view bytes = bytes_of(std::span<const std::uint64_t>(header));
        write_stored_file(file, "skinfit paths 2\n", key, {&bytes, 1});
        expect_made_again("not as long as it says", 1);
    }
    write_stored_file(file, "skinfit paths 2\n", key, {});
    expect_made_again("too short", 1);
}

TEST_F(DiskCacheTest, WhatKilledProcessesLeftIsRemovedAndWhatIsWrittenCounts) {
    const auto half = [&](const std::string& name) {
        write_file_atomically(folder / name, std::string(1000, 'x'));
        return folder / name;
    };
    half(".skinfit-0123456789abcdef.part");
    half(file.filename().string() + ".aB3xY9");  // as release 0.1.0 called it
    half("notes.txt");
    const fs::path live = half(".skinfit-00000000000000ff.part");
    const int descriptor = ::open(live.c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
    DiskCache tight = cache();
    tight.limit_bytes = fs::file_size(file) + 1000;
    tidy(tight);
    EXPECT_EQ(entries(), 3) << "the recording, the notes, and what is being written";
    tight.limit_bytes -= 1;
    tidy(tight);
    EXPECT_FALSE(fs::exists(file)) << "what is being written counts";
    ::close(descriptor);
    tidy(tight);
    EXPECT_EQ(entries(), 1);
    EXPECT_TRUE(fs::exists(folder / "notes.txt"));
}

}  // namespace
}  // namespace skinfit::test
