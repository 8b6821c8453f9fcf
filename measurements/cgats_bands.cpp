#include "measurements/cgats_bands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/text.hpp"
#include "measurements/value_statement.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

/// A prefix of fields of spectra.
struct Prefix {
    std::string_view name;
    bool is_sure;  ///< else fields count only where they end in a possible wavelength, as `R_1` does not
    std::optional<Unit> unit{};
    std::optional<Quantity> quantity{};
};

constexpr std::array<Prefix, 18> prefixes{{
    {.name = "spec", .is_sure = true},
    {.name = "spectral", .is_sure = true},
    {.name = "spectrum", .is_sure = true},
    {.name = "spectral_nm", .is_sure = true},
    {.name = "spec_nm", .is_sure = true},
    {.name = "nm", .is_sure = true},
    {.name = "spectral_pct", .is_sure = true, .unit = Unit::percent},
    {.name = "spec_pct", .is_sure = true, .unit = Unit::percent},
    {.name = "pct", .is_sure = false, .unit = Unit::percent},
    {.name = "spectral_dec", .is_sure = true, .unit = Unit::fraction},
    {.name = "spec_dec", .is_sure = true, .unit = Unit::fraction},
    {.name = "dec", .is_sure = false, .unit = Unit::fraction},
    {.name = "wavelength", .is_sure = false},
    {.name = "lambda", .is_sure = false},
    {.name = "", .is_sure = false},
    {.name = "r", .is_sure = false, .quantity = Quantity::reflectance},
    {.name = "t", .is_sure = false, .quantity = Quantity::transmittance},
    {.name = "s", .is_sure = false},
}};

/// A field's name taken apart.
struct BandName {
    std::string prefix;
    double nm;
    std::optional<Unit> unit{};
    std::optional<Quantity> quantity{};
    std::optional<UncertaintyName> uncertainty{};
};

std::string_view without_links(std::string_view text) {
    const std::size_t first = text.find_first_not_of("_ -");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of("_ -") - first + 1);
}

std::optional<BandName> band_named(std::string_view field) {
    const std::string name = lower_case(field);
    const std::size_t begin = name.find_first_of("0123456789");
    if (begin == std::string::npos) return std::nullopt;
    const std::size_t end = std::min(name.find_first_not_of("0123456789.", begin), name.size());
    const std::optional<double> nm = parse_number(std::string_view(name).substr(begin, end - begin));
    const std::string_view behind = without_links(std::string_view(name).substr(end));
    if (!nm || !(behind.empty() || behind == "nm")) return std::nullopt;
    const std::string_view front = without_links(std::string_view(name).substr(0, begin));
    const bool possible = wavelength_range_nm.contains(*nm);
    const auto known = std::ranges::find(prefixes, front, &Prefix::name);
    if (known != prefixes.end()) {
        if (!known->is_sure && !possible) return std::nullopt;
        return BandName{.prefix = std::string(front), .nm = *nm, .unit = known->unit, .quantity = known->quantity};
    }
    if (!possible || front.empty()) return std::nullopt;
    if (const auto uncertainty = uncertainty_named(front); uncertainty && front != "std") {  // STD is a standard
        return BandName{.prefix = std::string(front), .nm = *nm, .uncertainty = uncertainty};
    }
    // Words such as SCI, reflectance or spectral_transmittance.
    const std::optional<Quantity> quantity = values_stated(front).quantity;
    const std::string_view written = without_links(field.substr(0, begin));
    if (!quantity && !specular_stated(written)) return std::nullopt;
    return BandName{.prefix = std::string(front), .nm = *nm, .quantity = quantity};
}

/// Takes the exact wavelengths, or says that names and keywords differ.
void take_stated_range(const CgatsTable& table, CgatsBands& bands) {
    const std::optional<double> start = table.number("SPECTRAL_START_NM");
    const std::optional<double> end = table.number("SPECTRAL_END_NM");
    const std::optional<double> number = table.number("SPECTRAL_BANDS");
    const std::size_t count = bands.field.size();
    if (!start || !end || count < 2) return;
    std::vector<double> exact;
    bool agrees = number.value_or(static_cast<double>(count)) == static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count - 1);
        exact.push_back(*start + (*end - *start) * share);
        agrees = agrees && std::abs(exact[i] - bands.wavelength_nm[i]) <= 0.5;  // as names are rounded
    }
    if (agrees) {
        if (number) bands.wavelength_nm = exact;
        return;
    }
    bands.doubts.push_back(
        {.message = fmt::format("{} fields are named from {:g} to {:g} nm; SPECTRAL_BANDS, SPECTRAL_START_NM and "
                                "SPECTRAL_END_NM say {}, {:g} and {:g}; the names are taken",
                                count, bands.wavelength_nm.front(), bands.wavelength_nm.back(),
                                number ? fmt::format("{:g}", *number) : "nothing", *start, *end),
         .remedy = "correct the keywords or the names of the fields"});
}

std::vector<CgatsBands> pairs_in(const CgatsTable& table) {
    static constexpr std::array<std::string_view, 4> of_wavelength = {"spectral_nm", "spec_nm", "nm", "wavelength"};
    CgatsBands bands{.prefix = "spectral_nm", .field = {}, .wavelength_nm = {}, .wavelength_field = {}};
    for (std::size_t i = 0; i + 1 < table.fields.size(); ++i) {
        const std::string name = lower_case(table.fields[i].text);
        if (std::ranges::find(of_wavelength, name) == of_wavelength.end()) continue;
        const std::string value = lower_case(table.fields[i + 1].text);
        const bool percent = value.ends_with("_pct") || value == "pct";
        const bool fraction = value.ends_with("_dec") || value == "dec";
        if (!percent && !fraction) continue;
        bands.unit = percent ? Unit::percent : Unit::fraction;
        bands.wavelength_field.push_back(i);
        bands.field.push_back(i + 1);
    }
    if (bands.field.empty()) return {};
    return {std::move(bands)};
}

}  // namespace

std::vector<CgatsBands> cgats_bands(const CgatsTable& table) {
    std::vector<CgatsBands> all = pairs_in(table);
    if (!all.empty()) return all;
    for (std::size_t i = 0; i < table.fields.size(); ++i) {
        const std::optional<BandName> band = band_named(table.fields[i].text);
        if (!band) continue;
        auto bands = std::ranges::find(all, band->prefix, &CgatsBands::prefix);
        if (bands == all.end()) {
            all.push_back({.prefix = band->prefix,
                           .field = {},
                           .wavelength_nm = {},
                           .wavelength_field = {},
                           .unit = band->unit,
                           .quantity = band->quantity,
                           .uncertainty = band->uncertainty});
            bands = std::prev(all.end());
        }
        bands->field.push_back(i);
        bands->wavelength_nm.push_back(band->nm);
    }
    // Of several, those by which a single field happens to be called are none.
    constexpr std::size_t fewest = 3;
    if (all.size() > 1) std::erase_if(all, [](const CgatsBands& bands) { return bands.field.size() < fewest; });
    const auto of_values = [](const CgatsBands& bands) { return !bands.uncertainty; };
    if (std::ranges::count_if(all, of_values) == 1) take_stated_range(table, *std::ranges::find_if(all, of_values));
    return all;
}

}  // namespace skinfit
