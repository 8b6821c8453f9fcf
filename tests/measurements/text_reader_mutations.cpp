#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "core/input_error.hpp"
#include "measurements/text_reader.hpp"
#include "tests/support/mutants.hpp"

namespace skinfit {
namespace {

const std::vector<std::string> valid_texts{
    "# specimen: arm\n# quantity: reflectance\n# unit: fraction\n# incidence_deg: 45\n# specular: excluded\n"
    "wavelength_nm,reflectance\n390,0.0675\n395,0.0655\n400,0.0651\n",
    "  4.5000000e+002  8.1625488e-004\r\n  4.5100000e+002  8.4917975e-004\r\n  4.5200000e+002  8.7034448e-004\r\n",
    "nm;\"R, %\";sigma\n400,5;12,5;0,1\n401,5;12,6;0,2\n402,5;12,7;0,3;\n",
    "nm\tleft\tleft_sigma\tright\r500\t+0.5\t0.01\t\r490\t0.4\t0.02\tNaN\r",
};

constexpr std::string_view marks = "\n\r\t ,;.#\":+-eE0%\\";

void expect_invariants(const Spectrum& spectrum) {
    const std::size_t size = spectrum.wavelength_nm.size();
    EXPECT_GE(size, 1U);
    EXPECT_EQ(spectrum.value.size(), size);
    EXPECT_TRUE(spectrum.sigma.empty() || spectrum.sigma.size() == size);
    EXPECT_TRUE(std::ranges::is_sorted(spectrum.wavelength_nm, std::ranges::less_equal{}));
    const auto within = [](double low, double high) { return [=](double x) { return x >= low && x <= high; }; };
    EXPECT_TRUE(std::ranges::all_of(spectrum.wavelength_nm, within(100, 10000)));
    EXPECT_TRUE(std::ranges::all_of(spectrum.value, within(0, 1.5)));
    EXPECT_TRUE(std::ranges::all_of(spectrum.sigma, [](double x) { return x > 0 && std::isfinite(x); }));
    const std::optional<double> incidence = spectrum.geometry.incidence_deg;
    EXPECT_TRUE(!incidence || within(0, std::nextafter(90, 0))(*incidence));
    EXPECT_EQ(spectrum.source, "mutant.csv");
    EXPECT_FALSE(spectrum.unit_rule.empty());
}

TEST(TextReader, ReadsOrRefusesEveryMutantOfAValidText) {
    constexpr int mutants = 4000;
    constexpr std::uint64_t seed = 20240229;
    std::mt19937_64 random(seed);
    int read = 0;
    for (int i = 0; i < mutants && !testing::Test::HasFailure(); ++i) {
        std::string text = valid_texts[random() % valid_texts.size()];
        for (std::uint64_t changes = 1 + random() % 3; changes > 0; --changes)
            text = test::mutated(text, marks, random);
        SCOPED_TRACE(testing::PrintToString(text));
        try {
            const std::optional<std::string> column =
                random() % 2 == 0 ? std::optional<std::string>("1") : std::nullopt;
            expect_invariants(parse_spectrum(text, "mutant.csv", {.column = column}));
            ++read;
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_TRUE(message.starts_with("mutant.csv:")) << message;
            EXPECT_EQ(message.find_first_of("\n\r"), std::string::npos) << message;
        } catch (const std::exception& error) {
            ADD_FAILURE() << "another exception: " << error.what();
        }
    }
    // Both outcomes must be common, or the mutants exercise only half of the reader.
    EXPECT_GT(read, mutants / 10);
    EXPECT_LT(read, mutants - mutants / 10);
}

}  // namespace
}  // namespace skinfit
