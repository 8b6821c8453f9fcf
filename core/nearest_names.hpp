#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What somebody who wrote an unknown name probably meant: the one place that every message of this kind asks.
namespace skinfit {

/// `name` as the program spells its own: in lower case, with _ for blanks and dashes, without such at its ends.
[[nodiscard]] std::string spelt(std::string_view name);

/// The names that the everyday word `name` stands for, the likeliest first: the rows of core/data/everyday_words.csv.
/// Empty where it is none. Capitals, blanks and a plural do not matter.
[[nodiscard]] std::span<const std::string_view> everyday_names(std::string_view name);

/// Those of `known` (not empty) that `name` probably means, the likeliest first: what it stands for in everyday words,
/// else the first that holds it as a part, else the one of which it is a slip, else what a word in it stands for. Empty
/// where nothing is near.
[[nodiscard]] std::vector<std::string_view> meant_names(std::string_view name, std::span<const std::string_view> known);

/// "a or b" of `names`, each within `before` and `after`.
[[nodiscard]] std::string either(std::span<const std::string_view> names, std::string_view before = "\"",
                                 std::string_view after = "\"");

}  // namespace skinfit
