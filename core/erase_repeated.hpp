#pragma once

#include <algorithm>
#include <functional>
#include <vector>

namespace skinfit {

/// Of neighbours with the same `projection`, all but the first are erased. (std::ranges::unique of libstdc++ 12 does
/// not compile with clang 14.)
template <class Value, class Projection = std::identity>
void erase_repeated(std::vector<Value>& values, Projection projection = {}) {
    const auto same = [&](const Value& a, const Value& b) {
        return std::invoke(projection, a) == std::invoke(projection, b);
    };
    values.erase(std::unique(values.begin(), values.end(), same), values.end());
}

}  // namespace skinfit
