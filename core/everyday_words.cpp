#include <algorithm>
#include <map>

#include "core/embedded_file.hpp"
#include "core/nearest_names.hpp"
#include "core/text.hpp"

namespace skinfit {
namespace core_data {
std::span<const EmbeddedFile> embedded_files();
}  // namespace core_data

namespace {

using Rows = std::map<std::string_view, std::vector<std::string_view>>;

Rows rows() {
    const auto files = core_data::embedded_files();
    const auto table = std::ranges::find(files, "everyday_words.csv", &EmbeddedFile::name);
    Rows rows;
    for (const std::string_view line : split_lines(table->text)) {
        if (line.starts_with('#') || line == "word,names") continue;
        const std::size_t comma = line.find(',');
        rows[line.substr(0, comma)] = split(line.substr(comma + 1), ' ');
    }
    return rows;
}

}  // namespace

std::span<const std::string_view> everyday_names(std::string_view name) {
    static const Rows words = rows();
    std::string word = spelt(name);
    auto found = words.find(word);
    if (found == words.end() && word.ends_with('s')) {
        word.pop_back();
        found = words.find(word);
    }
    return found == words.end() ? std::span<const std::string_view>() : found->second;
}

}  // namespace skinfit
