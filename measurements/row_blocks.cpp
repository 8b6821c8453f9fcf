#include "measurements/row_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/geometry.hpp"
#include "measurements/cells.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

void take_block(std::vector<ValueBlock>& blocks, const RowHeader& header, const RowBlock& cells,
                const std::string& source, FileStatements& statements) {
    ValueBlock block{.cells = cells};
    const std::vector<double> all = header.wavelength_nm(cells);
    const auto inside = std::ranges::count_if(all, [](double nm) { return wavelength_range_nm.contains(nm); });
    std::vector<double> nm;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (inside > 0 && !wavelength_range_nm.contains(all[i])) continue;
        block.used.push_back(i);
        nm.push_back(all[i]);
    }
    if (nm.size() < all.size()) {
        statements.remarks.push_back(fmt::format("{} readings outside {} to {} nm are left out", all.size() - nm.size(),
                                                 wavelength_range_nm.lowest, wavelength_range_nm.highest));
    }
    block.grid = make_grid(nm, [&](std::size_t i) {
        return GridPlace{.where = fmt::format("{}:{}", source, header.line),
                         .which = fmt::format("value {}", block.used[i] + 1)};
    });
    block.states = values_stated_by_letter(cells.about == "a" ? "A" : cells.about);  // `a400` is no name
    if (block.states.is_empty()) block.states = values_stated_wholly(header.labels.front());
    block.specular = specular_stated(cells.about);
    if (!blocks.empty()) block.uncertainty = uncertainty_named(cells.about);
    if (block.uncertainty) {
        for (std::size_t k = 0; k < blocks.size(); ++k) {
            const bool is_named = plain_base(blocks[k].cells.about) == block.uncertainty->base;
            if (!blocks[k].uncertainty && (is_named || blocks[block.owner].uncertainty)) block.owner = k;
        }
        if (blocks[block.owner].cells.numbers != cells.numbers) block.uncertainty->is_standard = false;
    }
    blocks.push_back(std::move(block));
}

}  // namespace

bool has_decimal_commas(const RowHeader& header, std::span<const Row> rows) {
    if (header.separator == ',' || header.separator == ' ') return false;
    CellCutter cutter(header.separator);
    return std::ranges::any_of(rows, [&](const Row& row) {
        if (!contains(row.text, ",")) return false;
        const std::span<const std::string_view> cells = cutter.cut(row.text);
        return std::ranges::any_of(header.blocks, [&](const RowBlock& block) {
            const std::size_t first = std::min(block.first_value, cells.size());
            const std::size_t count = std::min(block.numbers.size(), cells.size() - first);
            return std::ranges::any_of(cells.subspan(first, count),
                                       [](std::string_view cell) { return contains(cell, ","); });
        });
    });
}

std::vector<ValueBlock> value_blocks(RowHeader header, const std::string& source, FileStatements& statements) {
    if (!header.abscissa) header.abscissa = statements.abscissa;
    if (header.abscissa) {
        refuse_unusable(*header.abscissa, fmt::format("{}:{}", source, header.line));
        if (!header.abscissa->is_nm()) {
            const std::vector<double>& numbers = header.blocks.front().numbers;
            statements.remarks.push_back(fmt::format("{} to {} {} are read as wavelengths in vacuum", numbers.front(),
                                                     numbers.back(), header.abscissa->name));
        }
    }
    std::vector<ValueBlock> blocks;
    for (const RowBlock& cells : header.blocks) take_block(blocks, header, cells, source, statements);
    for (const ValueBlock& block : blocks) {
        if (!block.uncertainty || block.uncertainty->is_standard) continue;
        statements.remarks.push_back(
            fmt::format("left out: {} (it is no standard uncertainty in the unit of the "
                        "values)",
                        in_quotes(block.cells.about)));
    }
    return blocks;
}

void take_out_zero_bands(std::vector<ReadRow>& rows, const std::vector<ValueBlock>& blocks) {
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        std::vector<ReadRow*> of_block;
        for (ReadRow& row : rows) {
            if (row.block == b) of_block.push_back(&row);
        }
        std::vector<std::size_t> zeros;
        for (std::size_t i = 0; i < blocks[b].used.size() && of_block.size() > 1; ++i) {
            if (std::ranges::all_of(of_block, [i](const ReadRow* row) { return row->values[i] == 0; })) {
                zeros.push_back(i);
            }
        }
        if (zeros.empty() || zeros.size() == blocks[b].used.size()) continue;
        for (ReadRow* row : of_block) {
            for (const std::size_t i : zeros) row->values[i] = std::numeric_limits<double>::quiet_NaN();
            row->spectrum.remarks.push_back(
                fmt::format("{} readings that are 0 in every spectrum stand for missing values", zeros.size()));
        }
    }
}

}  // namespace skinfit
