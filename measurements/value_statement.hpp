#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/geometry.hpp"
#include "measurements/unit_rule.hpp"

/// What the words of a file say about the values beside or below them, wherever they stand: in the name of a column or
/// row, in a label, in the preamble. One vocabulary for all readers of tables.
namespace skinfit {

/// What some words state about values; all empty where they state nothing.
struct ValueStatement {
    std::optional<Quantity> quantity{};
    std::optional<Unit> unit{};
    std::string unusable{};  ///< the words by which the values are neither reflectance nor transmittance, or scaled
    bool is_signal = false;  ///< these are words of raw signals, such as `raw` or `intensity`, that may be names too

    [[nodiscard]] bool is_empty() const { return !quantity && !unit && unusable.empty(); }
};

/// Reads words such as `Reflect. [1.0]`, `%R`, `log(1/R)`, `Norm. DN (Target)` or `Reflectance x10000`. What was
/// derived from a reflectance, as its absorbance, is unusable though the word reflectance stands beside it.
[[nodiscard]] ValueStatement values_stated(std::string_view text);

/// The same, and what `R`, `T` or `A` states where it is all that stands there beside a unit: the letter of the
/// quantity.
[[nodiscard]] ValueStatement values_stated_by_letter(std::string_view text);

/// The same of a text that holds nothing else, as `Absorbance (AU)` or `Raw counts` may be a label or a line; nothing
/// where other words stand beside, as in `arm in absorbance`.
[[nodiscard]] ValueStatement values_stated_wholly(std::string_view text);

/// Whether the letters `R`, `T` and `A` among names are quantities: not where other single letters stand beside them.
[[nodiscard]] bool is_quantity_letter(std::string_view name);
/// True for a name of one letter.
[[nodiscard]] bool is_single_letter(std::string_view name);

/// SCI, SPIN, `specular included`, `di:8` and the like, or their opposites and 45/0; nothing where neither or both are
/// stated. The short forms of ISO 7724 count as words in capitals or, SCI and SCE, in small letters or as all there is:
/// `Sci. Rep.` is a journal.
[[nodiscard]] std::optional<Specular> specular_stated(std::string_view text);

/// The same of a label: its value states it, or its value answers, by yes or no, what its name asks.
[[nodiscard]] std::optional<Specular> specular_stated(std::string_view name, std::string_view value);

}  // namespace skinfit
