#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skinfit::test {

/// What a run of the program left.
struct Outcome {
    int exit_code;  ///< -1 where a signal ended it
    int signal;     ///< 0 where it ended by itself
    std::string out;
    std::string err;
};

/// Where stdout leads.
enum class Stdout { captured, closed_pipe, full_device };

/// Runs skinfit with `arguments` in `folder`; its cache is the one of the test.
[[nodiscard]] Outcome run_skinfit(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                                  Stdout where = Stdout::captured);

}  // namespace skinfit::test
