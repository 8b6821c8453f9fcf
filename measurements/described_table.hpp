#pragma once

#include <string>
#include <string_view>

#include "measurements/columns.hpp"
#include "measurements/description.hpp"
#include "measurements/file_statements.hpp"
#include "measurements/table_plan.hpp"

namespace skinfit {

/// A text taken apart, and all that it states.
struct DescribedTable {
    Columns columns;
    FileStatements statements;
    Description description;
    TablePlan plan;
};

/// Takes `text` apart; throws InputError as the parts do.
[[nodiscard]] DescribedTable described_table(std::string_view text, const std::string& source);

}  // namespace skinfit
