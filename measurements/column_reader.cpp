#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/input_error.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/column_choice.hpp"
#include "measurements/columns.hpp"
#include "measurements/description.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"

namespace skinfit {
namespace {

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

/// Throws InputError where a value lacks its uncertainty.
void require_sigma(const Columns& columns, std::size_t column, const Readings& readings) {
    for (std::size_t i = 0; i < readings.value.size(); ++i) {
        if (std::isnan(readings.value[i]) || !std::isnan(readings.sigma[i])) continue;
        throw InputError({.where = at_line(columns, columns.rows[i].line),
                          .problem = fmt::format("{} is empty", label(columns, column)),
                          .why = "every value needs its uncertainty",
                          .remedy = "give it, or delete the column of uncertainties"});
    }
}

/// The column holds words or nothing: reading it without leave for gaps finds out which.
[[noreturn]] void refuse_without_numbers(const Columns& columns, std::size_t column) {
    (void)read_numbers(columns, std::array{column});
    std::abort();
}

}  // namespace

std::vector<Spectrum> read_columns(std::string_view text, const std::string& source, const ReadOptions& options) {
    const Columns columns = split_columns(text, source);
    const Description description = read_description(columns);
    const std::vector<ColumnChoice> choices =
        options.column ? std::vector{choose_column(columns, options.column)} : all_columns(columns);

    const std::vector<double> wavelengths = read_numbers(columns, std::array<std::size_t, 1>{0}).front();
    const Grid grid = make_grid(wavelengths, [&columns](std::size_t i) {
        const std::size_t line = columns.rows[i].line;
        return GridPlace{.where = at_line(columns, line), .which = fmt::format("line {}", line)};
    });

    std::vector<std::size_t> wanted;
    for (const ColumnChoice& choice : choices) {
        wanted.push_back(choice.value);
        if (choice.sigma) wanted.push_back(*choice.sigma);
    }
    const std::vector<std::vector<double>> numbers = read_numbers_with_gaps(columns, wanted);
    std::vector<Spectrum> spectra;
    auto next = numbers.begin();
    for (const ColumnChoice& choice : choices) {
        Readings readings{.value = *next++};
        if (choice.sigma) readings.sigma = *next++;
        if (readings.value.empty()) continue;
        if (choice.sigma && readings.sigma.empty()) refuse_without_numbers(columns, *choice.sigma);
        if (choice.sigma) require_sigma(columns, *choice.sigma, readings);
        const std::string header =
            columns.names.empty() ? "" : columns.names.front() + " " + columns.names[choice.value];
        spectra.push_back(described(columns, choice, choices.size(), description));
        take_readings(spectra.back(), grid, readings,
                      {.option = options.unit, .comment = description.unit, .header = header});
    }
    if (spectra.empty()) refuse_without_numbers(columns, choices.front().value);
    return spectra;
}

}  // namespace skinfit
