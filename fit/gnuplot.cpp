#include "fit/gnuplot.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"

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
    std::rewind(stream.get());
    std::string bytes;
    std::array<char, 1 << 16> buffer{};
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), stream.get())) {
        bytes.append(buffer.data(), count);
    }
    return bytes;
}

[[noreturn]] void refuse_without_gnuplot(int error) {
    throw InputError({.where = "plot",
                      .problem = "gnuplot cannot be run",
                      .why = std::strerror(error),
                      .remedy = "install it (Debian: apt-get install gnuplot-nox), or do without the plot"});
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

// Files carry the three streams, so that none of them can stall.
std::string gnuplot_picture(const std::string& script) {
    const Stream in = scratch_file();
    const Stream out = scratch_file();
    const Stream err = scratch_file();
    const bool is_stored = std::fwrite(script.data(), 1, script.size(), in.get()) == script.size();
    if (!is_stored || std::fflush(in.get()) != 0) refuse_without_scratch(errno);
    std::rewind(in.get());
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ::fileno(in.get()), STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, ::fileno(out.get()), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, ::fileno(err.get()), STDERR_FILENO);
    // What this program waits for by itself, such as Ctrl-C, must reach gnuplot.
    ::sigset_t no_signals{};
    ::sigemptyset(&no_signals);
    ::posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setsigmask(&attributes, &no_signals);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    std::array<char, 8> name{"gnuplot"};
    std::array<char, 3> no_personal_settings{"-d"};
    const std::array<char*, 3> arguments = {name.data(), no_personal_settings.data(), nullptr};
    ::pid_t child = 0;
    const int failure = ::posix_spawnp(&child, name.data(), &actions, &attributes, arguments.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) refuse_without_gnuplot(failure);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    std::string bytes = content_of(out);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !bytes.empty()) return bytes;
    std::string complaint;
    for (const std::string_view line : split_lines(content_of(err))) {
        if (!trimmed(line).empty()) complaint = trimmed(line);
    }
    throw InputError({.where = "plot",
                      .problem = "gnuplot failed",
                      .why = complaint.empty() ? "it gave no reason" : complaint,
                      .remedy = "check that gnuplot draws this kind of file (Debian: gnuplot-nox)"});
}

}  // namespace skinfit
