#pragma once

#include <string>
#include <string_view>

namespace skinfit::test {

/// What is wrong with the tags of `markup` (an element that is not closed, or closed in the wrong order, a `<` or `"`
/// out of place, an `&` that starts no reference); empty where every element is closed in turn, as in XML.
[[nodiscard]] std::string tag_complaint(std::string_view markup);

}  // namespace skinfit::test
