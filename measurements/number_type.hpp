#pragma once

#include <cstddef>

namespace skinfit {

/// What kind of number is stored.
enum class NumberKind { uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// How one number is stored.
struct NumberType {
    NumberKind kind = NumberKind::uint8;
    std::size_t bytes = 1;
    bool most_significant_byte_first = false;

    /// True where only whole numbers can be stored.
    [[nodiscard]] bool whole() const { return kind != NumberKind::float32 && kind != NumberKind::float64; }
};

}  // namespace skinfit
