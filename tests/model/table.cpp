#include "model/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "tests/support/reference_spectrum.hpp"

namespace skinfit {
namespace {

const std::string notes = "# quantity: q\n# unit: u\n# source: s\n# below_range: error\n# above_range: zero\n";

Table table_of(const std::string& rows) {
    return parse_table("example", notes + rows);
}

TEST(Table, KeepsItsProvenance) {
    const Table table = table_of("wavelength_nm,a\n400,1\n500,2\n");
    EXPECT_EQ(table.name, "example");
    EXPECT_EQ(table.quantity, "q");
    EXPECT_EQ(table.unit, "u");
    EXPECT_EQ(table.source, "s");
    EXPECT_EQ(table.below, OutsideRange::error);
    EXPECT_EQ(table.above, OutsideRange::zero);
    EXPECT_EQ(table.column("a"), (std::vector<double>{1, 2}));
}

TEST(Table, CurveIsExactAtNodesAndLinearBetween) {
    // All numbers, shares and products are dyadic: no rounding anywhere.
    const Table table = table_of("wavelength_nm,a,b\n400,1,8\n500,3,-4\n504,4,0\n");
    const Curve a(table, "a");
    const Curve b(table, "b");
    EXPECT_EQ(a(400), 1.0);
    EXPECT_EQ(a(425), 1.5);
    EXPECT_EQ(a(450), 2.0);
    EXPECT_EQ(a(500), 3.0);
    EXPECT_EQ(a(501), 3.25);
    EXPECT_EQ(a(504), 4.0);
    EXPECT_EQ(b(450), 2.0);
    EXPECT_EQ(b(500), -4.0);
    EXPECT_EQ(b(502), -2.0);
    EXPECT_EQ(b(504), 0.0);
}

TEST(Table, OutsideRangeIsWhatTheTableSays) {
    const Table table = table_of("wavelength_nm,a\n400,1\n500,2\n");
    const Curve curve(table, "a");
    EXPECT_EQ(curve(500.001), 0.0);
    EXPECT_THROW((void)curve(399.999), InputError);
    EXPECT_THROW((void)curve(std::nan("")), InputError);
    try {
        (void)curve(399);
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "wavelength 399 nm: outside the table example (measured from 400 to 500 nm and never extrapolated); "
                  "choose wavelengths inside that range");
    }
}

TEST(Table, MalformedTextIsRefused) {
    const std::string header = "wavelength_nm,a\n";
    EXPECT_NO_THROW((void)table_of(header + "400,1\n500,2\n"));
    for (const std::string rows : {"400,1\n", "400,1\n500\n", "400,1\n500,2,3\n", "400,1\n500,x\n", "500,1\n400,2\n",
                                   "400,1\n400,2\n", "400,1\n\n500,2\n", "400,1\n500,\n"}) {
        EXPECT_THROW((void)table_of(header + rows), std::logic_error) << rows;
    }
    EXPECT_THROW((void)parse_table("t", ""), std::logic_error);
    EXPECT_THROW((void)table_of("wavelength_nm\n400\n500\n"), std::logic_error);
    EXPECT_THROW((void)parse_table("t", notes + "# a note without a key\n" + header + "400,1\n500,2\n"),
                 std::logic_error);
    for (const std::string_view missing : {"quantity", "unit", "source", "below_range", "above_range"}) {
        std::string text = notes + header + "400,1\n500,2\n";
        text.replace(text.find(missing), missing.size(), "other");
        EXPECT_THROW((void)parse_table("t", text), std::logic_error) << missing;
    }
    std::string text = notes + header + "400,1\n500,2\n";
    text.replace(text.find("zero"), 4, "none");
    EXPECT_THROW((void)parse_table("t", text), std::logic_error);
}

using NamePair = std::pair<const char*, const char*>;  // embedded table, file in ../shared/figures

class EmbeddedTable : public testing::TestWithParam<NamePair> {};

TEST_P(EmbeddedTable, StatesQuantityUnitAndSource) {
    const Table& table = embedded_table(GetParam().first);
    EXPECT_EQ(table.name, GetParam().first);
    EXPECT_FALSE(table.quantity.empty());
    EXPECT_FALSE(table.unit.empty());
    EXPECT_TRUE(table.source.find('[') != std::string::npos) << "no citation key";
}

TEST_P(EmbeddedTable, IsExactAtItsNodes) {
    const Table& table = embedded_table(GetParam().first);
    for (std::size_t c = 1; c < table.columns.size(); ++c) {
        const Curve curve(table, table.column_names[c]);
        for (std::size_t row = 0; row < table.columns[0].size(); ++row) {
            EXPECT_EQ(curve(table.columns[0][row]), table.columns[c][row]);
        }
    }
}

TEST_P(EmbeddedTable, HoldsTheNumbersOfItsFigureFile) {
    const std::filesystem::path path = test::shared_folder() / "figures" / GetParam().second;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "../shared is absent";
    const Table& table = embedded_table(GetParam().first);
    const std::string text = read_file(path);
    std::size_t row = 0;
    bool columns_named = false;
    for (const std::string_view line : split_lines(text)) {
        if (line.starts_with('#')) continue;
        const std::vector<std::string_view> fields = split(line, ',');
        ASSERT_EQ(fields.size(), table.columns.size());
        if (columns_named) {
            ASSERT_LT(row, table.columns[0].size());
            for (std::size_t c = 0; c < fields.size(); ++c) {
                EXPECT_EQ(table.columns[c][row], parse_number(fields[c]).value()) << line;
            }
            ++row;
        }
        columns_named = true;
    }
    EXPECT_EQ(row, table.columns[0].size());
}

INSTANTIATE_TEST_SUITE_P(
    All, EmbeddedTable,
    testing::Values(NamePair{"beta_carotene", "beta_carotene.csv"}, NamePair{"bilirubin", "bilirubin.csv"},
                    NamePair{"cie_d65", "cie_d65.csv"}, NamePair{"cie_observers", "cie_cmf.csv"},
                    NamePair{"eumelanin", "eumelanin.csv"}, NamePair{"forward_scattering", "bruls_van_der_leun.csv"},
                    NamePair{"hemoglobin", "hemoglobin.csv"}, NamePair{"pheomelanin", "pheomelanin.csv"}),
    [](const auto& test) { return std::string(test.param.first); });

}  // namespace
}  // namespace skinfit
