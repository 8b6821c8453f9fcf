#include "app/outputs.hpp"

#include <fmt/format.h>

#include <exception>

#include "app/terminal.hpp"
#include "core/input_error.hpp"
#include "fit/gnuplot.hpp"

namespace skinfit {
namespace {

void warn_of_loss(Session& session, const std::string& text) {
    session.lacks_a_file = true;
    say_trouble("warning", text);
}

}  // namespace

void check_picture(const SharedOptions& picture, const std::string& option,
                   const std::vector<std::filesystem::path>& inputs) {
    if (picture.out.empty()) return;
    (void)gnuplot_terminal(picture.out, {.width = 1, .height = 1});  // refuses an unknown suffix
    check_output(picture, inputs, option);
    require_gnuplot();
}

void write_result(const SharedOptions& options, const std::string& text, const std::function<void()>& others) {
    std::exception_ptr failure;
    try {
        write_output(options, text);
    } catch (const InputError&) {
        failure = std::current_exception();
    }
    others();
    if (failure) std::rethrow_exception(failure);
}

void write_beside(Session& session, const std::filesystem::path& path, const std::function<void()>& write) {
    if (session.leaves_out_files) return warn_of_loss(session, fmt::format("{}: not written", path.string()));
    const bool was_interrupted = session.interrupt.signal().has_value();
    try {
        write();
    } catch (const InputError& error) {
        session.leaves_out_files = !was_interrupted && session.interrupt.signal();
        warn_of_loss(session, fmt::format("{}: not written: {}", path.string(), error.what()));
    }
}

}  // namespace skinfit
