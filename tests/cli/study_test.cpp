#include "tests/cli/study_test.hpp"

#include <fmt/format.h>

#include <cmath>

#include "measurements/text_reader.hpp"

namespace skinfit::test {

void StudyTest::SetUp() {
    CliTest::SetUp();
    put("spectra.csv", spectra_text(spectra));
}

std::string StudyTest::spectra_text(int count) {
    const Spectrum skin =
        read_spectrum(std::filesystem::path(SKINFIT_SOURCE_DIR) / "measurements" / "data" / "ncsu_113.csv");
    constexpr std::size_t every = 5;  // 10 nm
    std::string text = "id";
    for (std::size_t i = 0; i < skin.wavelength_nm.size(); i += every)
        text += fmt::format(",{}", skin.wavelength_nm[i]);
    text += "\n";
    for (int k = 0; k < count; ++k) {
        text += fmt::format("s{}", k + 1);
        // Darker and darker, as more melanin makes it: more so at short wavelengths.
        for (std::size_t i = 0; i < skin.wavelength_nm.size(); i += every) {
            const double depth = 0.01 * k * std::pow(550.0 / skin.wavelength_nm[i], 3);
            text += fmt::format(",{:.6f}", skin.value[i] * std::exp(-depth));
        }
        text += "\n";
    }
    return text;
}

void StudyTest::put_study(const std::string& name, const std::string& inputs, const std::string& more) const {
    put(name + ".json", fmt::format(R"({{"name": "{0}", "inputs": {1}, "fit": {{"noise": 0.01}}, "output": "{0}"{2}}})",
                                    name, inputs, more.empty() ? "" : ", " + more));
}

Json StudyTest::answers(const std::string& name) const {
    const Outcome exported = run({"study", "export", name + ".json", "--format", "json"});
    EXPECT_EQ(exported.exit_code, 0) << exported.err;
    Json json = Json::parse(exported.out);
    json.erase("study");
    for (Json& each : json["spectra"]) each.erase("seconds");
    return json;
}

}  // namespace skinfit::test
