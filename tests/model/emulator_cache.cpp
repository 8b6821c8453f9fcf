#include "model/emulator_cache.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/file.hpp"
#include "core/stop.hpp"
#include "model/chromophores.hpp"
#include "tests/model/cache_test.hpp"

namespace skinfit::test {
namespace {

namespace fs = std::filesystem;

class EmulatorCacheTest : public CacheTest {
protected:
    [[nodiscard]] fs::path only_file() const { return fs::directory_iterator(folder)->path(); }
};

EmulatorDomain domain(double incidence_rad = 0.1) {
    return {.sample = {},
            .incidence_rad = incidence_rad,
            .side = Side::top,
            .wavelengths_nm = {500, 600},
            .ranges = {{Parameter::melanosome_fraction, 0, 0.5}}};
}

void expect_same_bits(const Emulator& a, const Emulator& b) {
    EXPECT_EQ(a.surface_share(), b.surface_share());
    EXPECT_TRUE(std::ranges::equal(a.parts().coefficients, b.parts().coefficients));
    EXPECT_TRUE(std::ranges::equal(a.parts().counts, b.parts().counts));
    std::vector<PerLayer<double>> depths;
    for (const double wavelength_nm : domain().wavelengths_nm) {
        depths.push_back(optical_depth(Skin{}, Extinction::at(wavelength_nm, Edition::revised)));
    }
    for (std::size_t i = 0; i < depths.size(); ++i) {
        EXPECT_EQ(a.respond(depths)[i].share, b.respond(depths)[i].share);
        EXPECT_EQ(a.respond(depths)[i].by_optical_depth, b.respond(depths)[i].by_optical_depth);
        EXPECT_EQ(a.certified_error(i), b.certified_error(i));
    }
}

TEST_F(EmulatorCacheTest, GivesBackTheSameBitsWithoutBuilding) {
    const Emulator built = cached_emulator(domain(), cache());
    const Emulator read = cached_emulator(domain(), cache());
    EXPECT_EQ(made, 1);
    expect_same_bits(built, read);
    EXPECT_TRUE(warnings.empty());
}

TEST_F(EmulatorCacheTest, KeepsNothingOfWhatIsCancelled) {
    std::stop_source stop;
    DiskCache stopping = cache();
    stopping.inform = [&](const std::string&) { stop.request_stop(); };
    EXPECT_THROW((void)cached_emulator(domain(), stopping, stop.get_token()), Cancelled);
    EXPECT_FALSE(fs::exists(folder));
    expect_same_bits(cached_emulator(domain(), cache()), Emulator::build(domain()));
}

TEST_F(EmulatorCacheTest, BuildsAnewForAnotherDomain) {
    (void)cached_emulator(domain(), cache());
    (void)cached_emulator(domain(0.2), cache());
    EmulatorDomain wider = domain();
    wider.ranges[0].upper = 0.6;
    (void)cached_emulator(wider, cache());
    EmulatorDomain other_fixed = domain();
    other_fixed.sample.skin.oxygen_saturation = 0.5;
    (void)cached_emulator(other_fixed, cache());
    EXPECT_EQ(made, 4);
    EXPECT_NE(emulator_key(domain()), emulator_key(domain(0.2)));
}

TEST_F(EmulatorCacheTest, TheFixedValueOfAFreeParameterHasNoEffect) {
    EmulatorDomain other = domain();
    other.sample.skin.melanosome_fraction = 0.3;
    EXPECT_EQ(emulator_key(domain()), emulator_key(other));
}

TEST_F(EmulatorCacheTest, ReplacesADamagedFile) {
    const Emulator built = cached_emulator(domain(), cache());
    std::string bytes = read_file(only_file());
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    write_file_atomically(only_file(), bytes);
    expect_same_bits(built, cached_emulator(domain(), cache()));
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("checksum"), std::string::npos);
    EXPECT_EQ(made, 2);
}

}  // namespace
}  // namespace skinfit::test
