#include "core/json.hpp"
#include "core/text.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {
namespace {

using Arguments = std::vector<std::string>;
class SensitivityRuns : public CliTest {
protected:
    /// Expects success without a word on stderr; stdout.
    [[nodiscard]] std::string output_of(const Arguments& arguments) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return outcome.out;
    }
};

TEST_F(SensitivityRuns, CsvAndJsonHoldTheSameNumbers) {
    for (const Arguments& more : {Arguments{}, Arguments{"--relative"}}) {
        Arguments arguments = {"sensitivity", "--wavelengths", "450,550"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const std::string text = output_of(arguments);
        std::vector<std::vector<std::string_view>> rows;
        for (const std::string_view line : split_lines(text)) {
            if (!line.starts_with('#')) rows.push_back(split(line, ','));
        }
        ASSERT_EQ(rows.size(), 3U);
        ASSERT_EQ(rows[0][0], "wavelength_nm");
        ASSERT_EQ(rows[0][1], "reading");
        arguments.insert(arguments.end(), {"--format", "json"});
        const Json json = Json::parse(output_of(arguments));
        ASSERT_EQ(rows[0].size(), 2 + json["derivative"].size());
        for (std::size_t row = 0; row < 2; ++row) {
            ASSERT_EQ(rows[row + 1].size(), rows[0].size());
            EXPECT_EQ(parse_number(rows[row + 1][1]), json["reading"][row].get<double>());
            for (std::size_t column = 2; column < rows[0].size(); ++column) {
                const Json& entries = json["derivative"].at(std::string(rows[0][column]));
                EXPECT_EQ(parse_number(rows[row + 1][column]), entries[row].get<double>());
            }
        }
    }
}

TEST_F(SensitivityRuns, TransmittanceByOptionOrSetting) {
    const Arguments arguments = {"sensitivity", "--wavelengths", "550", "--set", "base=matched"};
    Arguments by_option = arguments;
    by_option.insert(by_option.end(), {"--quantity", "transmittance"});
    Arguments by_setting = arguments;
    by_setting.insert(by_setting.end(), {"--set", "quantity=transmittance"});
    EXPECT_NE(output_of(arguments), output_of(by_option));
    EXPECT_EQ(output_of(by_setting), output_of(by_option));
}

TEST_F(SensitivityRuns, ThePlotNamesTheFreeParameters) {
    (void)output_of({"sensitivity", "--wavelengths", "400:700:50", "--plot", "a.svg", "--free", "fibril_radius_nm",
                     "--fix", "oxygen_saturation"});
    const std::string svg = read_file(folder() / "a.svg");
    for (const std::string name : {"melanosome_fraction", "fibril_radius_nm", "wavelength (nm)"}) {
        EXPECT_NE(svg.find(name), std::string::npos) << name;
    }
    EXPECT_EQ(svg.find("oxygen_saturation"), std::string::npos);
}

TEST_F(SensitivityRuns, RefusalsNameTheCause) {
    expect_refusal({"sensitivity", "--wavelengths", "550", "--plot", "a.jpg"}, "unknown suffix \".jpg\"");
    expect_refusal({"sensitivity", "--wavelengths", "550", "--plot", "missing/a.svg"}, "cannot be written");
    expect_refusal({"sensitivity", "--wavelengths", "900"}, "900");
    expect_refusal({"sensitivity", "--quantity", "colour"}, "--quantity");
    EXPECT_TRUE(std::filesystem::is_empty(folder()));
}

}  // namespace
}  // namespace skinfit::test
