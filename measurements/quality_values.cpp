#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>

#include "core/geometry.hpp"
#include "measurements/quality_checks.hpp"
#include "measurements/reading_noise.hpp"
#include "measurements/unit_rule.hpp"

/// The checks on the values themselves.
namespace skinfit {
namespace {

bool is_reflectance(const Spectrum& spectrum) {
    return spectrum.quantity.value_or(Quantity::reflectance) == Quantity::reflectance;
}

/// The place of the smallest value.
std::size_t darkest(const Spectrum& spectrum) {
    return static_cast<std::size_t>(std::ranges::min_element(spectrum.value) - spectrum.value.begin());
}

std::size_t brightest(const Spectrum& spectrum) {
    return static_cast<std::size_t>(std::ranges::max_element(spectrum.value) - spectrum.value.begin());
}

}  // namespace

std::optional<Finding> unit_conflict(const Spectrum& spectrum) {
    const double largest = spectrum.value[brightest(spectrum)];
    if (spectrum.unit_rule.starts_with("percent") && largest * 100 <= largest_fraction) {
        return Finding{.name = "unit_conflict",
                       .spectrum = spectrum.name,
                       .message = fmt::format("read as percent, no value exceeds {:.3g} percent ({})", largest * 100,
                                              spectrum.unit_rule),
                       .remedy = "if these are fractions, say so with --unit fraction"};
    }
    const auto above = std::ranges::count_if(spectrum.value, [](double value) { return value > largest_fraction; });
    if (2 * static_cast<std::size_t>(above) >= spectrum.value.size() && spectrum.unit_rule.starts_with("percent")) {
        return Finding{.name = "unit_conflict",
                       .spectrum = spectrum.name,
                       .message = fmt::format("read as percent, {} of {} values exceed {:g} ({})", above,
                                              spectrum.value.size(), 100 * largest_fraction, spectrum.unit_rule),
                       .remedy = "if these are counts, divide them by those of the white reference"};
    }
    if (2 * static_cast<std::size_t>(above) >= spectrum.value.size()) {
        return Finding{.name = "unit_conflict",
                       .spectrum = spectrum.name,
                       .message = fmt::format("read as fractions, {} of {} values exceed {} ({})", above,
                                              spectrum.value.size(), largest_fraction, spectrum.unit_rule),
                       .remedy = "if these are percent, say so with --unit percent"};
    }
    return std::nullopt;
}

std::optional<Finding> outside_0_1(const Spectrum& spectrum) {
    const auto outside = std::ranges::count_if(spectrum.value, [](double value) { return value < 0 || value > 1; });
    if (outside == 0) return std::nullopt;
    const std::size_t lowest = darkest(spectrum);
    const std::size_t highest = brightest(spectrum);
    const bool is_negative = spectrum.value[lowest] < 0;
    const std::size_t worst = is_negative ? lowest : highest;
    return Finding{.name = "outside_0_1",
                   .spectrum = spectrum.name,
                   .message = fmt::format("{} of {} values lie outside 0 to 1, as {:.4g} at {:g} nm does", outside,
                                          spectrum.value.size(), spectrum.value[worst], spectrum.wavelength_nm[worst]),
                   .remedy = is_negative ? "correct the dark reading of the instrument, or leave those readings out"
                                         : "correct the white standard or the unit, or leave those readings out"};
}

std::optional<Finding> offset(const Spectrum& spectrum) {
    constexpr double surface_of_skin = 0.017;
    constexpr double sigmas = 4;
    if (!is_reflectance(spectrum) || spectrum.geometry.specular == Specular::excluded ||
        spectrum.geometry.viewing_cone_deg) {
        return std::nullopt;
    }
    const std::size_t lowest = darkest(spectrum);
    if (spectrum.value[lowest] + sigmas * reading_noise(spectrum) >= surface_of_skin) return std::nullopt;
    return Finding{
        .name = "offset",
        .spectrum = spectrum.name,
        .message = fmt::format("{:.4g} at {:g} nm is less than the {:g} that the surface of skin alone reflects",
                               spectrum.value[lowest], spectrum.wavelength_nm[lowest], surface_of_skin),
        .remedy =
            "correct the dark reading of the instrument, or state specular=excluded or quantity=transmittance if "
            "that is what was measured"};
}

std::optional<Finding> dark_everywhere(const Spectrum& spectrum) {
    constexpr double darkest_skin = 0.09;
    constexpr double bright_from_nm = 650;
    const std::size_t highest = brightest(spectrum);
    if (!is_reflectance(spectrum) || spectrum.wavelength_nm.back() < bright_from_nm ||
        spectrum.value[highest] >= darkest_skin) {
        return std::nullopt;
    }
    return Finding{.name = "dark_everywhere",
                   .spectrum = spectrum.name,
                   .message = fmt::format("nowhere above {:.3g}, which it reaches at {:g} nm; skin exceeds {:g}",
                                          spectrum.value[highest], spectrum.wavelength_nm[highest], darkest_skin),
                   .remedy = "check the white standard, the contact with the skin and that the lamp was on"};
}

std::optional<Finding> as_read(const Spectrum& spectrum) {
    if (spectrum.remarks.empty()) return std::nullopt;
    return Finding{.name = "as_read",
                   .severity = Severity::note,
                   .spectrum = spectrum.name,
                   .message = fmt::format("{}", fmt::join(spectrum.remarks, "; ")),
                   .remedy = "none is needed where that is right; else correct the file, or state it in comments"};
}

std::optional<Finding> missing_values(const Spectrum& spectrum) {
    constexpr std::size_t many = 10;  // one in so many
    const std::size_t missing = spectrum.missing_nm.size();
    if (missing == 0) return std::nullopt;
    const std::size_t all = missing + spectrum.wavelength_nm.size();
    const bool is_minor = many * missing <= all;
    return Finding{.name = "missing_values",
                   .severity = is_minor ? Severity::note : Severity::warning,
                   .spectrum = spectrum.name,
                   .message = fmt::format("{} of {} wavelengths have no value", missing, all),
                   .remedy = is_minor ? "none is needed: a fit uses what there is"
                                      : "measure again, or make sure that the others suffice"};
}

std::optional<Finding> unusable_uncertainty(const Spectrum& spectrum) {
    const auto is_unusable = [](double sigma) { return !sigma_range.contains(sigma); };
    const auto first = std::ranges::find_if(spectrum.sigma, is_unusable);
    if (first == spectrum.sigma.end()) return std::nullopt;
    const auto at = static_cast<std::size_t>(first - spectrum.sigma.begin());
    return Finding{
        .name = "unusable_uncertainty",
        .spectrum = spectrum.name,
        .message = fmt::format("{} of {} uncertainties are missing or not from {:g} to {:g}, as {:g} at {:g} "
                               "nm",
                               std::ranges::count_if(spectrum.sigma, is_unusable), spectrum.sigma.size(),
                               sigma_range.lowest, sigma_range.highest, *first, spectrum.wavelength_nm[at]),
        .remedy = "correct them, or delete their column and state noise=..."};
}

std::optional<Finding> repeated_wavelengths(const Spectrum& spectrum) {
    const auto twin = std::ranges::adjacent_find(spectrum.wavelength_nm);
    if (twin == spectrum.wavelength_nm.end()) return std::nullopt;
    std::size_t count = 0;
    for (std::size_t i = 1; i < spectrum.wavelength_nm.size(); ++i) {
        if (spectrum.wavelength_nm[i] == spectrum.wavelength_nm[i - 1]) ++count;
    }
    return Finding{.name = "repeated_wavelengths",
                   .spectrum = spectrum.name,
                   .message = fmt::format("{} {} given again, the first {:g} nm", count,
                                          count == 1 ? "wavelength is" : "wavelengths are", *twin),
                   .remedy = "keep one of the two or average them"};
}

std::optional<Finding> outside_tables(const Spectrum& spectrum, const ModelledRange& modelled) {
    const auto inside = std::ranges::count_if(spectrum.wavelength_nm, [&](double wavelength_nm) {
        return wavelength_nm >= modelled.lowest_nm && wavelength_nm <= modelled.highest_nm;
    });
    const auto outside = spectrum.wavelength_nm.size() - static_cast<std::size_t>(inside);
    if (outside == 0) return std::nullopt;
    return Finding{
        .name = "outside_tables",
        .severity = inside > 0 ? Severity::note : Severity::warning,
        .spectrum = spectrum.name,
        .message = fmt::format("{} of the {} wavelengths from {:g} to {:g} nm lie outside the model's tables, {:g} "
                               "to {:g} nm",
                               outside, spectrum.wavelength_nm.size(), spectrum.wavelength_nm.front(),
                               spectrum.wavelength_nm.back(), modelled.lowest_nm, modelled.highest_nm),
        .remedy = inside > 0 ? "none is needed: a fit leaves them out"
                             : "measure within the tables, and check that wavelengths are in nm"};
}

std::optional<Finding> doubtful_file(const Spectrum& spectrum) {
    if (spectrum.doubts.empty()) return std::nullopt;
    std::string message;
    std::string remedy;
    for (const FileDoubt& doubt : spectrum.doubts) {
        message += (message.empty() ? "" : "; ") + doubt.message;
        if (remedy.find(doubt.remedy) == std::string::npos) remedy += (remedy.empty() ? "" : "; ") + doubt.remedy;
    }
    return Finding{.name = "doubtful_file", .spectrum = spectrum.name, .message = message, .remedy = remedy};
}

}  // namespace skinfit
