#include <gtest/gtest.h>

#include "fit/configuration_json.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit::test {
namespace {

std::string assignment_refusal(const std::string& assignment) {
    return refusal_of([&] { (void)configured_by_assignment(default_configuration(), assignment); });
}

Configuration assigned(const std::string& assignment) {
    return configured_by_assignment(default_configuration(), assignment);
}

TEST(Assignment, NumbersNamesAndNull) {
    EXPECT_EQ(assigned("melanosome_fraction=0.1").values.skin.melanosome_fraction, 0.1);
    EXPECT_EQ(assigned(" offset = -.05 ").values.instrument.offset, -0.05);
    EXPECT_EQ(assigned("offset=+1e-2").values.instrument.offset, 0.01);
    EXPECT_EQ(assigned("rays=2e6").rays, 2'000'000U);
    EXPECT_EQ(assigned("edition=printed").edition, Edition::printed);
    EXPECT_EQ(assigned("base=matched").base, (Base{.kind = Base::Kind::matched}));
    EXPECT_EQ(assigned("base=1.33").base, (Base{.kind = Base::Kind::index, .refractive_index = 1.33}));
    EXPECT_EQ(configured_by_assignment(assigned("base=matched"), "base=null").base, std::nullopt);
    EXPECT_EQ(configured_by_assignment(assigned("specular=excluded"), "specular=null").specular, std::nullopt);
    EXPECT_EQ(assigned("wavelengths=400:700:20").wavelengths, "400:700:20");
    EXPECT_EQ(assigned("wavelengths=550").wavelengths, "550");
    EXPECT_EQ(assigned("column=left arm").column, "left arm");
    EXPECT_EQ(assigned("column=2").column, "2");
    EXPECT_EQ(assigned("exclude_nm=[[500, 510]]").exclude_nm.size(), 1U);
    EXPECT_EQ(assigned("discrepancy={\"length_nm\": 20}").discrepancy->length_nm, 20);
}

TEST(Assignment, MisuseNamesTheKey) {
    for (const auto& [assignment, words] :
         {std::pair{"melanosome_fraction=2", "--set melanosome_fraction: 2 "},
          std::pair{"melanosome_fraction=nan", "\"nan\""}, std::pair{"melanosome_fraction=inf", "\"inf\""},
          std::pair{"melanosome_fraction=", "--set melanosome_fraction: "},
          std::pair{"melanosome=1", "melanosome_fraction"}, std::pair{"rays=x", "--set rays: "},
          std::pair{"rays=1e400", "--set rays: "}, std::pair{"seed", "no \"=\""}, std::pair{"=1", "a name is empty"},
          std::pair{"edition=\xff", "--set edition: "}, std::pair{"\xff=1", "unknown name"}}) {
        EXPECT_NE(assignment_refusal(assignment).find(words), std::string::npos)
            << assignment << ": " << assignment_refusal(assignment);
    }
}

}  // namespace
}  // namespace skinfit::test
