#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/input_error.hpp"
#include "measurements/text_reader.hpp"
#include "tests/support/refusal.hpp"

namespace skinfit {
namespace {

using Numbers = std::vector<double>;

Spectrum chosen(const std::string& text, const std::string& column) {
    return parse_spectrum(text, "a.csv", {.column = column});
}

std::string refusal(const std::string& text, const std::optional<std::string>& column) {
    return test::refusal_of([&] { (void)parse_spectrum(text, "a.csv", {.column = column}); });
}

const std::string wide = "nm,left,right,left_sigma,2\n400,0.1,0.2,0.01,0.3\n";

TEST(ColumnChoice, IsByNameThenByNumberWithoutTheWavelengths) {
    EXPECT_EQ(chosen(wide, "left").value, Numbers{0.1});
    EXPECT_EQ(chosen(wide, "right").value, Numbers{0.2});
    EXPECT_EQ(chosen(wide, "1").value, Numbers{0.1});
    EXPECT_EQ(chosen(wide, "4").value, Numbers{0.3});
    EXPECT_EQ(chosen(wide, "2").value, Numbers{0.3}) << "a name goes before a number";
    EXPECT_EQ(chosen("400 0.1 0.2 0.3\n", "2").value, Numbers{0.2});
}

TEST(ColumnChoice, NamesTheSpectrum) {
    EXPECT_EQ(chosen(wide, "1").name, "left");
    EXPECT_EQ(chosen("400 0.1 0.2 0.3\n", "2").name, "column 2");
    EXPECT_EQ(chosen("nm,R\n400,0.1\n", "R").name, "a");
    EXPECT_EQ(chosen("# specimen: arm\n" + wide, "1").name, "arm");
}

TEST(ColumnChoice, TakesTheUncertaintyOfItsOwnColumnBeforeTheCommonOne) {
    EXPECT_EQ(chosen(wide, "left").sigma, Numbers{0.01});
    EXPECT_TRUE(chosen(wide, "right").sigma.empty());
    const std::string both = "nm,a,b,sigma,b_sigma\n400,0.1,0.2,0.03,0.04\n";
    EXPECT_EQ(chosen(both, "a").sigma, Numbers{0.03});
    EXPECT_EQ(chosen(both, "b").sigma, Numbers{0.04});
}

TEST(ColumnChoice, IsNotNeededBesideUncertainties) {
    EXPECT_EQ(parse_spectrum("nm,sigma,R\n400,0.01,0.5\n", "a").value, Numbers{0.5});
    EXPECT_NE(refusal("nm,lone_sigma\n400,0.5\n", std::nullopt).find("has no column of values"), std::string::npos);
}

TEST(ColumnChoice, PicksTheQuantityByTheColumnsName) {
    const std::string simulated =
        "# quantity: reflectance\nwavelength_nm,reflectance,reflectance_se,transmittance,transmittance_se,"
        "surface_reflectance\n400,0.3,0.001,0.2,0.002,0.04\n";
    EXPECT_EQ(chosen(simulated, "reflectance").quantity, Quantity::reflectance);
    EXPECT_EQ(chosen(simulated, "reflectance").value, Numbers{0.3});
    EXPECT_EQ(chosen(simulated, "transmittance").quantity, Quantity::transmittance);
    EXPECT_EQ(chosen(simulated, "transmittance").value, Numbers{0.2});
    EXPECT_EQ(chosen(simulated, "reflectance").sigma, Numbers{0.001});
    EXPECT_EQ(chosen(simulated, "transmittance").sigma, Numbers{0.002});
    EXPECT_NE(refusal(simulated, std::nullopt).find("has 3 columns of values"), std::string::npos);
}

TEST(ColumnChoice, LeavesTheCellsOfOtherColumnsUnread) {
    for (const std::string cell : {"", "NaN", "-1", "text", "1e9"}) {
        EXPECT_EQ(chosen("nm,a,b,c\n400," + cell + ",0.5,\n500,,0.6,\n", "b").value, (Numbers{0.5, 0.6})) << cell;
    }
}

TEST(ColumnChoice, RefusalListsTheColumnsAndTheNearestName) {
    EXPECT_EQ(
        refusal("nm,left,right\n400,0.1,0.2\n", "rigth"),
        "a.csv:1: has no column \"rigth\" (its columns are left, right; the nearest name is \"right\"); choose one of "
        "these by its name or by its number, counted without the wavelengths");
    EXPECT_EQ(refusal("400 0.1 0.2\n", std::nullopt),
              "a.csv: has 2 columns of values (1, 2); choose one with --column, by its name or its number");
    for (const std::string number : {"0", "3", "-1", "1.5", "18446744073709551617"}) {
        EXPECT_NE(refusal("400 0.1 0.2\n", number).find("has no column \"" + number + "\""), std::string::npos);
    }
}

TEST(ColumnChoice, RefusalListsTwentyColumnsAtMost) {
    std::string header = "nm";
    std::string row = "400";
    for (int i = 1; i <= 23; ++i) {
        header += fmt::format(",s{}", i);
        row += ",0.1";
    }
    const std::string message = refusal(header + "\n" + row + "\n", std::nullopt);
    EXPECT_NE(message.find("s19, s20 and 3 more)"), std::string::npos) << message;
    EXPECT_EQ(message.find("s21"), std::string::npos) << message;
}

TEST(ColumnChoice, RefusesAmbiguousNamesAndUncertainties) {
    EXPECT_NE(refusal("nm,R1,R1\n400,1,1\n", "R1").find("2 columns are called \"R1\" (numbers 1, 2)"),
              std::string::npos);
    EXPECT_EQ(chosen("nm,R1,R1\n400,0.1,0.2\n", "2").value, Numbers{0.2});
    EXPECT_NE(refusal(wide, "left_sigma").find("column \"left_sigma\" holds uncertainties"), std::string::npos);
    EXPECT_NE(refusal(wide, "3").find("column \"3\" holds uncertainties"), std::string::npos);
    EXPECT_NE(refusal("nm,sigma\n400,1\n", std::nullopt).find("has no column of values"), std::string::npos);
    EXPECT_NE(refusal("nm,R,sigma,sigma\n400,1,1,1\n", "R").find("2 columns are called \"sigma\""), std::string::npos);
}

TEST(ColumnChoice, RefusesSpectraInRows) {
    try {
        (void)parse_spectrum("id,400,410,420\n7,0.1,0.2,0.3\n", "a.csv", {.column = "400"}, "columns");
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("one spectrum per line"), std::string::npos) << error.what();
    }
    const std::string numbers = "nm,400,410,420\n450,0.1,0.2,0.3\n550,0.1,0.2,0.3\n";
    EXPECT_EQ(chosen(numbers, "410").value, (Numbers{0.2, 0.2})) << "numbers may be names";
}

}  // namespace
}  // namespace skinfit
