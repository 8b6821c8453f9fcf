#include "core/csv.hpp"

#include "core/text.hpp"
#include "core/utf8.hpp"

namespace skinfit {
namespace {

bool is_calculated(std::string_view text) {
    constexpr std::string_view beginnings = "=+-@";
    return text.size() > 1 && beginnings.find(text.front()) != std::string_view::npos && !parse_number(text);
}

}  // namespace

std::string marked_as_text(std::string_view text) {
    return is_calculated(text) ? "'" + std::string(text) : std::string(text);
}

std::string_view without_text_mark(std::string_view cell) {
    return cell.starts_with('\'') && is_calculated(cell.substr(1)) ? cell.substr(1) : cell;
}

std::string csv_cell(std::string_view text) {
    const std::string cell = marked_as_text(printable(text));
    if (cell.find_first_of(",;\"") == std::string::npos) return cell;
    std::string quoted = "\"";
    for (const char c : cell) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + "\"";
}

}  // namespace skinfit
