#include "study/study_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/input_error.hpp"
#include "core/utf8.hpp"
#include "fit/report.hpp"
#include "study/sqlite_errors.hpp"
#include "study/study_assessment.hpp"

namespace skinfit {
namespace {

Json counts_json(const StatusCounts& counts) {
    Json json = Json::object();
    for (std::size_t i = 0; i < counts.size(); ++i) json[std::string(fit_status_names[i])] = counts[i];
    return json;
}

Json indicators_json(const Study& study, const AnsweredRow& each) {
    Json json = Json::object();
    for (std::size_t i = 0; i < study.indicators.size(); ++i) {
        const IndicatorAnswer& answer = each.indicators[i];
        json[study.indicators[i].name] = answer.probability ? Json{{"probability", *answer.probability},
                                                                   {"decided_by_prior", answer.decided_by_prior}}
                                                            : Json{{"none", answer.why_none}};
    }
    return json;
}

Json row_json(const Study& study, const AnsweredRow& each) {
    Json json = {{"source", each.row.key.source},
                 {"number", each.row.key.number},
                 {"spectrum", each.row.key.name},
                 {"metadata", metadata_json(each.row.metadata)}};
    json.update(to_json(each.row.studied));
    json["indicators"] = indicators_json(study, each);
    json["input_hash"] = each.row.input_hash;
    json["configuration_hash"] = each.row.configuration_hash;
    return json;
}

Json definitions_json(const Study& study) {
    Json indicators = Json::array();
    for (const Indicator& indicator : study.indicators) {
        Json json = {{"name", indicator.name}, {"quantity", indicator.quantity}};
        Json threshold = indicator.threshold ? Json(*indicator.threshold) : Json();
        if (indicator.reference) {
            threshold = {{"same", indicator.reference->same}, {"where", metadata_json(indicator.reference->where)}};
        }
        json[indicator.above ? "above" : "below"] = threshold;
        json["source"] = indicator.source;
        if (indicator.prevalence) json["prevalence"] = *indicator.prevalence;
        indicators.push_back(json);
    }
    Json indices = Json::array();
    for (const IndexInfo& info : index_table()) {
        indices.push_back(
            {{"name", info.name}, {"unit", info.unit}, {"meaning", info.meaning}, {"source", info.source}});
    }
    return {{"indicators", indicators}, {"indices", indices}};
}

Json cubes_json(const Ledger& ledger) {
    Json json = Json::array();
    for (const CubeRow& row : cube_rows(ledger)) {
        json.push_back({{"source", row.source},
                        {"metadata", metadata_json(row.metadata)},
                        {"map", row.map.empty() ? Json() : Json(row.map)},
                        {"reason", row.reason},
                        {"tiles", row.tiles},
                        {"tiles_done", row.tiles_done},
                        {"pixels", counts_json(row.pixels)}});
    }
    return json;
}

std::string counts_text(const StatusCounts& counts) {
    std::string text;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const bool always = i < static_cast<std::size_t>(FitStatus::failed) + 1;
        if (counts[i] == 0 && !always) continue;
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[i], fit_status_names[i]);
    }
    return text;
}

}  // namespace

Json configuration_in(const Ledger& ledger) {
    const std::string text = ledger.note("configuration");
    if (!text.empty()) {
        return understood(ledger.path(), [&] {
            Json configuration = Json::parse(text);
            for (const char* key : {"edition", "engine", "uncertainty", "noise", "seed"}) (void)configuration.at(key);
            return configuration;
        });
    }
    throw InputError({.where = ledger.path().string(),
                      .problem = "holds no settings",
                      .why = "its first run ended before it knew the inputs",
                      .remedy = "run the study again"});
}

StudyCounts counts_of(const Ledger& ledger) {
    StudyCounts counts;
    counts.spectra = ledger.counts();
    for (const CubeRow& row : cube_rows(ledger)) {
        ++counts.cubes;
        counts.tiles += row.tiles;
        counts.tiles_done += row.tiles_done;
        if (!row.map.empty()) ++counts.maps;
        if (!row.reason.empty()) counts.unread_cubes.emplace_back(row.source, row.reason);
        for (std::size_t i = 0; i < row.pixels.size(); ++i) counts.pixels[i] += row.pixels[i];
    }
    return counts;
}

std::string status_text(const StudyCounts& counts) {
    const auto spectra = std::accumulate(counts.spectra.begin(), counts.spectra.end(), std::uint64_t{0});
    std::string text;
    if (spectra > 0 || counts.cubes == 0) {
        text = fmt::format("{} {}: {}\n", spectra, spectra == 1 ? "spectrum" : "spectra", counts_text(counts.spectra));
    }
    if (counts.cubes > 0) {
        text += fmt::format("{} {}, {} with a map; {} of {} tiles done; pixels of these: {}\n", counts.cubes,
                            counts.cubes == 1 ? "cube" : "cubes", counts.maps, counts.tiles_done, counts.tiles,
                            counts_text(counts.pixels));
    }
    for (const auto& [source, reason] : counts.unread_cubes)
        text += fmt::format("{}: FAILED: {}\n", printable(source), printable(reason));
    return text;
}

Json status_json(const StudyCounts& counts) {
    Json json = counts_json(counts.spectra);
    json["pixels"] = counts_json(counts.pixels);
    json["cubes"] = counts.cubes;
    json["maps"] = counts.maps;
    json["tiles"] = {{"done", counts.tiles_done}, {"pending", counts.tiles - counts.tiles_done}};
    return json;
}

Json results_json(const Study& study, const Ledger& ledger, const std::vector<AnsweredRow>& rows) {
    Json json = {{"study", study.name}, {"version", ledger.note("version")}};
    json["configuration"] = configuration_in(ledger);
    json.update(definitions_json(study));
    json["counts"] = status_json(counts_of(ledger));
    json["repeatability"] = repeatability_json(study, rows);
    json["assessments"] = assessments_json(study, rows);
    json["spectra"] = Json::array();
    for (const AnsweredRow& each : rows) json["spectra"].push_back(row_json(study, each));
    json["cubes"] = cubes_json(ledger);
    return json;
}

}  // namespace skinfit
