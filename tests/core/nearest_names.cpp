#include "core/nearest_names.hpp"

#include <gmock/gmock.h>

namespace skinfit::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::vector<std::string_view> known = {"melanosome_fraction", "papillary_blood_fraction",
                                             "reticular_blood_fraction", "oxygen_saturation", "scale"};

TEST(NearestNames, EverydayWordsStandForWhatTheyAreCalledHere) {
    EXPECT_THAT(meant_names("melanin", known), ElementsAre("melanosome_fraction"));
    EXPECT_THAT(meant_names("Melanins", known), ElementsAre("melanosome_fraction"));
    EXPECT_THAT(meant_names("StO2", known), ElementsAre("oxygen_saturation"));
    EXPECT_THAT(meant_names("blood volume", known),
                ElementsAre("papillary_blood_fraction", "reticular_blood_fraction"));
    EXPECT_THAT(meant_names("melanin-content", known), ElementsAre("melanosome_fraction"));
    EXPECT_THAT(meant_names("bilirubin", known), IsEmpty()) << "what it stands for is not known here";
    EXPECT_EQ(either(meant_names("blood", known)), "\"papillary_blood_fraction\" or \"reticular_blood_fraction\"");
}

TEST(NearestNames, PartsAndSlipsAreFound) {
    EXPECT_THAT(meant_names("melanosome", known), ElementsAre("melanosome_fraction"));
    EXPECT_THAT(meant_names("oxygen_saturaton", known), ElementsAre("oxygen_saturation"));
    EXPECT_THAT(meant_names("scalle", known), ElementsAre("scale"));
    EXPECT_THAT(meant_names("xyzzy", known), IsEmpty());
    EXPECT_THAT(meant_names("a", known), IsEmpty());
}

TEST(NearestNames, SpeltIsLowerCaseWithoutBlanks) {
    EXPECT_EQ(spelt("--Blood Volume-fraction "), "blood_volume_fraction");
    EXPECT_EQ(spelt(" - "), "");
}

}  // namespace
}  // namespace skinfit::test
