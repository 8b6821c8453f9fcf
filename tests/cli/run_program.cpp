#include "tests/cli/run_program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
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

// Files beside the folder of the test, where one left behind would show; each program has its own.
StartedProgram::StartedProgram(const std::vector<std::string>& words, const std::filesystem::path& folder,
                               Stdout where) {
    static std::atomic<int> started = 0;
    const std::string name = folder.string() + "." + std::to_string(started++);
    out_ = name + ".stdout";
    err_ = name + ".stderr";
    const int out_descriptor = open_stdout(where, out_);
    const int err_descriptor = open_for_writing(err_);
    std::vector<std::string> arguments = words;
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    process_ = ::fork();  // NOLINT(cppcoreguidelines-prefer-member-initializer): once all is prepared
    if (process_ < 0) throw std::runtime_error("cannot fork");
    if (process_ == 0) {
        ::dup2(out_descriptor, STDOUT_FILENO);
        ::dup2(err_descriptor, STDERR_FILENO);
        if (::chdir(folder.c_str()) == 0) ::execvp(argv[0], argv.data());
        ::_exit(127);
    }
    ::close(out_descriptor);
    ::close(err_descriptor);
}

void StartedProgram::kill() const {
    send(SIGKILL);
}

void StartedProgram::send(int signal) const {
    ::kill(process_, signal);
}

Outcome StartedProgram::wait() const {
    int status = 0;
    if (::waitpid(process_, &status, 0) != process_) throw std::runtime_error("lost the program");
    Outcome outcome{.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                    .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                    .out = std::filesystem::exists(out_) ? read_file(out_) : "",
                    .err = read_file(err_)};
    std::filesystem::remove(out_);
    std::filesystem::remove(err_);
    return outcome;
}

std::string skinfit_program() {
    return SKINFIT_PROGRAM;
}

Outcome run_skinfit(const std::vector<std::string>& arguments, const std::filesystem::path& folder, Stdout where) {
    std::vector<std::string> words = {skinfit_program()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return StartedProgram(words, folder, where).wait();
}

}  // namespace skinfit::test
