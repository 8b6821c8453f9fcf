#include "validation/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "fit/configuration_json.hpp"
#include "fit/json_reading.hpp"
#include "validation/figure_names.hpp"

namespace skinfit {
namespace {

using Names = std::vector<std::string_view>;

const std::string example = "configs/figure_5.json, which comes with skinfit, is an example";

/// An object whose keys are all `known` and among which none of `needed` is missing.
void check_keys(const Json& json, const Names& known, const Names& needed, const std::string& where) {
    require_names(json, known, {needed, "a figure cannot do without it", example}, where);
}

std::string read_text(const Json& json, std::string_view key, const std::string& where) {
    const Json& value = json.at(key);
    if (value.is_string() && !value.get<std::string>().empty()) return value.get<std::string>();
    refuse(fmt::format("{}.{}", where, key), value, "text is needed", "write it between double quotes");
}

/// The place of a word among `names`.
template <class NameArray>
std::size_t read_choice(const Json& value, const NameArray& names, const std::string& where) {
    if (!value.is_string()) refuse(where, value, "a name is needed", fmt::format("give one such as \"{}\"", names[0]));
    const auto found = std::ranges::find(names, value.get<std::string>());
    if (found == names.end()) refuse_unknown(where, value.get<std::string>(), Names(names.begin(), names.end()));
    return static_cast<std::size_t>(found - names.begin());
}

const Json& read_list(const Json& json, std::string_view key, const std::string& where) {
    const Json& list = json.at(key);
    if (list.is_array() && !list.empty()) return list;
    refuse(fmt::format("{}.{}", where, key), list, "a list with something in it is needed", example);
}

/// `configuration` changed by the entry of that name, if there is one.
Configuration changed(const Configuration& configuration, const Json& json, const std::string& where) {
    if (!json.contains("configuration")) return configuration;
    return configured(configuration, json["configuration"], where + ".configuration");
}

/// Variants are read as a configuration is, so that they know the same ranges.
std::vector<FigureVariant> read_variants(const Json& json, const std::string& where) {
    check_keys(json, {"edition", "fibril_radius_nm"}, {"edition", "fibril_radius_nm"}, where);
    std::vector<FigureVariant> variants;
    for (const Json& radius : read_list(json, "fibril_radius_nm", where)) {
        for (const Json& edition : read_list(json, "edition", where)) {
            const Json settings = {{"edition", edition}, {"parameters", {{"fibril_radius_nm", radius}}}};
            const Configuration read = configured(default_configuration(), settings, where);
            variants.push_back({.edition = read.edition.value_or(default_edition),
                                .fibril_radius_nm = read.values.skin.fibril_radius_nm});
        }
    }
    return variants;
}

Claim read_claim(const Json& json, const FigurePanel& panel, FigureKind kind, const std::string& where) {
    std::vector<std::string_view> names;
    for (const ClaimInfo& row : claim_table()) names.push_back(row.name);
    const ClaimInfo& row = claim_table()[read_choice(json, names, where)];
    const auto refuse_here = [&](const std::string& why, const std::string& remedy) {
        refuse(where, json, why, remedy);
    };
    if (row.kind != kind) {
        constexpr std::array<std::string_view, 3> about = {"pigments", "spectra", "angles"};
        refuse_here(fmt::format("it is about {}", about.at(static_cast<std::size_t>(row.kind))),
                    "leave it out of this figure");
    }
    if (row.compares_series && panel.series.size() < 2) refuse_here("it compares series", "give two series or more");
    if (row.needs_measured && !panel.measured) refuse_here("it needs a measurement", "name a file in \"measured\"");
    return row.claim;
}

/// The series of a figure of extinctions are the pigments.
void check_pigment(const Json& series, FigureKind kind, const std::string& where) {
    if (kind != FigureKind::extinction) return;
    Names pigments;
    for (const PigmentRow& row : pigment_table()) pigments.push_back(row.name);
    (void)read_choice(series["name"], pigments, where + ".name");
}

FigurePanel read_panel(const Json& json, const Configuration& base, FigureKind kind, const std::string& where) {
    check_keys(json, {"title", "light", "swatches", "configuration", "series", "measured", "claims"},
               {"title", "series"}, where);
    FigurePanel panel;
    panel.title = read_text(json, "title", where);
    if (json.contains("light")) {
        panel.light = static_cast<FigureLight>(read_choice(json["light"], figure_light_names, where + ".light"));
    }
    if (json.contains("swatches")) {
        if (!json["swatches"].is_boolean())
            refuse(where + ".swatches", json["swatches"], "no truth value", "give true");
        panel.has_swatches = json["swatches"].get<bool>();
    }
    if (json.contains("measured")) panel.measured = read_text(json, "measured", where);
    const Configuration panel_base = changed(base, json, where);
    for (const Json& series : read_list(json, "series", where)) {
        const std::string here = fmt::format("{}.series[{}]", where, panel.series.size());
        check_keys(series, {"name", "configuration"}, {"name"}, here);
        check_pigment(series, kind, here);
        panel.series.push_back(
            {.name = read_text(series, "name", here), .configuration = changed(panel_base, series, here)});
    }
    if (!json.contains("claims")) return panel;
    for (const Json& claim : read_list(json, "claims", where)) {
        panel.claims.push_back(
            read_claim(claim, panel, kind, fmt::format("{}.claims[{}]", where, panel.claims.size())));
    }
    return panel;
}

/// Every key that `json`, an entry "configuration", sets.
void add_keys(const Json& json, Names& keys) {
    if (!json.contains("configuration")) return;
    for (const auto& [key, value] : json["configuration"].items()) {
        if (key != "parameters") keys.push_back(key);
    }
    if (!json["configuration"].contains("parameters")) return;
    for (const auto& [key, value] : json["configuration"]["parameters"].items()) keys.push_back(key);
}

/// Every value states where it comes from, and nothing else does.
void check_sources(const Json& json, const std::string& where) {
    Names set = {"edition", "fibril_radius_nm"};
    add_keys(json, set);
    for (const Json& panel : json["panels"]) {
        add_keys(panel, set);
        for (const Json& series : panel["series"]) add_keys(series, set);
    }
    const std::string here = where + ".sources";
    check_keys(json["sources"], set, {}, here);
    for (const std::string_view key : set) {
        const auto source = json["sources"].find(key);
        const std::string text =
            source != json["sources"].end() && source->is_string() ? source->get<std::string>() : std::string();
        if (text.starts_with("paper: ") || text.starts_with("chosen: ")) continue;
        throw InputError({.where = here,
                          .problem = fmt::format("\"{}\" has no source", key),
                          .why = "a reader must see which values are the paper's",
                          .remedy = R"(write "paper: ..." or "chosen: ...")"});
    }
}

}  // namespace

Figure parse_figure(std::string_view text, const std::string& where) {
    const Json json = parsed_json(text, where, example);
    check_keys(json, {"figure", "title", "shows", "kind", "configuration", "variants", "panels", "sources"},
               {"figure", "title", "shows", "kind", "variants", "panels", "sources"}, where);
    if (!json["figure"].is_number_integer()) refuse(where + ".figure", json["figure"], "no whole number", "give it");
    Figure figure{.number = json["figure"].get<int>(),
                  .title = read_text(json, "title", where),
                  .shows = read_text(json, "shows", where),
                  .kind = static_cast<FigureKind>(read_choice(json["kind"], figure_kind_names, where + ".kind")),
                  .variants = read_variants(json["variants"], where + ".variants"),
                  .panels = {},
                  .sources = json["sources"]};
    const Configuration base = changed(default_configuration(), json, where);
    for (const Json& panel : read_list(json, "panels", where)) {
        figure.panels.push_back(
            read_panel(panel, base, figure.kind, fmt::format("{}.panels[{}]", where, figure.panels.size())));
    }
    check_sources(json, where);
    return figure;
}

}  // namespace skinfit
