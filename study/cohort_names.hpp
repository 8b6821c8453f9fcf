#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/json.hpp"

namespace skinfit {

/// The settings of a configuration that a simulation depends on and that the cohort does not state itself.
[[nodiscard]] std::span<const std::string_view> model_settings();

/// Those of them that say how a reading is taken, whatever makes the spectra.
[[nodiscard]] std::span<const std::string_view> reading_settings();

/// Text that can stand in a cell of a table as it is. Throws InputError, naming `where`, for anything else.
[[nodiscard]] std::string read_cell(const Json& value, const std::string& where);

/// Throws InputError, naming `where`, for a name that no column of the manifest can have, or that another has already.
void check_column_name(const std::string& name, const std::string& where);

}  // namespace skinfit
