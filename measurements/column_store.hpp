#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "measurements/cell_numbers.hpp"

namespace skinfit {

/// A table's columns, taken out eight at a time: so many numbers share a cache line. The table must outlive it.
class ColumnStore {
public:
    explicit ColumnStore(const NumberTable& table) : table_(table), height_(table.cells.size() / table.width) {}
    /// The numbers of column `c`; valid until the next call.
    [[nodiscard]] const std::vector<double>& column(std::size_t c) {
        const std::size_t block = c / taken_.size();
        if (block_ != block) take(block);
        return taken_[c % taken_.size()];
    }

private:
    void take(std::size_t block) {
        block_ = block;
        const std::size_t first = block * taken_.size();
        const std::size_t count = std::min(taken_.size(), table_.width - first);
        for (std::size_t i = 0; i < count; ++i) taken_[i].resize(height_);
        for (std::size_t row = 0; row < height_; ++row) {
            const double* const cells = table_.cells.data() + row * table_.width + first;
            for (std::size_t i = 0; i < count; ++i) taken_[i][row] = cells[i];
        }
    }

    const NumberTable& table_;
    std::size_t height_;
    std::optional<std::size_t> block_;
    std::array<std::vector<double>, 8> taken_;
};

}  // namespace skinfit
