#include "tests/cli/terminal_run.hpp"

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace skinfit::test {

Outcome run_on_terminal(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                        const std::string& moment, At at) {
    std::vector<std::string> words = {skinfit_program()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    int terminal = -1;
    const int process = ::forkpty(&terminal, nullptr, nullptr, nullptr);
    if (process < 0) throw std::runtime_error("cannot open a terminal");
    if (process == 0) {
        if (::chdir(folder.c_str()) == 0) ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    Outcome outcome{};
    bool has_happened = moment.empty();
    std::array<char, 4096> block{};
    // Reading fails once the program has closed its side.
    for (ssize_t count = 0; (count = ::read(terminal, block.data(), block.size())) > 0;) {
        outcome.out.append(block.data(), static_cast<std::size_t>(count));
        if (has_happened || outcome.out.find(moment) == std::string::npos) continue;
        has_happened = true;
        if (at == At::close) break;
        constexpr char control_c = '\x03';
        if (::write(terminal, &control_c, 1) != 1) throw std::runtime_error("cannot type");
    }
    ::close(terminal);
    int status = 0;
    if (::waitpid(process, &status, 0) != process) throw std::runtime_error("lost the program");
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    return outcome;
}

}  // namespace skinfit::test
