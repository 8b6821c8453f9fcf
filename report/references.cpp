#include "report/references.hpp"

#include <algorithm>

#include "core/embedded_file.hpp"
#include "core/text.hpp"

namespace skinfit {

namespace reference_list {
std::span<const EmbeddedFile> embedded_files();
}  // namespace reference_list

namespace {

/// Entries of the list read `**[...]** text`, over several lines, up to an empty one.
std::vector<std::pair<std::string, std::string>> all_references() {
    constexpr std::string_view begin = "**[";
    constexpr std::string_view end = "]**";
    std::vector<std::pair<std::string, std::string>> entries;
    bool inside = false;
    for (const std::string_view line : split_lines(reference_list::embedded_files().front().text)) {
        if (line.starts_with(begin)) {
            const std::size_t close = line.find(end);
            entries.emplace_back(line.substr(begin.size(), close - begin.size()),
                                 trimmed(line.substr(close + end.size())));
            inside = true;
        } else if (trimmed(line).empty()) {
            inside = false;
        } else if (inside) {
            entries.back().second += " " + std::string(trimmed(line));
        }
    }
    return entries;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> cited_references(std::string_view text) {
    std::vector<std::pair<std::string, std::string>> cited = all_references();
    std::erase_if(cited, [text](const auto& entry) {
        return text.find("[" + entry.first + "]") == std::string_view::npos &&
               text.find("[" + entry.first + ",") == std::string_view::npos;
    });
    return cited;
}

}  // namespace skinfit
