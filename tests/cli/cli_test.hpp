#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/file.hpp"
#include "tests/cli/run_program.hpp"

namespace skinfit::test {

/// A test of the program, in an empty folder of its own. What the program keeps is shared by all tests of this build,
/// or each would make the same emulators again.
class CliTest : public ::testing::Test {
protected:
    void SetUp() override {
        root_ = std::filesystem::temp_directory_path() / ("skinfit_cli_test_" + std::to_string(::getpid()));
        std::filesystem::remove_all(root_);
        folder_ = root_ / "work";
        std::filesystem::create_directories(folder_);
        ::setenv("SKINFIT_CACHE_DIR", cache_of_build().c_str(), 1);
    }
    void TearDown() override { std::filesystem::remove_all(root_); }

    [[nodiscard]] Outcome run(const std::vector<std::string>& arguments, Stdout where = Stdout::captured) const {
        return run_skinfit(arguments, folder_, where);
    }

    /// Expects a refusal of bad input that says `what`, and no output.
    void expect_refusal(const std::vector<std::string>& arguments, const std::string& what) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
    }

    [[nodiscard]] std::filesystem::path folder() const { return folder_; }

    /// Writes a file into the folder of the test.
    void put(const std::string& name, const std::string& text) const { write_file_atomically(folder_ / name, text); }

private:
    /// Of this very program: another build has another.
    [[nodiscard]] static std::filesystem::path cache_of_build() {
        const std::filesystem::path program = skinfit_program();
        const auto built = std::filesystem::last_write_time(program).time_since_epoch().count();
        return program.parent_path() / "tests" / "cli" / ("cache_" + std::to_string(built));
    }

    std::filesystem::path root_;
    std::filesystem::path folder_;
};

}  // namespace skinfit::test
