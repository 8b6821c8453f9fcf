#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>

#include "core/input_error.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/column_choice.hpp"
#include "measurements/columns.hpp"
#include "measurements/description.hpp"
#include "measurements/header.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"

namespace skinfit {
namespace {

/// What the comments say, and as notes what the preamble does.
Description described_by(const Columns& columns) {
    Description description = read_description(columns.source, columns.comments);
    const std::vector<FileNote> notes = notes_in(columns.preamble);
    description.notes.insert(description.notes.end(), notes.begin(), notes.end());
    return description;
}

/// One spectrum of `count`: what its column says, after what the comments say about all of them.
Spectrum described(const Columns& columns, const ColumnChoice& choice, std::size_t count,
                   const Description& description) {
    Spectrum spectrum = spectrum_of(description);
    spectrum.source = columns.source;
    spectrum.line = columns.header_line;
    if (choice.sigma) {
        spectrum.sigma_source = description.sigma_source.empty() ? "given by the file" : description.sigma_source;
    }
    if (count > 1 || description.specimen.empty()) {
        spectrum.name =
            choice.sole ? std::filesystem::path(columns.source).stem().string() : label(columns, choice.value);
    }
    if (columns.names.empty()) return spectrum;
    if (const auto named = quantity_named(columns.names[choice.value])) spectrum.quantity = named;
    return spectrum;
}

/// A table's columns, taken out eight at a time: so many numbers share a cache line.
class ColumnStore {
public:
    explicit ColumnStore(const NumberTable& table) : table_(table), height_(table.cells.size() / table.width) {}
    [[nodiscard]] std::vector<double> column(std::size_t c) {
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

/// The columns to read: the wavelengths, then each choice's values and uncertainties.
std::vector<std::size_t> wanted_columns(const std::vector<ColumnChoice>& choices) {
    std::vector<std::size_t> wanted{0};
    for (const ColumnChoice& choice : choices) {
        wanted.push_back(choice.value);
        if (choice.sigma) wanted.push_back(*choice.sigma);
    }
    return wanted;
}

/// Throws InputError for the first cell of these columns that is no number.
void require_numbers(const Columns& columns, std::span<const std::size_t> wanted) {
    (void)read_numbers(columns, wanted);
}

}  // namespace

std::vector<Spectrum> read_columns(std::string_view text, const std::string& source, const ReadOptions& options) {
    const Columns columns = split_columns(text, source);
    const Description description = described_by(columns);
    const std::vector<ColumnChoice> choices =
        options.column ? std::vector{choose_column(columns, options.column)} : all_columns(columns);
    const std::vector<std::size_t> wanted = wanted_columns(choices);
    const NumberTable table = read_number_table(columns, wanted);
    ColumnStore store(table);
    std::vector<double> wavelengths = store.column(0);
    for (double& wavelength : wavelengths) wavelength *= nanometres_per_unit(columns);
    if (std::ranges::any_of(wavelengths, [](double nm) { return std::isnan(nm); })) {
        require_numbers(columns, std::array<std::size_t, 1>{0});
    }
    const Grid grid = make_grid(wavelengths, [&columns](std::size_t i) {
        const std::size_t line = columns.rows[i].line;
        return GridPlace{.where = at_line(columns, line), .which = fmt::format("line {}", line)};
    });

    std::vector<Spectrum> spectra;
    std::size_t next = 1;
    for (const ColumnChoice& choice : choices) {
        const std::size_t at = next;
        next += choice.sigma ? 2 : 1;
        if (table.holds_words[at]) continue;
        if (choice.sigma && table.holds_words[at + 1]) require_numbers(columns, std::array{*choice.sigma});
        const std::vector<double> value = store.column(at);
        const std::vector<double> sigma = choice.sigma ? store.column(at + 1) : std::vector<double>{};
        const Readings readings{.value = value, .sigma = sigma};
        const std::string header =
            columns.names.empty() ? "" : columns.names.front() + " " + columns.names[choice.value];
        spectra.push_back(described(columns, choice, choices.size(), description));
        take_readings(
            spectra.back(), grid, readings,
            {.option = options.unit, .comment = description.unit, .header = header, .window = options.window});
    }
    if (spectra.empty()) require_numbers(columns, std::array{choices.front().value});
    return spectra;
}

}  // namespace skinfit
