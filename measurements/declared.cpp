#include "measurements/declared.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "measurements/words.hpp"

namespace skinfit {
namespace {

std::string_view meaning_of(std::string_view key) {
    static constexpr std::array<std::string_view, 15> counts = {
        "npoints",          "numberofpoints",     "noofpoints",
        "nrofpoints",       "numberofdatapoints", "datapoints",
        "points",           "numpoints",          "numberofpixelsinprocessedspectrum",
        "numberofchannels", "numberofbands",      "numberofpixelsinspectrum",
        "numberofreadings", "numberofvalues",     "numberofwavelengths"};
    struct Meaning {
        std::string_view key;
        std::string_view meaning;
    };
    static constexpr std::array<Meaning, 5> others = {{{"firstx", "first x"},
                                                       {"lastx", "last x"},
                                                       {"firsty", "first y"},
                                                       {"maxy", "largest y"},
                                                       {"miny", "smallest y"}}};
    const std::string plain = bare_key(key);
    if (std::ranges::find(counts, plain) != counts.end()) return "count";
    const auto found = std::ranges::find(others, std::string_view(plain), &Meaning::key);
    return found == others.end() ? std::string_view{} : found->meaning;
}

/// 0.01 for `12.34`; of numbers in powers of ten, the step of their mantissa.
double last_decimal(std::string_view number) {
    const std::size_t exponent = number.find_first_of("eE");
    const std::string_view mantissa = number.substr(0, exponent);
    const std::size_t point = mantissa.find('.');
    const auto decimals = point == std::string_view::npos ? 0.0 : static_cast<double>(mantissa.size() - point - 1);
    double power = 0;
    if (exponent != std::string_view::npos) power = parse_number(number.substr(exponent + 1)).value_or(0);
    return std::pow(10.0, power - decimals);
}

}  // namespace

std::string bare_key(std::string_view key) {
    std::string letters = lower_case(key);
    std::erase_if(letters, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
    return letters;
}

std::optional<Declared> declared_by(std::size_t line, std::string_view key, std::string_view value) {
    const std::string_view meaning = meaning_of(key);
    const std::string_view word = value.substr(0, value.find_first_of(" \t(,;"));
    const std::string_view rest = value.substr(word.size());
    const bool has_thousands = rest.size() > 3 && rest[0] == ',' && std::ranges::all_of(rest.substr(1, 3), is_digit);
    const std::optional<double> number = parse_number(word);
    if (meaning.empty() || !number || !std::isfinite(*number) || has_thousands) return std::nullopt;
    return Declared{.line = line,
                    .key = std::string(key),
                    .meaning = std::string(meaning),
                    .number = *number,
                    .step = last_decimal(word)};
}

std::optional<DeclaredScan> scan_declared_by(std::string_view key, std::string_view value) {
    static constexpr std::array<std::string_view, 8> starts = {"start",     "startwavelength",   "wavelengthstart",
                                                               "scanstart", "startnm",           "startwavelengthnm",
                                                               "begin",     "startingwavelength"};
    static constexpr std::array<std::string_view, 11> ends = {
        "end",     "stop",  "endwavelength", "stopwavelength",  "wavelengthend",   "wavelengthstop",
        "scanend", "endnm", "stopnm",        "endwavelengthnm", "endingwavelength"};
    static constexpr std::array<std::string_view, 5> ranges = {"scanrange", "wavelengthrange", "measurementrange",
                                                               "measuringrange", "spectralrange"};
    static constexpr std::array<std::string_view, 12> steps = {
        "deltax",   "step",       "stepsize", "datainterval", "datapitch",      "samplinginterval",
        "datastep", "stepsizenm", "stepnm",   "intervalnm",   "wavelengthstep", "wavelengthinterval"};
    const std::string plain = bare_key(key);
    const auto is_in = [&](auto& keys) { return std::ranges::find(keys, plain) != keys.end(); };
    if (value.starts_with('-')) value.remove_prefix(1);  // of a step downwards
    const std::size_t digits = value.find_first_not_of("0123456789.");
    const std::optional<double> first = parse_number(value.substr(0, digits));
    if (!first) return std::nullopt;
    std::string_view rest = digits == std::string_view::npos ? std::string_view{} : trimmed(value.substr(digits));
    const auto is_unit = [](std::string_view text) {
        return text.empty() || text.starts_with("nm") || text.starts_with("(nm)") || text.starts_with("[nm]");
    };
    DeclaredScan scan{.key = std::string(key)};
    if (is_in(ranges)) {
        const std::size_t second = rest.find_first_of("0123456789");
        if (second == std::string_view::npos || second > 10) return std::nullopt;
        rest.remove_prefix(second);
        const std::size_t end = std::min(rest.find_first_not_of("0123456789."), rest.size());
        const std::optional<double> last = parse_number(rest.substr(0, end));
        if (!last || !is_unit(trimmed(rest.substr(end)))) return std::nullopt;
        scan.ends = {*first, *last};
        return scan;
    }
    if (!is_unit(rest)) return std::nullopt;
    if (is_in(starts) || is_in(ends)) {
        scan.ends = {*first};
        return scan;
    }
    if (!is_in(steps)) return std::nullopt;
    scan.step = *first;
    return scan;
}

void check_declared(const std::string& source, std::span<const Declared> declared, std::span<const double> x,
                    std::span<const double> y, std::size_t spectra) {
    for (const Declared& each : declared) {
        const bool is_count = each.meaning == "count";
        std::optional<double> found;
        if (is_count) found = static_cast<double>(x.size());
        if (each.meaning == "first x") found = x.front();
        if (each.meaning == "last x") found = x.back();
        if (each.meaning == "first y" && !y.empty()) found = y.front();
        if (each.meaning == "largest y" && !y.empty()) found = std::ranges::max(y);
        if (each.meaning == "smallest y" && !y.empty()) found = std::ranges::min(y);
        if (!found || std::isnan(*found)) continue;
        const double tolerance = 0.6 * each.step + 1e-4 * std::abs(*found);  // of numbers that are rounded for people
        if (std::abs(*found - each.number) <= (is_count ? 0 : tolerance)) continue;
        const auto count = static_cast<double>(spectra);
        if (is_count && spectra > 1 && (each.number == count || each.number == count * *found)) continue;
        const bool is_of_y = each.meaning.ends_with(" y");  // which may be what the file's factor makes of it
        if (is_of_y && std::abs(*found * each.factor - each.number) <= 0.6 * each.step + 1e-4 * std::abs(each.number))
            continue;
        throw InputError({.where = fmt::format("{}:{}", source, each.line),
                          .problem = fmt::format("{} is {}", each.key, each.number),
                          .why = is_count ? fmt::format("the table has {} readings", *found)
                                          : fmt::format("the {} of the table is {}", each.meaning, *found),
                          .remedy = "check that the file is complete and unchanged, or delete this line"});
    }
}

std::vector<std::string> doubts_about_scans(std::span<const DeclaredScan> scans, std::span<const double> nm) {
    std::vector<std::string> remarks;
    if (nm.size() < 2) return remarks;
    const auto [low, high] = std::ranges::minmax(nm);
    const double step = (high - low) / static_cast<double>(nm.size() - 1);
    for (const DeclaredScan& scan : scans) {
        for (const double end : scan.ends) {
            if (std::min(std::abs(end - low), std::abs(end - high)) <= step) continue;
            remarks.push_back(fmt::format("the file states {} of {:g} nm, and its readings go from {:g} to {:g} nm",
                                          in_quotes(scan.key), end, low, high));
        }
        constexpr double nearly = 0.05;  // chosen: the pixels of a spectrometer are not evenly spaced
        if (!scan.step || std::abs(*scan.step - step) <= nearly * step) continue;
        remarks.push_back(fmt::format("the file states {} of {:g} nm, and its readings are {:g} nm apart",
                                      in_quotes(scan.key), *scan.step, step));
    }
    return remarks;
}

}  // namespace skinfit
