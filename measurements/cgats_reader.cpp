#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/text.hpp"
#include "measurements/cell_numbers.hpp"
#include "measurements/cgats_bands.hpp"
#include "measurements/cgats_statements.hpp"
#include "measurements/cgats_table.hpp"
#include "measurements/left_out.hpp"
#include "measurements/limits.hpp"
#include "measurements/readers.hpp"
#include "measurements/spectrum_building.hpp"
#include "measurements/uncertainty_name.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// One spectrum before the unit of its table is known.
struct RawSet {
    Spectrum spectrum;
    Grid grid;
    std::vector<double> readings;
    std::vector<double> sigma{};  ///< one per reading; empty where the file gives none
};

/// The number of a cell; NaN where it is missing.
double number_in(const CgatsToken& cell, std::string_view field, bool decimal_comma, const std::string& source) {
    if (is_missing(cell.text)) return std::numeric_limits<double>::quiet_NaN();
    const std::optional<double> number = parse_cell(cell.text, decimal_comma);
    if (!number || !std::isfinite(*number)) {
        refuse_cgats(source, cell.line, fmt::format("holds {} as {}", in_quotes(cell.text), field),
                     "a number is needed", "correct the value, or write 0 for one that is missing");
    }
    return *number;
}

/// The reading of a perfect white where the table states it and it can be used; else 0.
double norm_of(const CgatsTable& table) {
    const double norm = table.number("SPECTRAL_NORM").value_or(0.0);
    return norm > 0 && std::isfinite(norm) ? norm : 0;
}

/// NaN stands for values that are missing: 0 does that too, since no surface reflects nothing.
void take_out_missing(RawSet& raw, double norm) {
    const double largest = largest_fraction * std::max(norm, 100.0);
    std::optional<double> fill;
    for (double& value : raw.readings) {
        const bool fills = is_fill_number(value) && (value < 0 || value > largest);
        if (fills && !fill) fill = value;
        if (fills || value == 0) value = std::numeric_limits<double>::quiet_NaN();
    }
    if (fill) raw.spectrum.remarks.push_back(fmt::format("readings of {} stand for missing values", *fill));
}

/// Throws InputError where the sets are not as many and as long as they are said to be.
void check_sets(const CgatsTable& table, const std::string& source) {
    const std::size_t width = table.fields.size();
    const std::size_t sets = table.cells.size() / width;
    if (table.cells.size() % width != 0) {
        const bool longer = table.words_of_uneven > width;
        refuse_cgats(source, table.uneven->line,
                     fmt::format("has {} words for {} fields", table.words_of_uneven, width),
                     "every set has a value for each field",
                     longer ? "put names with blanks in quotes" : "check that the file is complete");
    }
    const std::optional<double> promised = table.number("NUMBER_OF_SETS");
    if (!promised || *promised == static_cast<double>(sets)) return;
    refuse_cgats(source, 0, fmt::format("holds {} sets", sets), fmt::format("NUMBER_OF_SETS promises {}", *promised));
}

bool has_decimal_commas(const CgatsTable& table, const CgatsBands& bands) {
    const std::size_t width = table.fields.size();
    for (std::size_t set = 0; set < table.cells.size(); set += width) {
        for (const std::size_t i : bands.field) {
            if (table.cells[set + i].text.find(',') != std::string_view::npos) return true;
        }
    }
    return false;
}

/// The uncertainties of the readings, from the fields `of` at the same wavelengths; empty where none is above 0.
std::vector<double> sigma_of(const CgatsTable& table, const CgatsBands& bands, const CgatsBands& of,
                             std::span<const CgatsToken> cells, bool decimal_comma, const std::string& source) {
    std::vector<double> sigma(bands.field.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < of.field.size(); ++i) {
        const auto same = std::ranges::find(bands.wavelength_nm, of.wavelength_nm[i]);
        if (same == bands.wavelength_nm.end()) continue;
        const double number = number_in(cells[of.field[i]], table.fields[of.field[i]].text, decimal_comma, source);
        if (!is_fill_number(number)) sigma[static_cast<std::size_t>(same - bands.wavelength_nm.begin())] = number;
    }
    const bool states_some = std::ranges::any_of(sigma, [](double each) { return each > 0; });
    return states_some ? sigma : std::vector<double>{};
}

