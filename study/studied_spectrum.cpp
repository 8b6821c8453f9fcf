#include "study/studied_spectrum.hpp"

#include <algorithm>
#include <stdexcept>

#include "fit/prior_json.hpp"
#include "fit/report.hpp"

namespace skinfit {
namespace {

Json or_null(const std::optional<double>& number) {
    return number ? Json(*number) : Json();
}

std::optional<double> number_or_none(const Json& json) {
    return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

Bounds bounds_from(const Json& json) {
    return {.lower = json.at(0).get<double>(), .upper = json.at(1).get<double>()};
}

std::optional<Prior> prior_from(const Json& estimate) {
    return estimate.contains("prior") ? read_prior(estimate["prior"], "prior") : std::nullopt;
}

Status status_named(const std::string& name) {
    for (const Status status :
         {Status::free, Status::fixed, Status::at_lower_bound, Status::at_upper_bound, Status::not_identifiable}) {
        if (name_of(status) == name) return status;
    }
    throw std::out_of_range("no status of a parameter: " + name);
}

}  // namespace

FitStatus fit_status_named(std::string_view name) {
    const auto found = std::ranges::find(fit_status_names, name);
    if (found == fit_status_names.end()) throw std::out_of_range("no status of a spectrum: " + std::string(name));
    return static_cast<FitStatus>(found - fit_status_names.begin());
}

Json parameters_json(const std::vector<ParameterEstimate>& parameters) {
    Json json = Json::array();
    for (const ParameterEstimate& each : parameters) {
        json.push_back({{"name", each.name},
                        {"value", each.value},
                        {"sigma", or_null(each.sigma)},
                        {"interval_95", {each.interval_95.lower, each.interval_95.upper}},
                        {"bounds", {each.bounds.lower, each.bounds.upper}},
                        {"status", name_of(each.status)},
                        {"decided_by_prior", each.decided_by_prior},
                        {"split_by_model", each.split_by_model}});
        if (each.prior) json.back()["prior"] = to_json(*each.prior);
        if (!each.quantiles.empty()) json.back()["quantiles"] = each.quantiles;
    }
    return json;
}

std::vector<ParameterEstimate> parameters_from_json(const Json& json) {
    std::vector<ParameterEstimate> parameters;
    for (const Json& each : json) {
        parameters.push_back({.name = each.at("name").get<std::string>(),
                              .value = each.at("value").get<double>(),
                              .sigma = number_or_none(each.at("sigma")),
                              .interval_95 = bounds_from(each.at("interval_95")),
                              .bounds = bounds_from(each.at("bounds")),
                              .status = status_named(each.at("status").get<std::string>()),
                              .quantiles = each.value("quantiles", std::vector<double>()),
                              .prior = prior_from(each),
                              .decided_by_prior = each.value("decided_by_prior", false),
                              .split_by_model = each.value("split_by_model", false)});
    }
    return parameters;
}

Json tissue_json(const std::vector<TissueValue>& tissue) {
    Json json = Json::array();
    for (const TissueValue& each : tissue) {
        json.push_back(
            {{"name", each.name},
             {"value", each.value},
             {"interval_95", each.interval_95 ? Json{each.interval_95->lower, each.interval_95->upper} : Json()}});
        if (!each.quantiles.empty()) json.back()["quantiles"] = each.quantiles;
    }
    return json;
}

std::vector<TissueValue> tissue_from_json(const Json& json) {
    std::vector<TissueValue> tissue;
    for (const Json& each : json) {
        const Json& interval = each.at("interval_95");
        tissue.push_back({.name = each.at("name").get<std::string>(),
                          .value = each.at("value").get<double>(),
                          .interval_95 = interval.is_null() ? std::nullopt : std::optional(bounds_from(interval)),
                          .quantiles = each.value("quantiles", std::vector<double>())});
    }
    return tissue;
}

Json indices_json(const std::vector<IndexValue>& indices) {
    Json json = Json::array();
    for (const IndexValue& each : indices) {
        json.push_back({{"name", each.name}, {"value", each.value}, {"sigma", each.sigma}});
    }
    return json;
}

std::vector<IndexValue> indices_from_json(const Json& json) {
    std::vector<IndexValue> indices;
    for (const Json& each : json) {
        const auto name = each.at("name").get<std::string>();
        const auto info = std::ranges::find(index_table(), name, &IndexInfo::name);
        if (info == index_table().end()) throw std::out_of_range("no index: " + name);
        indices.push_back(
            {.name = info->name, .value = each.at("value").get<double>(), .sigma = each.at("sigma").get<double>()});
    }
    return indices;
}

Json to_json(const StudiedSpectrum& spectrum) {
    return {{"status", name_of(spectrum.status)},
            {"verdict", spectrum.verdict},
            {"reason", spectrum.reason},
            {"parameters", parameters_json(spectrum.parameters)},
            {"correlation", spectrum.correlation},
            {"tissue", tissue_json(spectrum.tissue)},
            {"indices", indices_json(spectrum.indices)},
            {"rmse", or_null(spectrum.rmse)},
            {"chi2", or_null(spectrum.chi2)},
            {"degrees_of_freedom", or_null(spectrum.degrees_of_freedom)},
            {"p_value", or_null(spectrum.p_value)},
            {"seconds", spectrum.seconds}};
}

StudiedSpectrum studied_from_json(const Json& json) {
    return {.status = fit_status_named(json.at("status").get<std::string>()),
            .verdict = json.at("verdict").get<std::string>(),
            .reason = json.at("reason").get<std::string>(),
            .parameters = parameters_from_json(json.at("parameters")),
            .correlation = json.at("correlation").get<std::vector<double>>(),
            .tissue = tissue_from_json(json.at("tissue")),
            .indices = indices_from_json(json.at("indices")),
            .rmse = number_or_none(json.at("rmse")),
            .chi2 = number_or_none(json.at("chi2")),
            .degrees_of_freedom = number_or_none(json.at("degrees_of_freedom")),
            .p_value = number_or_none(json.at("p_value")),
            .seconds = json.at("seconds").get<double>()};
}

}  // namespace skinfit
