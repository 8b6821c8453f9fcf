#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/session.hpp"
#include "app/shared_options.hpp"

/// In which order what a command makes is written, so that nothing that was computed is lost: the result first, then
/// pictures and pages.
namespace skinfit {

/// Throws InputError where no picture can be drawn into `picture.out`, the value of `option`: its ending, gnuplot, the
/// folder; before the work. Without a name nothing is drawn, and nothing is checked.
void check_picture(const SharedOptions& picture, const std::string& option,
                   const std::vector<std::filesystem::path>& inputs = {});

/// Writes the result as `write_output`, and then calls `others`, whatever has become of it.
void write_result(const SharedOptions& options, const std::string& text, const std::function<void()>& others);

/// Calls `write`, which makes the file at `path` beside a result that is written already. What goes wrong is a warning,
/// and the program ends with 1 at least. After a Ctrl-C during one of these calls the next ones do nothing.
void write_beside(Session& session, const std::filesystem::path& path, const std::function<void()>& write);

}  // namespace skinfit