/// The fields of one spectrum of each set, and those of its uncertainty; null where there are none.
struct SpectrumFields {
    const CgatsBands& values;
    const CgatsBands* uncertainties;
};

RawSet raw_set(const CgatsTable& table, const SpectrumFields& fields, std::size_t set, bool decimal_comma,
               const std::string& source) {
    const CgatsBands& bands = fields.values;
    const std::size_t width = table.fields.size();
    const std::span<const CgatsToken> cells = std::span(table.cells).subspan(set * width, width);
    RawSet raw;
    std::vector<double> wavelength_nm = bands.wavelength_nm;
    for (const std::size_t i : bands.wavelength_field) {
        const std::optional<double> nm = parse_cell(cells[i].text, decimal_comma);
        if (!nm) {
            refuse_cgats(source, cells[i].line, fmt::format("holds {} as a wavelength", in_quotes(cells[i].text)),
                         "a number is needed", "correct it");
        }
        wavelength_nm.push_back(*nm);
    }
    raw.grid = make_grid(wavelength_nm, [&](std::size_t i) {
        const CgatsToken& field =
            bands.wavelength_field.empty() ? table.fields[bands.field[i]] : cells[bands.wavelength_field[i]];
        return GridPlace{.where = fmt::format("{}:{}", source, field.line), .which = std::string(field.text)};
    });
    for (const std::size_t i : bands.field) {
        raw.readings.push_back(number_in(cells[i], table.fields[i].text, decimal_comma, source));
    }
    raw.spectrum = cgats_statements(table, bands, cells);
    raw.spectrum.source = source;
    if (raw.spectrum.name.empty()) raw.spectrum.name = fmt::format("set {}", set + 1);
    take_out_missing(raw, norm_of(table));
    if (fields.uncertainties == nullptr) return raw;
    raw.sigma = sigma_of(table, bands, *fields.uncertainties, cells, decimal_comma, source);
    if (!raw.sigma.empty()) {
        raw.spectrum.sigma_source =
            fmt::format("fields {} of the file", in_quotes(table.fields[fields.uncertainties->field.front()].text));
    }
    return raw;
}

/// The readings in the window of all sets; all readings where it has none.
std::vector<double> used_readings(const std::vector<RawSet>& sets, const WavelengthWindow& window) {
    std::vector<double> wavelength_nm;
    std::vector<double> readings;
    for (const RawSet& set : sets) {
        for (std::size_t i = 0; i < set.grid.order.size(); ++i) {
            wavelength_nm.push_back(set.grid.wavelength_nm[i]);
            readings.push_back(set.readings[set.grid.order[i]]);
        }
    }
    return used_values(window, wavelength_nm, readings);
}

/// What one reading in the file stands for: by the option, by the names of the fields, by SPECTRAL_NORM, which is the
/// reading of a perfect white, else by the rule for files that state nothing.
UnitFinding unit_of(const CgatsTable& table, const CgatsBands& bands, std::vector<RawSet>& sets,
                    const ReadOptions& options, const std::string& source) {
    const std::optional<Unit>& option = options.unit;
    const auto keyword = table.keywords.find("SPECTRAL_NORM");
    const bool has_norm = keyword != table.keywords.end();
    const double norm = norm_of(table);
    if (has_norm && norm == 0) {
        refuse_cgats(source, keyword->second.line, fmt::format("SPECTRAL_NORM is {}", in_quotes(keyword->second.value)),
                     "it is the reading of a perfect white, above 0", "correct it, or delete it");
    }
    if (!option && bands.unit) {
        return {.unit = *bands.unit,
                .rule = fmt::format("{}: stated by the names of the fields",
                                    unit_names[static_cast<std::size_t>(*bands.unit)])};
    }
    if (!option && has_norm) {
        const bool percent = norm == 100;
        if (norm == 1 || percent) {
            return {.unit = percent ? Unit::percent : Unit::fraction,
                    .rule = fmt::format("{}: stated by SPECTRAL_NORM", percent ? "percent" : "fraction")};
        }
        for (RawSet& set : sets) {
            for (double& value : set.readings) value /= norm;
            for (double& value : set.sigma) value /= norm;
        }
        return {.unit = Unit::fraction, .rule = fmt::format("fraction: after division by SPECTRAL_NORM {:g}", norm)};
    }
    return find_unit({.option = option, .comment = std::nullopt, .header = {}}, used_readings(sets, options.window));
}

