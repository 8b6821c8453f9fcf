#include "report/html_table.hpp"

#include <cassert>

namespace skinfit {
namespace {

HtmlAttributes with_alignment(HtmlAttributes attributes, const HtmlColumn& column) {
    if (column.cells == Cells::numbers) attributes.emplace_back("class", "number");
    return attributes;
}

Html header_cell(const HtmlColumn& column) {
    Html content = escaped(column.name);
    if (!column.unit.empty()) {
        content += Html{" "} + element("span", escaped("(" + column.unit + ")"), {{"class", "unit"}});
    }
    return element("th", content, with_alignment({{"scope", "col"}}, column));
}

Html body_row(const std::vector<HtmlColumn>& columns, const std::vector<Html>& row) {
    assert(row.size() == columns.size());
    Html cells = element("th", row.front(), with_alignment({{"scope", "row"}}, columns.front()));
    for (std::size_t i = 1; i < row.size(); ++i) cells += element("td", row[i], with_alignment({}, columns[i]));
    return element("tr", cells) + Html{"\n"};
}

}  // namespace

Html html_table(const HtmlTable& table) {
    assert(!table.columns.empty());
    Html header;
    for (const HtmlColumn& column : table.columns) header += header_cell(column);
    Html body;
    for (const std::vector<Html>& row : table.rows) body += body_row(table.columns, row);
    Html content;
    if (!table.caption.empty()) content += element("caption", escaped(table.caption)) + Html{"\n"};
    content += element("thead", element("tr", header)) + Html{"\n"} + element("tbody", Html{"\n"} + body);
    const std::string name = table.caption.empty() ? table.columns.front().name : table.caption;
    // A box that scrolls is reached by the keyboard only where it can have the focus, and then needs a name.
    return element("div", element("table", content),
                   {{"class", "scroll"}, {"role", "region"}, {"tabindex", "0"}, {"aria-label", name}}) +
           Html{"\n"};
}

}  // namespace skinfit
