#include "fit/problem_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "core/input_error.hpp"
#include "fit/json_reading.hpp"
#include "fit/prior_json.hpp"

namespace skinfit {
namespace {

constexpr std::array<std::string_view, 3> loss_names = {"squares", "huber", "cauchy"};
constexpr std::array<std::string_view, 2> kernel_names = {"squared_exponential", "matern_3_2"};
constexpr Range wavelength_range{0.0, 1e5};
constexpr Range weight_range{1e-6, 1e6};
constexpr Range loss_scale_range{0.01, 1000.0};
constexpr Range discrepancy_range{1e-6, 1.0};
constexpr Range length_range{1.0, 1e4};

Json number_schema(const Range& range) {
    return {{"type", "number"}, {"minimum", range.lowest}, {"maximum", range.highest}};
}

/// The entries of a list of lists of `count` numbers each.
std::vector<Json> read_rows(const Json& value, std::size_t count, const std::string& form, const std::string& where) {
    const bool good = value.is_array() && std::ranges::all_of(value, [count](const Json& row) {
                          return row.is_array() && row.size() == count;
                      });
    if (!good) {
        refuse(where, value, fmt::format("a list of lists of {} numbers is needed", count),
               fmt::format("write it as in {}", form));
    }
    return {value.begin(), value.end()};
}

Bounds read_range_nm(const Json& row, const std::string& where) {
    const Bounds range_nm{read_number(row[0], wavelength_range, where), read_number(row[1], wavelength_range, where)};
    if (range_nm.lower > range_nm.upper) refuse(where, row, "a range begins with its shorter end", "exchange the two");
    return range_nm;
}

Setting exclude() {
    return {
        "exclude_nm",
        "ranges of wavelengths a fit leaves out, both ends included: [[from, to], ...]",
        {{"type", "array"},
         {"items", {{"type", "array"}, {"items", number_schema(wavelength_range)}, {"minItems", 2}, {"maxItems", 2}}}},
        [](Configuration& configuration, const Json& value, const std::string& where) {
            configuration.exclude_nm.clear();
            for (const Json& row : read_rows(value, 2, "[[500, 520]]", where)) {
                configuration.exclude_nm.push_back(read_range_nm(row, where));
            }
        },
        [](const Configuration& configuration) {
            Json json = Json::array();
            for (const Bounds& range : configuration.exclude_nm) json.push_back({range.lower, range.upper});
            return json;
        }};
}

Setting weights() {
    return {"weights",
            "how much the squared residuals of ranges of wavelengths count, 1 elsewhere: [[from, to, weight], ...]",
            {{"type", "array"},
             {"items",
              {{"type", "array"},
               {"items", Json::array({number_schema(wavelength_range), number_schema(wavelength_range),
                                      number_schema(weight_range)})},
               {"minItems", 3},
               {"maxItems", 3}}}},
            [](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.weights.clear();
                for (const Json& row : read_rows(value, 3, "[[500, 520, 0.1]]", where)) {
                    configuration.weights.push_back(
                        {.range_nm = read_range_nm(row, where), .weight = read_number(row[2], weight_range, where)});
                }
            },
            [](const Configuration& configuration) {
                Json json = Json::array();
                for (const Weight& each : configuration.weights) {
                    json.push_back({each.range_nm.lower, each.range_nm.upper, each.weight});
                }
                return json;
            }};
}

Setting loss() {
    return {"loss",
            "how a residual counts: squares, huber or cauchy; the latter two let outliers pull less",
            {{"enum", loss_names}},
            [](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.loss = static_cast<Loss>(read_choice(value, loss_names, where));
            },
            [](const Configuration& configuration) {
                return Json(loss_names[static_cast<std::size_t>(configuration.loss)]);
            }};
}

Setting loss_scale() {
    return {"loss_scale",
            "sigmas beyond which the loss departs from squares; null: 1.345 (huber), 2.385 (cauchy), 95 % efficient",
            {{"type", {"number", "null"}}, {"minimum", loss_scale_range.lowest}, {"maximum", loss_scale_range.highest}},
            [](Configuration& configuration, const Json& value, const std::string& where) {
                configuration.loss_scale =
                    value.is_null() ? std::nullopt : std::optional(read_number(value, loss_scale_range, where));
            },
            [](const Configuration& configuration) {
                return configuration.loss_scale ? Json(*configuration.loss_scale) : Json();
            }};
}

void read_discrepancy(Configuration& configuration, const Json& value, const std::string& where) {
    if (value.is_null()) {
        configuration.discrepancy.reset();
        return;
    }
    if (!value.is_object()) {
        refuse(where, value, "an object is needed",
               R"(write {} for the usual one, the same as {"sigma": 0.005, "length_nm": 30}, or null for none)");
    }
    Discrepancy discrepancy;
    for (const auto& [key, entry] : value.items()) {
        const std::string here = fmt::format("{}.{}", where, key);
        if (key == "sigma") {
            discrepancy.sigma = read_number(entry, discrepancy_range, here);
        } else if (key == "length_nm") {
            discrepancy.length_nm = read_number(entry, length_range, here);
        } else if (key == "kernel") {
            discrepancy.kernel = static_cast<Kernel>(read_choice(entry, kernel_names, here));
        } else {
            refuse_unknown(where, key, {"sigma", "length_nm", "kernel"});
        }
    }
    configuration.discrepancy = discrepancy;
}

Setting discrepancy() {
    return {"discrepancy",
            "the model's own smooth departure from real skin, a Gaussian process over wavelength: sigma (fraction), "
            "length_nm, kernel; null: none",
            {{"anyOf", Json::array({Json{{"type", "null"}}, Json{{"type", "object"},
                                                                 {"properties",
                                                                  {{"sigma", number_schema(discrepancy_range)},
                                                                   {"length_nm", number_schema(length_range)},
                                                                   {"kernel", {{"enum", kernel_names}}}}},
                                                                 {"additionalProperties", false}}})}},
            read_discrepancy,
            [](const Configuration& configuration) {
                if (!configuration.discrepancy) return Json();
                const Discrepancy& chosen = *configuration.discrepancy;
                return Json{{"sigma", chosen.sigma},
                            {"length_nm", chosen.length_nm},
                            {"kernel", kernel_names[static_cast<std::size_t>(chosen.kernel)]}};
            }};
}

Setting priors() {
    return {"priors",
            "what is known beside the spectrum, by parameter or derived quantity; uniform within the bounds where not "
            "stated; or a word: uniform for all, physiological for the set with sources",
            priors_schema(), read_priors, write_priors};
}

}  // namespace

std::vector<Setting> problem_settings() {
    return {priors(), exclude(), weights(), loss(), loss_scale(), discrepancy()};
}

}  // namespace skinfit