void take_spectra(const CgatsTable& table, const SpectrumFields& fields, bool several, const std::string& source,
                  const ReadOptions& options, std::vector<Spectrum>& spectra, LeftOut& left_out) {
    const CgatsBands& bands = fields.values;
    const bool decimal_comma = has_decimal_commas(table, bands);
    std::vector<RawSet> sets;
    for (std::size_t set = 0; set < table.cells.size() / table.fields.size(); ++set) {
        left_out.or_keep_error([&] {
            RawSet raw = raw_set(table, fields, set, decimal_comma, source);
            if (several) raw.spectrum.name += " " + bands.prefix;
            const bool has_value = std::ranges::any_of(raw.readings, [](double value) { return !std::isnan(value); });
            if (has_value) sets.push_back(std::move(raw));
        });
    }
    if (sets.empty()) return;
    const UnitFinding unit = unit_of(table, bands, sets, options, source);
    for (RawSet& set : sets) {
        take_readings(set.spectrum, set.grid, {.value = set.readings, .sigma = set.sigma}, unit);
        spectra.push_back(std::move(set.spectrum));
    }
}

/// The uncertainties of `values` among `all`: those that name them, else those that name none where no other spectrum
/// is there. Of several the lowest rank counts.
const CgatsBands* uncertainties_of(const CgatsBands& values, std::span<const CgatsBands> all) {
    const auto spectra = std::ranges::count_if(all, [](const CgatsBands& each) { return !each.uncertainty; });
    const CgatsBands* best = nullptr;
    for (const CgatsBands& each : all) {
        if (!each.uncertainty || !each.uncertainty->is_standard) continue;
        const bool is_its =
            each.uncertainty->base == plain_base(values.prefix) || (each.uncertainty->base.empty() && spectra == 1);
        if (is_its && (best == nullptr || each.uncertainty->rank < best->uncertainty->rank)) best = &each;
    }
    return best;
}

/// The names of all fields, for messages.
std::string fields_in(const std::vector<CgatsTable>& tables) {
    std::vector<std::string_view> names;
    constexpr std::size_t most = 12;
    std::size_t count = 0;
    for (const CgatsTable& table : tables) {
        for (const CgatsToken& field : table.fields) {
            if (++count <= most) names.push_back(field.text);
        }
    }
    return fmt::format("{}{}", fmt::join(names, ", "), count > most ? fmt::format(" and {} more", count - most) : "");
}

}  // namespace

bool holds_cgats(std::string_view text) {
    LineReader reader(text);
    while (const auto line = reader.next()) {
        const std::string_view content = trimmed(*line);
        if (content == "BEGIN_DATA_FORMAT") return true;
        if (starts_like_a_number(content)) return false;
    }
    return false;
}

std::vector<Spectrum> read_cgats(std::string_view text, const std::string& source, const ReadOptions& options) {
    refuse_large_text(text, source);
    const std::vector<CgatsTable> tables = cgats_tables(text, source);
    std::vector<Spectrum> spectra;
    LeftOut left_out;
    for (const CgatsTable& table : tables) {
        const std::vector<CgatsBands> all = cgats_bands(table);
        const auto several = std::ranges::count_if(all, [](const CgatsBands& each) { return !each.uncertainty; }) > 1;
        if (all.empty() || table.cells.empty()) continue;
        left_out.or_keep_error([&] {
            refuse_other_quantities(table, source);
            check_sets(table, source);
            for (const CgatsBands& bands : all) {
                if (bands.uncertainty) continue;
                take_spectra(table, {.values = bands, .uncertainties = uncertainties_of(bands, all)}, several, source,
                             options, spectra, left_out);
            }
        });
    }
    left_out.tell(spectra);
    if (spectra.empty()) {
        refuse_cgats(source, 0, "holds no spectra",
                     fmt::format("no table has fields such as SPEC_360, or pairs of SPECTRAL_NM and SPECTRAL_PCT, with "
                                 "numbers in them; it has {}",
                                 fields_in(tables)),
                     "export the measurement with its spectral values");
    }
    return spectra;
}

}  // namespace skinfit
