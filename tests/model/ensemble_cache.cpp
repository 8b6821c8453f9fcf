#include "model/ensemble_cache.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/stop.hpp"
#include "model/ensemble_file.hpp"
#include "model/parameters.hpp"
#include "tests/model/cache_test.hpp"

namespace skinfit::test {
namespace {

namespace fs = std::filesystem;

const std::vector<double> wavelengths_nm = {450, 550};
constexpr WalkOptions walk{.incidence_rad = 0.1, .rays = 200, .seed = 3};

class EnsembleCacheTest : public CacheTest {
protected:
    PathEnsemble get(const Sample& sample = {}, const WalkOptions& options = walk) {
        return cached_ensemble(sample, wavelengths_nm, options, cache());
    }

    [[nodiscard]] std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(folder)) found.push_back(entry.path());
        return found;
    }
};

void expect_same_bits(const PathEnsemble& a, const PathEnsemble& b) {
    EXPECT_EQ(a.surface_share(), b.surface_share());
    EXPECT_EQ(a.rays(), b.rays());
    ASSERT_EQ(a.recording().lengths.size(), b.recording().lengths.size());
    EXPECT_TRUE(std::ranges::equal(a.recording().lengths, b.recording().lengths));
    ASSERT_EQ(a.recording().segments.size(), b.recording().segments.size());
    for (std::size_t i = 0; i < a.recording().segments.size(); ++i) {
        for (std::size_t side = 0; side < side_count; ++side) {
            const PathEnsemble::Segment& of_a = a.recording().segments[i][side];
            const PathEnsemble::Segment& of_b = b.recording().segments[i][side];
            EXPECT_EQ(of_a.first_float, of_b.first_float);
            EXPECT_EQ(of_a.batch_begins, of_b.batch_begins);
        }
    }
}

TEST_F(EnsembleCacheTest, KeepsNothingOfWhatIsCancelled) {
    std::stop_source stop;
    DiskCache stopping = cache();
    stopping.inform = [&](const std::string&) { stop.request_stop(); };
    EXPECT_THROW((void)cached_ensemble({}, wavelengths_nm, walk, stopping, stop.get_token()), Cancelled);
    EXPECT_FALSE(fs::exists(folder));
    (void)get();
    const PathEnsemble traced = PathEnsemble::trace({}, wavelengths_nm, walk);
    // Nor does it leave a part where it is cancelled while it is written, or touch what is there.
    const fs::path kept = files().front();
    const std::string before = read_file(kept);
    EXPECT_THROW(write_ensemble_file(kept, "key", traced, stop.get_token()), Cancelled);
    EXPECT_EQ(files(), std::vector<fs::path>{kept});
    EXPECT_EQ(read_file(kept), before);
    expect_same_bits(get(), traced);
    EXPECT_EQ(made, 1);
}

void overwrite(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

TEST_F(EnsembleCacheTest, NobodyNeedWatchIt) {
    const PathEnsemble traced = PathEnsemble::trace({}, wavelengths_nm, walk);
    expect_same_bits(cached_ensemble({}, wavelengths_nm, walk, {}), traced);
    const DiskCache unwatched{.folder = folder};
    expect_same_bits(cached_ensemble({}, wavelengths_nm, walk, unwatched), traced);
    overwrite(files().at(0), "damaged");
    expect_same_bits(cached_ensemble({}, wavelengths_nm, walk, unwatched), traced);
}

TEST_F(EnsembleCacheTest, SecondCallReadsTheSameBits) {
    const PathEnsemble traced = PathEnsemble::trace({}, wavelengths_nm, walk);
    expect_same_bits(get(), traced);
    EXPECT_EQ(made, 1);
    expect_same_bits(get(), traced);
    EXPECT_EQ(made, 1);
    EXPECT_EQ(files().size(), 1U);
    EXPECT_TRUE(warnings.empty());
}

TEST_F(EnsembleCacheTest, WithoutAFolderNothingIsKept) {
    DiskCache nowhere = cache();
    nowhere.folder.reset();
    (void)cached_ensemble({}, wavelengths_nm, walk, nowhere);
    (void)cached_ensemble({}, wavelengths_nm, walk, nowhere);
    EXPECT_EQ(made, 2);
    EXPECT_FALSE(fs::exists(folder));
}

/// What may befall a file between two runs.
class DamagedCacheTest : public EnsembleCacheTest {
protected:
    void SetUp() override {
        EnsembleCacheTest::SetUp();
        (void)get();
        path = files().at(0);
        good = read_file(path);
    }

    void expect_replaced(const std::string& bytes, const std::string& what) {
        SCOPED_TRACE(what);
        overwrite(path, bytes);
        warnings.clear();
        made = 0;
        expect_same_bits(get(), PathEnsemble::trace({}, wavelengths_nm, walk));
        EXPECT_EQ(warnings.size(), 1U);
        EXPECT_EQ(made, 1);
        EXPECT_EQ(read_file(path), good);
        (void)get();
        EXPECT_EQ(warnings.size(), 1U);
        EXPECT_EQ(made, 1);
    }

    fs::path path;
    std::string good;
};

TEST_F(DamagedCacheTest, TruncatedAnywhereItIsReplaced) {
    for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{16}, std::size_t{55}, std::size_t{64},
                                     std::size_t{300}, good.size() / 2, good.size() - 8, good.size() - 1}) {
        expect_replaced(good.substr(0, length), "length " + std::to_string(length));
    }
}

