#include "fit/goniophotometer_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "core/version.hpp"
#include "fit/configuration_json.hpp"
#include "fit/problem.hpp"

namespace skinfit {
namespace {

/// One row of the table, with the names of the columns.
struct AngularRow {
    std::string_view kind;
    int polar_bin;
    std::optional<int> azimuth_bin;
    BrdfValue value;
};

double edge_deg(const AngularBins& bins, int polar_bin) {
    return 90.0 * polar_bin / bins.polar;
}

double azimuth_deg(const AngularBins& bins, std::optional<int> azimuth_bin) {
    return azimuth_bin ? 360.0 * *azimuth_bin / bins.azimuth : -1.0;
}

bool transmits(const GoniophotometerRun& run) {
    if (run.light == Light::surface) return false;
    for (const AngularCounts& counts : run.spectrum.counts) {
        if (counts.totals.transmitted > 0) return true;
    }
    return false;
}

std::vector<AngularRow> angular_rows(const GoniophotometerRun& run) {
    const AngularBins& bins = run.spectrum.bins;
    std::vector<AngularRow> rows;
    const auto add = [&](std::string_view kind, Light light, int polar_bin, std::optional<int> azimuth_bin) {
        rows.push_back({kind, polar_bin, azimuth_bin, brdf(run.spectrum, light, polar_bin, azimuth_bin)});
    };
    for (int polar = 0; polar < bins.polar; ++polar) add("polar", run.light, polar, std::nullopt);
    for (int polar = bins.polar; polar-- > 0;) add("inplane_back", run.light, polar, bins.azimuth / 2);
    for (int polar = 0; polar < bins.polar; ++polar) add("inplane_forward", run.light, polar, 0);
    if (transmits(run)) {
        for (int polar = 0; polar < bins.polar; ++polar) {
            add("transmitted_polar", Light::transmitted, polar, std::nullopt);
        }
    }
    return rows;
}

/// The settings that matter to a goniophotometer, and whatever is needed to repeat the run.
Json settings(const GoniophotometerRun& run) {
    const Json all = to_json(resolved(run.configuration));
    Json json = {{"version", version}};
    for (const char* key : {"edition", "rays", "seed", "layers", "base", "incidence_deg", "wavelengths"}) {
        json[key] = all[key];
    }
    json["illuminant"] = name_of(run.illuminant);
    if (!run.response.empty()) json["response"] = run.response;
    json["part"] = name_of(run.light);
    json["azimuth_bin_deg"] = 360.0 / run.spectrum.bins.azimuth;
    return json;
}

std::string comments(const GoniophotometerRun& run, std::string_view title) {
    std::string text = fmt::format("# skinfit {} {}\n", version, title);
    const Json stated = settings(run);
    for (const auto& [key, value] : stated.items()) {
        if (key != "version")
            text += fmt::format("# {}: {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
    }
    text += "# parameters:";
    for (const ParameterInfo& info : parameter_table()) {
        text += fmt::format(" {}={}", info.name, value_of(run.configuration.values, info.parameter));
    }
    return text +
           "\n# an ideal goniophotometer: specular, scale, offset, specular_fraction and wavelength_shift_nm are not "
           "used\n";
}

Json counts_json(const WalkCounts& counts) {
    return {{"rays", counts.rays},
            {"surface_reflected", counts.surface_reflected},
            {"subsurface_reflected", counts.subsurface_reflected},
            {"transmitted", counts.transmitted},
            {"absorbed", counts.absorbed}};
}

/// All bins of one kind of light: [polar][azimuth].
Json map_json(const GoniophotometerRun& run, Light light) {
    Json map = {{"brdf_per_sr", Json::array()}, {"brdf_se", Json::array()}};
    for (int polar = 0; polar < run.spectrum.bins.polar; ++polar) {
        Json values = Json::array();
        Json errors = Json::array();
        for (int azimuth = 0; azimuth < run.spectrum.bins.azimuth; ++azimuth) {
            const BrdfValue value = brdf(run.spectrum, light, polar, azimuth);
            values.push_back(value.per_sr);
            errors.push_back(value.standard_error);
        }
        map["brdf_per_sr"].push_back(values);
        map["brdf_se"].push_back(errors);
    }
    return map;
}

Json with_configuration(Json json, const GoniophotometerRun& run) {
    json["settings"] = settings(run);
    json["configuration"] = to_json(resolved(run.configuration));
    return json;
}

}  // namespace

std::string_view name_of(BandIlluminant illuminant) {
    static constexpr std::array<std::string_view, 3> names = {"equal_energy", "d65", "d65_v"};
    return names[static_cast<std::size_t>(illuminant)];
}

std::string_view name_of(Light light) {
    static constexpr std::array<std::string_view, 4> names = {"total", "surface", "subsurface", "transmitted"};
    return names[static_cast<std::size_t>(light)];
}

std::string goniophotometer_csv(const GoniophotometerRun& run) {
    std::string text = comments(run, "goniophotometer");
    text += "kind,polar_lo_deg,polar_hi_deg,azimuth_deg,brdf_per_sr,brdf_se\n";
    for (const AngularRow& row : angular_rows(run)) {
        text +=
            fmt::format("{},{},{},{},{},{}\n", row.kind, edge_deg(run.spectrum.bins, row.polar_bin),
                        edge_deg(run.spectrum.bins, row.polar_bin + 1), azimuth_deg(run.spectrum.bins, row.azimuth_bin),
                        row.value.per_sr, row.value.standard_error);
    }
    return text;
}

Json goniophotometer_json(const GoniophotometerRun& run) {
    Json json;
    const AngularBins& bins = run.spectrum.bins;
    for (const AngularRow& row : angular_rows(run)) {
        json["kind"].push_back(row.kind);
        json["polar_lo_deg"].push_back(edge_deg(bins, row.polar_bin));
        json["polar_hi_deg"].push_back(edge_deg(bins, row.polar_bin + 1));
        json["azimuth_deg"].push_back(azimuth_deg(bins, row.azimuth_bin));
        json["brdf_per_sr"].push_back(row.value.per_sr);
        json["brdf_se"].push_back(row.value.standard_error);
    }
    json["all_bins"] = map_json(run, run.light);
    if (transmits(run)) json["all_bins_transmitted"] = map_json(run, Light::transmitted);
    json["wavelength_nm"] = run.wavelengths_nm;
    json["weight"] = run.spectrum.weights;
    for (const AngularCounts& counts : run.spectrum.counts) json["counts"].push_back(counts_json(counts.totals));
    return with_configuration(std::move(json), run);
}

std::string reciprocity_csv(const std::vector<ReciprocityPair>& pairs, const GoniophotometerRun& run) {
    const AngularBins& bins = run.spectrum.bins;
    std::string text = comments(run, "goniophotometer, both ways between two directions; incidence_deg is not used");
    text += "polar_a_lo_deg,polar_a_hi_deg,polar_b_lo_deg,polar_b_hi_deg,azimuth_deg,";
    text += "brdf_a_to_b_per_sr,brdf_a_to_b_se,brdf_b_to_a_per_sr,brdf_b_to_a_se,z\n";
    for (const ReciprocityPair& pair : pairs) {
        text += fmt::format(
            "{},{},{},{},{},{},{},{},{},{}\n", edge_deg(bins, pair.polar_bin_a), edge_deg(bins, pair.polar_bin_a + 1),
            edge_deg(bins, pair.polar_bin_b), edge_deg(bins, pair.polar_bin_b + 1), azimuth_deg(bins, pair.azimuth_bin),
            pair.a_to_b.per_sr, pair.a_to_b.standard_error, pair.b_to_a.per_sr, pair.b_to_a.standard_error, pair.z);
    }
    return text;
}

Json reciprocity_json(const std::vector<ReciprocityPair>& pairs, const GoniophotometerRun& run) {
    const AngularBins& bins = run.spectrum.bins;
    Json json = {{"pairs", Json::array()}};
    for (const ReciprocityPair& pair : pairs) {
        json["pairs"].push_back({{"polar_a_lo_deg", edge_deg(bins, pair.polar_bin_a)},
                                 {"polar_a_hi_deg", edge_deg(bins, pair.polar_bin_a + 1)},
                                 {"polar_b_lo_deg", edge_deg(bins, pair.polar_bin_b)},
                                 {"polar_b_hi_deg", edge_deg(bins, pair.polar_bin_b + 1)},
                                 {"azimuth_deg", azimuth_deg(bins, pair.azimuth_bin)},
                                 {"brdf_a_to_b_per_sr", pair.a_to_b.per_sr},
                                 {"brdf_a_to_b_se", pair.a_to_b.standard_error},
                                 {"brdf_b_to_a_per_sr", pair.b_to_a.per_sr},
                                 {"brdf_b_to_a_se", pair.b_to_a.standard_error},
                                 {"z", pair.z}});
    }
    return with_configuration(std::move(json), run);
}

}  // namespace skinfit
