#include "fit/gnuplot.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "core/unfinished.hpp"

namespace skinfit {
namespace {

using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void refuse_without_scratch(int error) {
    throw InputError({.where = "plot",
                      .problem = "no temporary file can be written",
                      .why = std::strerror(error),
                      .remedy = "make space in the folder of temporary files, or do without the plot"});
}

/// A file without a name, gone when it is closed.
Stream scratch_file() {
    Stream stream(std::tmpfile(), &std::fclose);
    if (!stream) refuse_without_scratch(errno);
    return stream;
}

std::string content_of(const Stream& stream) {
    constexpr std::size_t block = std::size_t{1} << 16U;
    std::rewind(stream.get());
    std::string bytes;
    for (std::size_t filled = 0;;) {
        bytes.resize(filled + block);
        filled += std::fread(bytes.data() + filled, 1, block, stream.get());
        if (filled == bytes.size()) continue;
        bytes.resize(filled);
        return bytes;
    }
}

[[noreturn]] void refuse_without_gnuplot(int error) {
    throw InputError({.where = "plot",
                      .problem = "gnuplot cannot be run",
                      .why = std::strerror(error),
                      .remedy = "install it (Debian: apt-get install gnuplot-nox), or do without the plot"});
}

constexpr std::array<char, 8> program_name{"gnuplot"};

struct Streams {
    Stream in;
    Stream out;
    Stream err;
};

/// Runs gnuplot with these streams, in a process group of its own, and gives its number.
pid_t started_gnuplot(const Streams& streams) {
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ::fileno(streams.in.get()), STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, ::fileno(streams.out.get()), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, ::fileno(streams.err.get()), STDERR_FILENO);
    // Signals that this program waits for by itself, or ignores, are for gnuplot as usual.
    ::sigset_t none{};
    ::sigset_t all{};
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    std::array<char, 8> name = program_name;
    std::array<char, 3> no_personal_settings{"-d"};
    const std::array<char*, 3> arguments = {name.data(), no_personal_settings.data(), nullptr};
    int failure = 0;
    const pid_t child = begin_child([&] {
        pid_t started = 0;
        failure = ::posix_spawnp(&started, name.data(), &actions, &attributes, arguments.data(), environ);
        return failure == 0 ? started : 0;
    });
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) refuse_without_gnuplot(failure);
    return child;
}

}  // namespace

std::string gnuplot_terminal(const std::filesystem::path& path, const PictureSize& size) {
    constexpr double pixels_per_cm = 40.0;
    const std::string suffix = path.extension().string();
    const std::string in_pixels = fmt::format("noenhanced size {},{}", size.width, size.height);
    if (suffix == ".svg") return fmt::format("set terminal svg {} font 'sans,14' background 'white'\n", in_pixels);
    if (suffix == ".png") return fmt::format("set terminal pngcairo {} font 'sans,11'\n", in_pixels);
    if (suffix == ".pdf") {
        return fmt::format("set terminal pdfcairo noenhanced size {}cm,{}cm font 'sans,11'\n",
                           size.width / pixels_per_cm, size.height / pixels_per_cm);
    }
    throw InputError({.where = path.string(),
                      .problem = fmt::format("unknown suffix \"{}\" of a plot", suffix),
                      .why = "it decides the form of the picture",
                      .remedy = "end the name in .svg, .png or .pdf"});
}

std::string gnuplot_string(std::string_view text) {
    std::string result = "'";
    if (text.starts_with('\'')) {  // a doubled quote cannot stand first
        result += "\u2019";
        text.remove_prefix(1);
    }
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\'') result += '\'';  // between single quotes only the quote itself is special
        result += byte < 0x20 || byte == 0x7f ? ' ' : c;
    }
    return result + "'";
}

std::string gnuplot_data(std::string_view name, const std::vector<double>& x, const std::vector<double>& y) {
    assert(!x.empty() && x.size() == y.size());
    std::string block = fmt::format("${} << END\n", name);
    for (std::size_t i = 0; i < x.size(); ++i) block += fmt::format("{} {}\n", x[i], y[i]);
    return block + "END\n";
}

std::string gnuplot_table(std::string_view name, const std::vector<std::vector<double>>& rows) {
    assert(!rows.empty());
    std::string block = fmt::format("${} << END\n", name);
    for (const std::vector<double>& row : rows) block += fmt::format("{}\n", fmt::join(row, " "));
    return block + "END\n";
}

void require_gnuplot() {
    const char* const path = std::getenv("PATH");
    int problem = ENOENT;
    for (const std::string_view folder : split(path == nullptr ? "/bin:/usr/bin" : path, ':')) {
        const std::filesystem::path program = std::filesystem::path(folder) / program_name.data();
        if (::access(program.c_str(), X_OK) == 0) return;
        if (errno == EACCES) problem = EACCES;
    }
    refuse_without_gnuplot(problem);
}

std::string gnuplot_picture(const std::string& script) {
    // Files carry the three streams, so that none of them can stall.
    const Streams streams{.in = scratch_file(), .out = scratch_file(), .err = scratch_file()};
    const bool is_stored = std::fwrite(script.data(), 1, script.size(), streams.in.get()) == script.size();
    if (!is_stored || std::fflush(streams.in.get()) != 0) refuse_without_scratch(errno);
    std::rewind(streams.in.get());
    const int status = wait_for_child(started_gnuplot(streams));
    std::string bytes = content_of(streams.out);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !bytes.empty()) return bytes;
    const std::string complaints = content_of(streams.err);
    std::string why =
        WIFSIGNALED(status) ? fmt::format("it was ended by signal {}", WTERMSIG(status)) : "it gave no reason";
    for (const std::string_view line : split_lines(complaints)) {
        if (!trimmed(line).empty()) why = trimmed(line);
    }
    throw InputError({.where = "plot",
                      .problem = "gnuplot failed",
                      .why = why,
                      .remedy = "check that gnuplot draws this kind of file (Debian: gnuplot-nox)"});
}

}  // namespace skinfit
