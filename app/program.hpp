#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "app/session.hpp"

namespace skinfit {

/// The program with all of its commands, ready to parse a command line; `session` must outlive it.
[[nodiscard]] std::unique_ptr<CLI::App> make_program(Session& session);

}  // namespace skinfit
