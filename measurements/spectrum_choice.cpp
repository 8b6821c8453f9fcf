#include "measurements/spectrum_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {

std::string list_of_names(const std::vector<Spectrum>& spectra) {
    constexpr std::size_t most = 20;
    std::vector<std::string_view> shown;
    for (const Spectrum& spectrum : spectra) {
        if (shown.size() == most) break;
        shown.push_back(spectrum.name);
    }
    const std::size_t more = spectra.size() - shown.size();
    return fmt::format("{}{}", fmt::join(shown, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

Spectrum choose_spectrum(std::vector<Spectrum> spectra, const std::string& source, const std::string& wanted) {
    std::vector<std::size_t> called;
    for (std::size_t i = 0; i < spectra.size(); ++i) {
        if (spectra[i].name == wanted) called.push_back(i);
    }
    if (called.size() > 1) {
        throw InputError({.where = source,
                          .problem = fmt::format("{} spectra are called {}", called.size(), in_quotes(wanted)),
                          .why = fmt::format("the first are numbers {} and {}", called[0] + 1, called[1] + 1),
                          .remedy = "choose one by its number"});
    }
    if (!called.empty()) return std::move(spectra[called.front()]);
    const bool numbers_are_names =
        std::ranges::any_of(spectra, [](const Spectrum& spectrum) { return parse_count(spectrum.name).has_value(); });
    const std::uint64_t number = numbers_are_names ? 0 : parse_count(wanted).value_or(0);
    if (number > 0 && number <= spectra.size()) return std::move(spectra[number - 1]);
    std::vector<std::string_view> names;
    for (const Spectrum& spectrum : spectra) names.push_back(spectrum.name);
    throw InputError({.where = source,
                      .problem = fmt::format("has no spectrum {}", in_quotes(wanted)),
                      .why = fmt::format("it holds {}; the nearest name is {}", list_of_names(spectra),
                                         in_quotes(nearest_name(wanted, names))),
                      .remedy = numbers_are_names ? "choose one by its name"
                                                  : "choose one by its name or by its number, counted from 1"});
}

}  // namespace skinfit
