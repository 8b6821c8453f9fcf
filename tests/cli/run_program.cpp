#include "tests/cli/run_program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

#include "core/file.hpp"

namespace skinfit::test {
namespace {

int open_for_writing(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (descriptor < 0) throw std::runtime_error("cannot open " + path.string());
    return descriptor;
}

/// The writing end of a pipe that nobody reads.
int closed_pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("cannot make a pipe");
    ::close(ends[0]);
    return ends[1];
}

int open_stdout(Stdout where, const std::filesystem::path& captured) {
    switch (where) {
        case Stdout::closed_pipe:
            return closed_pipe();
        case Stdout::full_device:
            return open_for_writing("/dev/full");
        default:
            return open_for_writing(captured);
    }
}

}  // namespace

Outcome run_skinfit(const std::vector<std::string>& arguments, const std::filesystem::path& folder, Stdout where) {
    // Beside the folder of the test, where a file left behind would show.
    const std::filesystem::path out = folder.string() + ".stdout";
    const std::filesystem::path err = folder.string() + ".stderr";
    std::filesystem::remove(out);
    const int out_descriptor = open_stdout(where, out);
    const int err_descriptor = open_for_writing(err);
    std::vector<char*> argv = {const_cast<char*>("skinfit")};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child == 0) {
        ::dup2(out_descriptor, STDOUT_FILENO);
        ::dup2(err_descriptor, STDERR_FILENO);
        if (::chdir(folder.c_str()) == 0) ::execv(SKINFIT_PROGRAM, argv.data());
        ::_exit(127);
    }
    ::close(out_descriptor);
    ::close(err_descriptor);
    int status = 0;
    if (::waitpid(child, &status, 0) != child) throw std::runtime_error("lost the program");
    Outcome outcome{.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                    .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                    .out = std::filesystem::exists(out) ? read_file(out) : "",
                    .err = read_file(err)};
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return outcome;
}

}  // namespace skinfit::test
