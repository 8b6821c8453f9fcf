#include "fit/plot.hpp"

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

std::string terminal_of(const std::filesystem::path& path) {
    const std::string suffix = path.extension().string();
    if (suffix == ".svg") return "svg noenhanced size 1000,520 font 'sans,14' background 'white'";
    if (suffix == ".png") return "pngcairo noenhanced size 1000,520 font 'sans,11'";
    if (suffix == ".pdf") return "pdfcairo noenhanced size 25cm,13cm font 'sans,11'";
    throw InputError({.where = path.string(),
                      .problem = fmt::format("unknown suffix '{}' of a plot", suffix),
                      .why = "it decides the form of the picture",
                      .remedy = "end the name in .svg, .png or .pdf"});
}

/// `text` as a string of gnuplot's: between single quotes only the quote itself is special, and a line must not end.
std::string gnuplot_string(std::string_view text) {
    std::string result = "'";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\'') result += '\'';
        result += byte < 0x20 || byte == 0x7f ? ' ' : c;
    }
    return result + "'";
}

std::string script_of(const Plot& plot, const std::string& terminal) {
    assert(!plot.lines.empty());
    std::string script = "set encoding utf8\nset terminal " + terminal + "\n";
    for (std::size_t i = 0; i < plot.lines.size(); ++i) {
        const PlotLine& line = plot.lines[i];
        assert(!line.x.empty() && line.x.size() == line.y.size());
        script += fmt::format("$line{} << END\n", i);
        for (std::size_t point = 0; point < line.x.size(); ++point) {
            script += fmt::format("{} {}\n", line.x[point], line.y[point]);
        }
        script += "END\n";
    }
    // The title is centred on the picture: centred on the axes, a long one beside a wide legend would be cut off.
    script += fmt::format("set label {} at screen 0.5,0.955 center\nset tmargin 3\nset xlabel {}\nset ylabel {}\n",
                          gnuplot_string(plot.title), gnuplot_string(plot.x_label), gnuplot_string(plot.y_label));
    script +=
        "set linetype 5 linecolor rgb '#a65628'\n"  // brown: gnuplot's yellow is faint on white
        "set grid linetype 1 linecolor rgb '#d0d0d0' linewidth 0.5\n"
        "set xzeroaxis linetype 1 linecolor rgb '#606060'\n"
        "set key outside right top Left reverse\nplot ";
    constexpr std::size_t colours = 8;  // of gnuplot; then another dash tells lines apart
    for (std::size_t i = 0; i < plot.lines.size(); ++i) {
        script += fmt::format("{}$line{} with linespoints linewidth 2 pointtype 7 pointsize 0.4 dashtype {} title {}",
                              i == 0 ? "" : ", ", i, i / colours + 1, gnuplot_string(plot.lines[i].label));
    }
    return script + "\n";
}

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

/// The picture that gnuplot makes of `script`. Files carry the three streams, so that none of them can stall.
std::string picture(const std::string& script) {
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
    std::array<char, 8> name{"gnuplot"};
    std::array<char, 3> no_personal_settings{"-d"};
    const std::array<char*, 3> arguments = {name.data(), no_personal_settings.data(), nullptr};
    ::pid_t child = 0;
    const int failure = ::posix_spawnp(&child, name.data(), &actions, nullptr, arguments.data(), environ);
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

}  // namespace

void draw(const Plot& plot, const std::filesystem::path& path) {
    write_file_atomically(path, picture(script_of(plot, terminal_of(path))));
}

}  // namespace skinfit
