#include "measurements/column_words.hpp"

#include <algorithm>
#include <array>

#include "measurements/uncertainty_name.hpp"
#include "measurements/words.hpp"

namespace skinfit {

bool counts_readings(std::string_view name) {
    static constexpr std::array<std::string_view, 12> words = {"index", "pixel", "pixels", "band", "bands", "channel",
                                                               "row",   "#",     "no.",    "no",   "nr",    "line"};
    return std::ranges::find(words, plain_text(name)) != words.end();
}

bool is_label_in_front(std::string_view name) {
    static constexpr std::array<std::string_view, 14> words = {
        "id",        "sample", "n",    "i",    "number",  "rownames", "", "sample number",
        "sample no", "name",   "date", "time", "level_0", "idx"};
    const std::string plain = plain_text(name);
    return counts_readings(name) || plain.starts_with("unnamed") || plain.starts_with("sample") ||
           std::ranges::find(words, plain) != words.end();
}

bool is_raw_beside_quantity(std::string_view name) {
    static constexpr std::array<std::string_view, 8> words = {"dark", "white", "sample", "target",
                                                              "lamp", "light", "scope",  "object"};
    return std::ranges::find(words, plain_base(name)) != words.end();
}

bool is_raw_of_jaz(const std::vector<std::string>& names, std::size_t c) {
    return c > 0 && c < 4 && names == std::vector<std::string>{"W", "D", "R", "S", "P"};
}

}  // namespace skinfit
