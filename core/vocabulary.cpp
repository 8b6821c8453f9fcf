#include "core/vocabulary.hpp"

#include <algorithm>
#include <vector>

#include "core/embedded_file.hpp"
#include "core/text.hpp"

namespace skinfit {
namespace core_data {
std::span<const EmbeddedFile> embedded_files();
}  // namespace core_data

namespace {

std::string_view text_of(std::string_view file) {
    const auto files = core_data::embedded_files();
    return std::ranges::find(files, file, &EmbeddedFile::name)->text;
}

std::vector<Word> words_in(std::string_view file) {
    std::vector<Word> words;
    for (const std::string_view line : split_lines(text_of(file))) {
        if (line.starts_with('#') || line == "name,unit,meaning") continue;
        const std::size_t unit = line.find(',') + 1;
        const std::size_t meaning = line.find(',', unit) + 1;
        words.push_back({.name = line.substr(0, unit - 1),
                         .unit = line.substr(unit, meaning - unit - 1),
                         .meaning = line.substr(meaning)});
    }
    return words;
}

}  // namespace

std::span<const Word> vocabulary() {
    static const std::vector<Word> words = words_in("vocabulary.csv");
    return words;
}

std::span<const Word> labels() {
    static const std::vector<Word> words = words_in("labels.csv");
    return words;
}

}  // namespace skinfit
