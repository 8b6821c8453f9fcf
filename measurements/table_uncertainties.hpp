#pragma once

#include <string>

#include "measurements/table_plan.hpp"

namespace skinfit {

/// Finds the columns of uncertainties among those of values, and which values each belongs to; `where` is the header,
/// for messages. Throws InputError where two are equally good for one column.
void take_uncertainties(TablePlan& plan, const std::string& where);

}  // namespace skinfit
