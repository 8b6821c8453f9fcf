#include <gtest/gtest.h>

#include "fit/configuration_json.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit::test {
namespace {

Configuration loaded(const std::string& text) {
    return configured_by_text(default_configuration(), text, "c.json");
}

/// The message with which the loader refuses `text`; empty where it does not.
std::string refusal(const std::string& text) {
    return refusal_of([&] { (void)loaded(text); });
}

TEST(Presets, AreWhatAllElseStandsOn) {
    const Configuration skin = loaded(R"({"preset": "skin"})");
    EXPECT_EQ(skin.engine, Engine::emulator);
    EXPECT_TRUE(skin.discrepancy);
    EXPECT_TRUE(skin.free[static_cast<std::size_t>(Parameter::fibril_radius_nm)]);
    EXPECT_FALSE(skin.free[static_cast<std::size_t>(Parameter::bilirubin_g_per_l)]);
    EXPECT_EQ(to_json(configured_by_assignment(default_configuration(), "preset=skin")), to_json(skin));
    // Wherever they stand: the keys of an object have no order.
    const Configuration changed = loaded(R"({"discrepancy": null, "noise": 0.01, "preset": "skin", "seed": 9})");
    EXPECT_FALSE(changed.discrepancy);
    EXPECT_EQ(changed.noise, 0.01);
    EXPECT_EQ(changed.free, skin.free);
    EXPECT_EQ(to_json(loaded(to_json(changed).dump())), to_json(changed));
    const Configuration without = configured_by_text(skin, R"({"priors": "uniform"})", "c.json");
    EXPECT_EQ(to_json(loaded(to_json(without).dump())), to_json(without));
    EXPECT_EQ(to_json(configured_by_text(skin, R"({"preset": "paper"})", "c.json")), to_json(default_configuration()));
    EXPECT_NE(refusal(R"({"preset": "skinn"})").find("one of paper, skin"), std::string::npos);
    EXPECT_NE(refusal(R"({"preset": 1})"), "");
}

}  // namespace
}  // namespace skinfit::test
