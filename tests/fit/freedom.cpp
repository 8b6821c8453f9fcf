#include <gtest/gtest.h>

#include "core/input_error.hpp"
#include "fit/configuration_json.hpp"

namespace skinfit::test {
namespace {

TEST(Freedom, IsGivenAndTakenByName) {
    Configuration configuration = default_configuration();
    configuration = with_freedom(configuration, "scale, offset", true, "--free");
    configuration = with_freedom(configuration, "melanosome_fraction", false, "--fix");
    EXPECT_TRUE(configuration.free[static_cast<std::size_t>(Parameter::scale)]);
    EXPECT_TRUE(configuration.free[static_cast<std::size_t>(Parameter::offset)]);
    EXPECT_FALSE(configuration.free[static_cast<std::size_t>(Parameter::melanosome_fraction)]);
    EXPECT_THROW((void)with_freedom(configuration, "scale,ofset", true, "--free"), InputError);
    EXPECT_THROW((void)with_freedom(configuration, "", true, "--free"), InputError);
}

TEST(Freedom, WhatIsOwnIsFree) {
    const Configuration configuration = with_own(default_configuration(), "scale", "--own");
    const auto scale = static_cast<std::size_t>(Parameter::scale);
    EXPECT_TRUE(configuration.own[scale]);
    EXPECT_TRUE(configuration.free[scale]);
    EXPECT_EQ(configured(default_configuration(), to_json(configuration), "c.json").own, configuration.own);
    EXPECT_THROW((void)with_own(default_configuration(), "sale", "--own"), InputError);
}

}  // namespace
}  // namespace skinfit::test
