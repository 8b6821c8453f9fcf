#include "fit/settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/input_error.hpp"
#include "core/nearest_names.hpp"
#include "core/text.hpp"
#include "fit/instrument_settings.hpp"
#include "fit/preset.hpp"
#include "fit/problem_settings.hpp"
#include "fit/wavelength_sets.hpp"

namespace skinfit {
namespace {

template <class Enum, std::size_t count>
Enum read_name(const Json& value, const std::array<std::string_view, count>& names, const std::string& where) {
    return static_cast<Enum>(read_choice(value, names, where));
}

template <class Enum, class Owner, std::size_t count>
Setting named(std::string_view name, std::string_view meaning, const std::array<std::string_view, count>& names,
              Enum Owner::*field) {
    return {name,
            meaning,
            {{"enum", names}},
            [&names, field](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.*field = read_name<Enum>(value, names, where);
            },
            [&names, field](const Configuration& configuration) {
                return Json(names[static_cast<std::size_t>(configuration.*field)]);
            }};
}

/// A named setting that null leaves to the measured file.
template <class Enum, class Owner, std::size_t count>
Setting named(std::string_view name, std::string_view meaning, const std::array<std::string_view, count>& names,
              std::optional<Enum> Owner::*field) {
    Json choices = names;
    choices.push_back(nullptr);
    return {name,
            meaning,
            {{"enum", choices}},
            [&names, field](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.*field =
                    value.is_null() ? std::nullopt : std::optional(read_name<Enum>(value, names, where));
            },
            [&names, field](const Configuration& configuration) {
                const std::optional<Enum> choice = configuration.*field;
                return choice ? Json(names[static_cast<std::size_t>(*choice)]) : Json();
            }};
}

Setting number(std::string_view name, std::string_view meaning, const Range& range, double Configuration::*field) {
    return {name,
            meaning,
            {{"type", "number"}, {"minimum", range.lowest}, {"maximum", range.highest}},
            [range, field](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.*field = read_number(value, range, where);
            },
            [field](const Configuration& configuration) { return Json(configuration.*field); }};
}

Setting count(std::string_view name, std::string_view meaning, std::uint64_t lowest, std::uint64_t highest,
              std::uint64_t Configuration::*field) {
    return {name,
            meaning,
            {{"type", "integer"}, {"minimum", lowest}, {"maximum", highest}},
            [lowest, highest, field](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.*field = read_count(value, lowest, highest, where);
            },
            [field](const Configuration& configuration) { return Json(configuration.*field); }};
}

Setting edition() {
    return {"edition",
            "which reading of the model's paper: see model/REFERENCES.md",
            {{"enum", edition_names}},
            [](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.edition = read_name<Edition>(value, edition_names, where);
            },
            [](const Configuration& configuration) {
                return Json(edition_names[static_cast<std::size_t>(configuration.edition.value_or(default_edition))]);
            }};
}

Setting layers() {
    return {"layers",
            "4: whole skin; 2: separated stratum corneum and epidermis",
            {{"enum", {2, 4}}},
            [](Configuration& configuration, const Json& value, const std::string& where) {
                if (value != 2 && value != 4) {
                    refuse(where, value, "2 or 4 is needed",
                           "give 4 for whole skin, 2 for separated stratum corneum and epidermis");
                }
                configuration.layers = value.get<int>();
            },
            [](const Configuration& configuration) { return Json(configuration.layers.value_or(default_layers)); }};
}

constexpr Range base_index_range{1.0, 3.0};

void read_base(Configuration& configuration, const Json& value, const std::string& where) {
    constexpr std::array<std::string_view, 2> names = {"hypodermis", "matched"};
    if (value.is_null()) {
        configuration.base.reset();
    } else if (value.is_number()) {
        configuration.base =
            Base{.kind = Base::Kind::index, .refractive_index = read_number(value, base_index_range, where)};
    } else {
        if (!value.is_string() || std::ranges::find(names, value.get<std::string>()) == names.end()) {
            refuse(where, value, "hypodermis, matched or a refractive index is needed",
                   fmt::format("give one of these, the index from {} to {}, or null", base_index_range.lowest,
                               base_index_range.highest));
        }
        configuration.base = Base{.kind = read_name<Base::Kind>(value, names, where)};
    }
}

Setting base() {
    return {"base",
            "what lies under the lowest layer: hypodermis (reflects all), matched (lets all out) or a refractive "
            "index; null: hypodermis under 4 layers, air under 2",
            {{"anyOf",
              {Json{{"enum", {"hypodermis", "matched", nullptr}}},
               Json{{"type", "number"}, {"minimum", base_index_range.lowest}, {"maximum", base_index_range.highest}}}}},
            read_base,
            [](const Configuration& configuration) {
                if (!configuration.base) return Json();
                switch (configuration.base->kind) {
                    case Base::Kind::hypodermis:
                        return Json("hypodermis");
                    case Base::Kind::matched:
                        return Json("matched");
                    default:
                        return Json(configuration.base->refractive_index);
                }
            }};
}

/// A number that null leaves to the measured file.
Setting number(std::string_view name, std::string_view meaning, const Range& range,
               std::optional<double> Configuration::*field) {
    return {name,
            meaning,
            {{"type", {"number", "null"}}, {"minimum", range.lowest}, {"maximum", range.highest}},
            [range, field](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.*field = value.is_null() ? std::nullopt : std::optional(read_number(value, range, where));
            },
            [field](const Configuration& configuration) {
                const std::optional<double> number = configuration.*field;
                return number ? Json(*number) : Json();
            }};
}

Setting column() {
    return {
        "column",
        "of a file with several spectra, by name or number; null: the only one",
        {{"type", {"string", "integer", "null"}}},
        [](Configuration& configuration, const Json& value, const std::string& where) {
            if (value.is_null()) {
                configuration.column.reset();
            } else if (value.is_string() || value.is_number_integer()) {
                configuration.column = value.is_string() ? value.get<std::string>() : value.dump();
            } else {
                refuse(where, value, "a column's name or number is needed", "give it as text");
            }
        },
        [](const Configuration& configuration) { return configuration.column ? Json(*configuration.column) : Json(); }};
}

Setting wavelengths() {
    return {"wavelengths",
            "of a simulation, nm: first:last:step or a list",
            {{"type", {"string", "number"}}},
            [](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.wavelengths = value.is_string() ? value.get<std::string>() : value.dump();
                (void)parse_wavelengths(configuration.wavelengths, where);
            },
            [](const Configuration& configuration) { return Json(configuration.wavelengths); }};
}

std::vector<Setting> general_settings() {
    constexpr std::uint64_t fewest_rays = 1000;
    constexpr std::uint64_t most_rays = 10'000'000'000;
    constexpr std::uint64_t largest_seed = 9'007'199'254'740'991;  // 2^53 - 1: exact in any JSON reader
    return {
        preset_setting(),
        edition(),
        named(
            "engine",
            "how the model is computed (what fits it is the setting solver): paths: recorded walks, smooth; walk: the "
            "walk of the paper ray by ray, simulation only; solver: the angular solver, without random noise; "
            "emulator: that solver as a polynomial, fastest, geometry fixed",
            engine_names, &Configuration::engine),
        named("solver",
              "what looks for the best values of a fit (how the model is computed is the setting engine): ceres and "
              "slsqp by "
              "exact derivatives, bobyqa and sbplx without, crs2 by searching everywhere",
              solver_names, &Configuration::solver),
        named("uncertainty",
              "what the intervals of a fit come from; profile is right at bounds, posterior takes longest",
              uncertainty_names, &Configuration::uncertainty),
        layers(),
        base(),
        number("incidence_deg",
               "of the light, to the normal; null: as the measured file says, else 8, or 45 with a viewing cone",
               incidence_range_deg, &Configuration::incidence_deg),
        named(
            "specular",
            "whether the mirror reflection of the surface is seen; null: as the file says, else included, or excluded "
            "with a viewing cone",
            specular_names, &Configuration::specular),
        number("viewing_cone_deg",
               "half angle of the cone about the normal through which a 45/0 instrument sees the skin, which gives the "
               "reflectance factor; null: as the measured file says, else none, all reflected light is collected",
               viewing_cone_range_deg, &Configuration::viewing_cone_deg),
        named("quantity", "what the spectrum measures; null: as the file says, else reflectance", quantity_names,
              &Configuration::quantity),
        column(),
        named("unit", "of the values in the file; null: found by the unit rule", unit_names, &Configuration::unit),
        count("rays", "per wavelength", fewest_rays, most_rays, &Configuration::rays),
        count("seed", "of the random numbers", 0, largest_seed, &Configuration::seed),
        wavelengths(),
        number("wavelength_min_nm", "a fit uses the wavelengths from here", {0, 1e5},
               &Configuration::wavelength_min_nm),
        number("wavelength_max_nm", "a fit uses the wavelengths up to here", {0, 1e5},
               &Configuration::wavelength_max_nm),
        number("noise",
               "standard uncertainty of a value where the file states none, fraction; null: as the instrument says, "
               "else 0.006",
               noise_range, &Configuration::noise),
        count("starts", "of a fit: the configured one, and points spread over the bounds", 1, 10'000,
              &Configuration::starts),
    };
}

}  // namespace

void refuse(const std::string& where, const Json& value, const std::string& why, const std::string& remedy) {
    throw InputError(
        {.where = where, .problem = fmt::format("{} cannot be used", shown(value)), .why = why, .remedy = remedy});
}

double read_number(const Json& value, const Range& range, const std::string& where) {
    const std::string remedy = fmt::format("give a number from {} to {}", range.lowest, range.highest);
    if (!value.is_number()) refuse(where, value, "a number is needed", remedy);
    const double number = value.get<double>();
    if (!range.contains(number)) refuse(where, value, "out of range", remedy);
    return number;
}

std::uint64_t read_count(const Json& value, std::uint64_t lowest, std::uint64_t highest, const std::string& where) {
    const std::string remedy = fmt::format("give a whole number from {} to {}", lowest, highest);
    if (!value.is_number()) refuse(where, value, "a number is needed", remedy);
    const double number = value.get<double>();
    if (number != std::floor(number)) refuse(where, value, "a whole number is needed", remedy);
    // As doubles two neighbouring large counts may be the same.
    const bool too_large = value.is_number_integer() && number > 0.0 ? value.get<std::uint64_t>() > highest
                                                                     : number > static_cast<double>(highest);
    if (number < static_cast<double>(lowest) || too_large) refuse(where, value, "out of range", remedy);
    return value.is_number_integer() ? value.get<std::uint64_t>() : static_cast<std::uint64_t>(number);
}

std::size_t read_choice(const Json& value, std::span<const std::string_view> names, const std::string& where) {
    const std::string text = value.is_string() ? value.get<std::string>() : shown(value);
    const auto found = std::ranges::find(names, text);
    if (found == names.end()) {
        const std::vector<std::string_view> meant = meant_names(text, names);
        refuse(where, value, fmt::format("one of {} is needed", fmt::join(names, ", ")),
               meant.empty() ? "give one of these" : fmt::format("did you mean {}?", either(meant, "", "")));
    }
    return static_cast<std::size_t>(found - names.begin());
}

std::span<const Setting> setting_table() {
    static const std::vector<Setting> settings = [] {
        std::vector<Setting> all = general_settings();
        std::ranges::move(instrument_settings(), std::back_inserter(all));
        std::ranges::move(problem_settings(), std::back_inserter(all));
        return all;
    }();
    return settings;
}

}  // namespace skinfit
