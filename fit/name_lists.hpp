#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/json.hpp"
#include "model/parameters.hpp"

namespace skinfit {

/// Which parameters are meant.
using ParameterMarks = std::array<bool, parameter_count>;

/// The names of all parameters, in the order of their table.
[[nodiscard]] std::vector<std::string_view> parameter_names();

/// Sets the marks of the parameters in `names`, "NAME,NAME", to `value`; "+NAME" is NAME where they are set. Throws
/// InputError naming `where` for an unknown one.
void mark_parameters(ParameterMarks& marks, std::string_view names, bool value, const std::string& where);

/// Changes `marks` by a list of names: names alone are the whole list, "+NAME" adds one to `marks` and "-NAME" takes
/// one away. Throws InputError naming `where` for an unknown name, one given twice, and a list in which some names have
/// a sign and others none.
void read_parameters_list(ParameterMarks& marks, const Json& json, const std::string& where);

/// The names of the marked, as `read_parameters_list` reads them: the whole list.
[[nodiscard]] Json parameters_list_json(const ParameterMarks& marks);

/// What JSON Schema says of such a list.
[[nodiscard]] Json parameters_list_schema(const std::string& meaning);

}  // namespace skinfit
