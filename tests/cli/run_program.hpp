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

/// A program that runs.
class StartedProgram {
public:
    /// Starts `words`, the first of which is the program or its name on the search path, in `folder`.
    StartedProgram(const std::vector<std::string>& words, const std::filesystem::path& folder,
                   Stdout where = Stdout::captured);
    StartedProgram(const StartedProgram&) = delete;
    StartedProgram& operator=(const StartedProgram&) = delete;
    ~StartedProgram() = default;

    /// Ends it at once, as `kill -9` does.
    void kill() const;
    /// Sends it `signal`.
    void send(int signal) const;
    /// Waits for its end.
    [[nodiscard]] Outcome wait() const;

private:
    std::filesystem::path out_;
    std::filesystem::path err_;
    int process_;
};

/// The program that the tests run.
[[nodiscard]] std::string skinfit_program();

/// Runs skinfit with `arguments` in `folder`; its cache is the one of the test.
[[nodiscard]] Outcome run_skinfit(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                                  Stdout where = Stdout::captured);

}  // namespace skinfit::test
