#include "measurements/described_table.hpp"

#include <fmt/format.h>

namespace skinfit {

DescribedTable described_table(std::string_view text, const std::string& source) {
    DescribedTable table{.columns = split_columns(text, source), .statements = {}, .description = {}, .plan = {}};
    const Columns& columns = table.columns;
    std::vector<Comment> prose = columns.preamble;
    prose.insert(prose.end(), columns.epilogue.begin(), columns.epilogue.end());
    table.statements = statements_in(source, columns.comments, prose);
    if (!columns.epilogue.empty()) {
        table.statements.remarks.push_back(fmt::format("what follows the readings, from line {} on, is taken as a log",
                                                       columns.epilogue.front().line));
    }
    table.description = read_description(source, columns.comments);
    const std::vector<FileNote> notes = notes_in(prose);
    table.description.notes.insert(table.description.notes.end(), notes.begin(), notes.end());
    table.plan = plan_table(columns, table.statements);
    return table;
}

}  // namespace skinfit
