#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>

#include "measurements/quality_checks.hpp"
#include "measurements/words.hpp"

/// The checks that compare spectra.
namespace skinfit {
namespace {

/// The mean over the wavelengths of the variance of the repeats' mean, by their scatter, per sigma squared.
double scatter_per_variance(const Spectrum& spectrum) {
    const auto count = static_cast<double>(spectrum.repeats.size());
    double ratio = 0;
    for (std::size_t i = 0; i < spectrum.sigma.size(); ++i) {
        double sum = 0;
        double squares = 0;
        for (const std::vector<double>& repeat : spectrum.repeats) {
            const double difference = repeat[i] - spectrum.value[i];
            sum += difference;
            squares += difference * difference;
        }
        const double variance = (squares - sum * sum / count) / (count - 1);
        ratio += variance / count / (spectrum.sigma[i] * spectrum.sigma[i]);
    }
    return ratio / static_cast<double>(spectrum.sigma.size());
}

/// The name without the word for the quantity, so that both measurements of a specimen have the same.
std::string specimen(const Spectrum& spectrum) {
    std::string name = lower_case(spectrum.name);
    for (const std::string_view word : quantity_names) {
        if (const std::size_t at = name.find(word); at != std::string::npos) name.erase(at, word.size());
    }
    std::erase_if(name, [](char c) { return std::string_view(" \t_-:,;()[]%").find(c) != std::string_view::npos; });
    return name;
}

/// Where the sum of two spectra is largest, among the wavelengths of the first that the second has too.
struct Sum {
    double wavelength_nm;
    double value;
};

std::optional<Sum> largest_sum(const Spectrum& a, const Spectrum& b) {
    std::optional<Sum> largest;
    for (std::size_t i = 0; i < a.wavelength_nm.size(); ++i) {
        const auto found = std::ranges::lower_bound(b.wavelength_nm, a.wavelength_nm[i]);
        if (found == b.wavelength_nm.end() || *found != a.wavelength_nm[i]) continue;
        const double sum = a.value[i] + b.value[static_cast<std::size_t>(found - b.wavelength_nm.begin())];
        if (!largest || sum > largest->value) largest = Sum{.wavelength_nm = a.wavelength_nm[i], .value = sum};
    }
    return largest;
}

}  // namespace

std::optional<Finding> noise_against_repeats(const Spectrum& spectrum) {
    constexpr double improbable = 1e-3;
    const bool is_stated = !spectrum.sigma.empty() &&
                           std::ranges::all_of(spectrum.sigma, [](double sigma) { return sigma > 0; }) &&
                           spectrum.sigma_source.find("repeats") == std::string::npos;
    if (spectrum.repeats.size() < 2 || !is_stated) return std::nullopt;
    const auto degrees_of_freedom = static_cast<double>(spectrum.repeats.size() - 1);
    const double ratio = scatter_per_variance(spectrum);
    if (!std::isfinite(ratio)) return std::nullopt;  // a repeat lacks a reading
    const boost::math::chi_squared_distribution<double> law(degrees_of_freedom);
    const double below = boost::math::cdf(law, ratio * degrees_of_freedom);
    if (std::min(below, 1 - below) >= improbable) return std::nullopt;
    return Finding{.name = "noise_against_repeats",
                   .spectrum = spectrum.name,
                   .message = fmt::format("the {} repeats scatter by {:.2g} of the stated uncertainty",
                                          spectrum.repeats.size(), std::sqrt(ratio)),
                   .remedy = "correct the uncertainty, or delete it so that it comes from the repeats"};
}

std::vector<Finding> duplicates(std::span<const Spectrum> spectra) {
    constexpr std::size_t fewest = 3;  // readings: fewer may agree by chance
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < spectra.size(); ++i) {
        if (spectra[i].value.size() >= fewest) order.push_back(i);
    }
    const auto readings = [&](std::size_t i) { return std::tie(spectra[i].value, spectra[i].wavelength_nm); };
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return readings(a) < readings(b); });
    std::map<std::size_t, std::size_t> twin;  // of each, in the order of the set
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (readings(order[i]) != readings(order[i - 1])) continue;
        twin.emplace(order[i - 1], order[i]);
        twin.emplace(order[i], order[i - 1]);
    }
    std::vector<Finding> findings;
    for (const auto& [one, other] : twin) {
        findings.push_back({.name = "duplicate",
                            .spectrum = spectra[one].name,
                            .message = fmt::format("has the same values as {}", spectra[other].name),
                            .remedy = "keep one of them, unless two specimens were measured: then one is misnamed"});
    }
    return findings;
}

std::vector<Finding> reflectance_plus_transmittance(std::span<const Spectrum> spectra) {
    constexpr double most = 1.02;
    std::multimap<std::string, const Spectrum*> transmittances;
    for (const Spectrum& spectrum : spectra) {
        if (spectrum.quantity == Quantity::transmittance) transmittances.emplace(specimen(spectrum), &spectrum);
    }
    std::vector<Finding> findings;
    if (transmittances.empty()) return findings;
    for (const Spectrum& spectrum : spectra) {
        if (spectrum.quantity != Quantity::reflectance) continue;
        const auto [first, last] = transmittances.equal_range(specimen(spectrum));
        for (auto each = first; each != last; ++each) {
            const std::optional<Sum> sum = largest_sum(spectrum, *each->second);
            if (!sum || sum->value <= most) continue;
            findings.push_back(
                {.name = "reflectance_plus_transmittance",
                 .spectrum = spectrum.name,
                 .message = fmt::format("with the transmittance {} it makes {:.4g} at {:g} nm, more light than came in",
                                        each->second->name, sum->value, sum->wavelength_nm),
                 .remedy = "check both white references and the units"});
        }
    }
    return findings;
}

}  // namespace skinfit
