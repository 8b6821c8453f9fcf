#pragma once

#include <string>

#include "core/json.hpp"
#include "tests/cli/cli_test.hpp"

namespace skinfit::test {

/// A test of studies: a file of spectra that lie about those of a light skin, and a study of them.
class StudyTest : public CliTest {
protected:
    void SetUp() override;

    /// A table with a spectrum in each row, all different.
    [[nodiscard]] static std::string spectra_text(int count);

    /// Writes a study of `inputs` (JSON) to `name`.json with the output folder `name`.
    void put_study(const std::string& name, const std::string& inputs, const std::string& more = "") const;

    /// What the study called `name` found: its export as JSON without what says how long it took.
    [[nodiscard]] Json answers(const std::string& name) const;

    static constexpr int spectra = 64;
};

}  // namespace skinfit::test
