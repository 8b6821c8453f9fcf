#include <fmt/format.h>

#include "fit/report.hpp"

namespace skinfit {
namespace {

std::string kind_text(const FitResult& result) {
    switch (result.configuration.uncertainty) {
        case UncertaintyMethod::profile:
            return fmt::format("intervals: profile likelihood, {} evaluations\n", result.profile->evaluations);
        case UncertaintyMethod::posterior:
            return "intervals: posterior, equal tails\n";
        default:
            return "intervals: covariance, the model linearised; --uncertainty profile is right at bounds\n";
    }
}

std::string inflation_text(const FitResult& result) {
    if (!result.inflation) return "";
    return fmt::format(
        "sigmas are those of {}; were the whole misfit noise, they would be {:.2g} times as large "
        "(sqrt(chi2 / degrees of freedom))\n",
        result.configuration.discrepancy ? "noise and discrepancy together" : "the stated noise", *result.inflation);
}

std::string directions_text(const Identifiability& found) {
    std::string text =
        "what the spectrum can tell, in sigmas of noise for a standard deviation of what was known before (priors, "
        "else bounds):\n";
    for (const Direction& direction : found.directions) {
        text += fmt::format("  {:>8.3g}  {}{}\n", direction.singular_value, in_words(direction, found.names),
                            direction.is_weak() ? "  WEAK" : "");
    }
    text += "of the variance known before, the spectrum takes away:\n";
    for (std::size_t i = 0; i < found.names.size(); ++i) {
        text += fmt::format("  {:>6.1f} %  {}{}\n", 100.0 * found.shrinkage[i], found.names[i],
                            found.shrinkage[i] < 0.0 ? "  (values lie further apart than before)" : "");
    }
    return text;
}

std::string posterior_text(const FitResult& result) {
    if (!result.posterior) return "";
    const Posterior& posterior = *result.posterior;
    std::string text = fmt::format(
        "posterior: {} chains of {} draws, steps that went astray (divergences): {}, {} evaluations\n",
        posterior.chains, posterior.draws.cols() / posterior.chains, posterior.divergences, posterior.evaluations);
    text += fmt::format("  {:<34}{:>12}{:>12}{:>10}{:>12}{:>12}\n", "", "median", "deviation", "R-hat", "draws: bulk",
                        "tails");
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const Marginal& row = posterior.marginals[i];
        text += fmt::format("  {:<34}{:>12.4g}{:>12.2g}{:>10.3f}{:>12.0f}{:>12.0f}\n", result.free[i].name, row.median,
                            row.sigma, row.r_hat, row.bulk_effective_size, row.tail_effective_size);
    }
    return text +
           "  R-hat: 1 where the chains agree; draws: how many independent ones tell as much of middle (bulk) and "
           "tails\n";
}

Json directions_json(const Identifiability& found) {
    Json directions = Json::array();
    for (const Direction& direction : found.directions) {
        Json components;
        for (std::size_t i = 0; i < found.names.size(); ++i) {
            components[found.names[i]] = direction.components[static_cast<Eigen::Index>(i)];
        }
        directions.push_back({{"singular_value", direction.singular_value},
                              {"weak", direction.is_weak()},
                              {"words", in_words(direction, found.names)},
                              {"components", components}});
    }
    return directions;
}

/// Of each parameter the points of its profile, by ascending value.
Json profile_json(const FitResult& result) {
    Json curves = Json::object();
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const ProfileCurve& curve = result.profile->intervals[i].curve;
        Json& json = curves[result.free[i].name];
        for (const char* key : {"value", "cost_rise", "cost_slope", "cost_rise_95"}) json[key] = Json::array();
        for (const ProfilePoint& point : curve) {
            json["value"].push_back(point.at);
            json["cost_rise"].push_back(point.cost_rise);
            json["cost_slope"].push_back(point.cost_slope);
            json["cost_rise_95"].push_back(point.cost_rise_95);
        }
    }
    return {{"evaluations", result.profile->evaluations},
            {"better_minimum", result.profile->better_minimum},
            {"curves", curves}};
}

Json posterior_json(const FitResult& result) {
    const Posterior& posterior = *result.posterior;
    Json json = {{"chains", posterior.chains},           {"draws_per_chain", posterior.draws.cols() / posterior.chains},
                 {"divergences", posterior.divergences}, {"evaluations", posterior.evaluations},
                 {"parameters", Json::object()},         {"correlation", Json::array()}};
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        const Marginal& row = posterior.marginals[i];
        json["parameters"][result.free[i].name] = {{"median", row.median},
                                                   {"mean", row.mean},
                                                   {"sigma", row.sigma},
                                                   {"interval_95", {row.lower, row.upper}},
                                                   {"r_hat", row.r_hat},
                                                   {"bulk_effective_size", row.bulk_effective_size},
                                                   {"tail_effective_size", row.tail_effective_size}};
    }
    for (const auto& row : posterior.correlation.rowwise()) {
        json["correlation"].push_back(std::vector<double>(row.begin(), row.end()));
    }
    return json;
}

}  // namespace

std::string uncertainty_text(const FitResult& result) {
    return kind_text(result) + inflation_text(result) + posterior_text(result) +
           directions_text(result.identifiability);
}

Json uncertainty_json(const FitResult& result) {
    constexpr std::array<const char*, 3> kinds = {"covariance", "profile", "posterior"};
    Json json = {{"intervals", kinds.at(static_cast<std::size_t>(result.configuration.uncertainty))},
                 {"inflation", result.inflation ? Json(*result.inflation) : Json()},
                 {"directions", directions_json(result.identifiability)},
                 {"shrinkage", Json::object()}};
    for (std::size_t i = 0; i < result.identifiability.names.size(); ++i) {
        json["shrinkage"][result.identifiability.names[i]] = result.identifiability.shrinkage[i];
    }
    if (result.profile) json["profile"] = profile_json(result);
    if (result.posterior) json["posterior"] = posterior_json(result);
    return json;
}

}  // namespace skinfit