TEST_F(DamagedCacheTest, WithMoreBytesItIsReplaced) {
    expect_replaced(good + "x", "one more");
    expect_replaced(good + good, "twice");
}

TEST_F(DamagedCacheTest, WithOneBitFlippedAnywhereItIsReplaced) {
    for (std::size_t at = 0; at < good.size(); at += 1 + good.size() / 40) {
        std::string bytes = good;
        bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
        expect_replaced(bytes, "byte " + std::to_string(at));
    }
    std::string bytes = good;
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    expect_replaced(bytes, "the checksum");
}

TEST_F(DamagedCacheTest, ForeignFilesAreReplaced) {
    expect_replaced("400,0.1\n500,0.2\n", "a spectrum");
    expect_replaced(std::string(good.size(), '\0'), "zeros");
    WalkOptions other = walk;
    ++other.seed;
    (void)get({}, other);
    for (const fs::path& file : files()) {
        if (file != path) expect_replaced(read_file(file), "the recording of another seed");
    }
}

TEST_F(EnsembleCacheTest, AFolderThatCannotBeWrittenWarnsAndDoesNoHarm) {
    overwrite(folder, "a file where the folder should be");
    expect_same_bits(get(), PathEnsemble::trace({}, wavelengths_nm, walk));
    EXPECT_EQ(warnings.size(), 1U);
    fs::remove(folder);
}

TEST_F(EnsembleCacheTest, ARecordingBeyondTheMemoryIsRefusedAtOnce) {
    WalkOptions endless = walk;
    endless.rays = 1'000'000'000'000;
    EXPECT_THROW((void)get({}, endless), InputError);
    EXPECT_EQ(made, 0);
    EXPECT_FALSE(fs::exists(folder));
}

TEST_F(EnsembleCacheTest, TheLongestUnusedGoFirst) {
    DiskCache small = cache();
    WalkOptions options = walk;
    (void)get({}, options);
    const std::uint64_t bytes = fs::file_size(files().at(0));
    const fs::path first = files().at(0);
    fs::last_write_time(first, fs::file_time_type::clock::now() - std::chrono::hours(2));
    options.seed = 4;
    (void)get({}, options);
    for (const fs::path& file : files()) {
        if (file != first) fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
    }
    (void)get();  // use makes the oldest the youngest
    options.seed = 5;
    small.limit_bytes = bytes * 5 / 2;
    (void)cached_ensemble({}, wavelengths_nm, options, small);
    EXPECT_EQ(files().size(), 2U);
    EXPECT_TRUE(fs::exists(first));
    small.limit_bytes = 0;
    options.seed = 6;
    (void)cached_ensemble({}, wavelengths_nm, options, small);
    EXPECT_TRUE(files().empty());
    EXPECT_TRUE(warnings.empty());
}

TEST_F(EnsembleCacheTest, OtherFilesInTheFolderStay) {
    fs::create_directories(folder);
    overwrite(folder / "notes.txt", "mine");
    DiskCache small = cache();
    small.limit_bytes = 0;
    (void)cached_ensemble({}, wavelengths_nm, walk, small);
    EXPECT_EQ(read_file(folder / "notes.txt"), "mine");
}

TEST(EnsembleKey, ChangesWithEveryParameterThatSteersAndNoOther) {
    const std::string standard = ensemble_key({}, wavelengths_nm, walk);
    for (const ParameterInfo& row : parameter_table()) {
        ParameterValues values;
        value_of(values, row.parameter) *= 1.01;
        Sample sample;
        sample.skin = values.skin;
        const std::string key = ensemble_key(sample, wavelengths_nm, walk);
        // The shift enters by the wavelengths, and folds steer light that never entered the skin.
        const bool counts = row.steers && row.parameter != Parameter::wavelength_shift_nm &&
                            row.parameter != Parameter::fold_aspect_ratio;
        EXPECT_EQ(key != standard, counts) << row.name;
    }
}

TEST(EnsembleKey, ChangesWithEveryOtherInput) {
    const std::string standard = ensemble_key({}, wavelengths_nm, walk);
    std::vector<std::string> keys = {standard};
    const auto add = [&keys](Edition edition, int layers, const Base& base) {
        keys.push_back(
            ensemble_key({.skin = {}, .edition = edition, .layers = layers, .base = base}, wavelengths_nm, walk));
    };
    add(Edition::printed, 4, {});
    add(Edition::revised, 2, {});
    add(Edition::revised, 4, {.kind = Base::Kind::matched});
    add(Edition::revised, 4, {.kind = Base::Kind::index, .refractive_index = 1.33});
    add(Edition::revised, 4, {.kind = Base::Kind::index, .refractive_index = 1.5});
    std::ranges::sort(keys);
    EXPECT_EQ(std::ranges::adjacent_find(keys), keys.end());
    EXPECT_NE(ensemble_key({}, {450, 550.0000001}, walk), standard);
    EXPECT_NE(ensemble_key({}, {450}, walk), standard);
    for (const WalkOptions& other : {WalkOptions{.incidence_rad = 0.2, .rays = 200, .seed = 3},
                                     WalkOptions{.incidence_rad = 0.1, .rays = 201, .seed = 3},
                                     WalkOptions{.incidence_rad = 0.1, .rays = 200, .seed = 4}}) {
        EXPECT_NE(ensemble_key({}, wavelengths_nm, other), standard);
    }
}

}  // namespace
}  // namespace skinfit::test
