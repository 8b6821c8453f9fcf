#pragma once

#include <string>
#include <vector>

#include "report/html.hpp"

namespace skinfit {

/// How the cells of a column stand; figures of one column stand under each other.
enum class Cells { text, numbers };

/// A column of a table.
struct HtmlColumn {
    std::string name;
    std::string unit{};  ///< behind the name, where there is one
    Cells cells = Cells::numbers;
};

/// A table whose first column names its rows.
struct HtmlTable {
    std::string caption;  ///< above the table; none where it is empty
    std::vector<HtmlColumn> columns;
    std::vector<std::vector<Html>> rows;  ///< each with a cell per column
};

/// The table in a box of its own that scrolls sideways on narrow screens, with headers that say what they head.
[[nodiscard]] Html html_table(const HtmlTable& table);

}  // namespace skinfit
