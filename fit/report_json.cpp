#include <cmath>

#include "core/version.hpp"
#include "fit/configuration_json.hpp"
#include "fit/diagnosis.hpp"
#include "fit/inspection.hpp"
#include "fit/model_split.hpp"
#include "fit/report.hpp"
#include "fit/tissue.hpp"

namespace skinfit {
namespace {

template <class Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json();
}

Json parameters_json(const FitResult& result) {
    Json json;
    for (const std::vector<FittedParameter>* rows : {&result.free, &result.fixed}) {
        for (const FittedParameter& fitted : *rows) {
            const ParameterUncertainty& uncertainty = fitted.uncertainty;
            json[fitted.name] = {{"value", fitted.value},
                                 {"sigma", or_null(uncertainty.sigma)},
                                 {"monte_carlo_sigma", or_null(uncertainty.monte_carlo_sigma)},
                                 {"interval_95", {uncertainty.interval_95.lower, uncertainty.interval_95.upper}},
                                 {"lower", fitted.bounds.lower},
                                 {"upper", fitted.bounds.upper},
                                 {"start", fitted.start},
                                 {"status", name_of(uncertainty.status)},
                                 {"decided_by_prior", uncertainty.decided_by_prior},
                                 {"unit", info(fitted.parameter).unit}};
        }
    }
    return json;
}

Json correlation_json(const FitResult& result) {
    Json names = Json::array();
    Json matrix = Json::array();
    for (Eigen::Index a = 0; a < result.correlation.rows(); ++a) {
        names.push_back(result.free[static_cast<std::size_t>(a)].name);
        Json row = Json::array();
        for (Eigen::Index b = 0; b < result.correlation.cols(); ++b) row.push_back(result.correlation(a, b));
        matrix.push_back(row);
    }
    return {{"parameters", names}, {"matrix", matrix}};
}

Json finite_or_null(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

Json other_assumptions_json(const FitResult& result) {
    if (!result.other_assumptions) return {};
    const OtherAssumptions& others = *result.other_assumptions;
    Json alternatives = Json::array();
    for (const OtherAssumptions::Alternative& each : others.alternatives) {
        Json answers;
        for (std::size_t i = 0; i < others.answers.size(); ++i)
            answers[others.answers[i].name] = finite_or_null(each.values[i]);
        alternatives.push_back(
            {{"assumption", each.assumption}, {"left_out_rmse", each.left_out_rmse}, {"answers", answers}});
    }
    return {{"left_out_rmse", others.left_out_rmse}, {"alternatives", alternatives}};
}

Json values_json(const FitResult& result, const Minimum& minimum) {
    Json values;
    for (std::size_t i = 0; i < result.free.size(); ++i) {
        values[result.free[i].name] = minimum.values[i];
    }
    return values;
}

Json minima_json(const FitResult& result) {
    Json minima = Json::array();
    for (const DistinctMinimum& each : result.searches.minima) {
        minima.push_back({{"cost", each.minimum.cost},
                          {"chi2", each.minimum.chi2},
                          {"converged", each.minimum.converged},
                          {"searches", each.searches},
                          {"values", values_json(result, each.minimum)},
                          {"largest_difference_sigmas", or_null(largest_difference_in_sigmas(result, each.minimum))}});
    }
    return minima;
}

Json answer_json(const FitResult& result, const SolverAnswer& answer, const Json& solver_name) {
    return {{"solver", solver_name},
            {"cost", answer.minimum.cost},
            {"chi2", answer.minimum.chi2},
            {"converged", answer.minimum.converged},
            {"termination", answer.minimum.termination},
            {"evaluations", answer.minimum.evaluations},
            {"values", values_json(result, answer.minimum)},
            {"largest_difference_sigmas", or_null(largest_difference_in_sigmas(result, answer.minimum))}};
}

Json solver_name(Solver solver) {
    Configuration configuration;
    configuration.solver = solver;
    return to_json(configuration)["solver"];
}

Json origin_json(const FittedSpectrum& spectrum) {
    return {{"name", spectrum.name},
            {"source", spectrum.source},
            {"unit_rule", spectrum.unit_rule},
            {"sigma_source", spectrum.sigma_source}};
}

Json tissue_json(const FitResult& result) {
    Json json = Json::array();
    for (const TissueEstimate& each : tissue_estimates(result)) {
        json.push_back(
            {{"name", each.quantity->name},
             {"value", each.value},
             {"unit", each.quantity->unit},
             {"calibrated", each.is_calibrated},
             {"interval_95", each.interval_95 ? Json{each.interval_95->lower, each.interval_95->upper} : Json()}});
    }
    return json;
}

Json splits_json(const std::vector<ModelSplit>& splits) {
    Json json = Json::array();
    for (const ModelSplit& each : splits) {
        json.push_back({{"parameters", {each.first, each.second}},
                        {"correlation", each.correlation},
                        {"use", each.use},
                        {"message", in_words(each)}});
    }
    return json;
}

Json readings_json(const FittedSpectrum& spectrum) {
    Json residual = Json::array();
    for (std::size_t i = 0; i < spectrum.measured.size(); ++i) {
        residual.push_back(spectrum.modelled[i] - spectrum.measured[i]);
    }
    Json modelled_95 = Json::array();
    for (const Bounds& interval : spectrum.modelled_95) modelled_95.push_back({interval.lower, interval.upper});
    return {{"wavelength_nm", spectrum.wavelength_nm}, {"measured", spectrum.measured}, {"sigma", spectrum.sigma},
            {"modelled", spectrum.modelled},           {"modelled_95", modelled_95},    {"residual", residual}};
}

/// Of a joint fit: each spectrum with its own misfit and geometry.
Json spectra_json(const FitResult& result) {
    Json spectra = Json::array();
    for (const FittedSpectrum& spectrum : result.spectra) {
        Json json = origin_json(spectrum);
        json.update(readings_json(spectrum));
        json["rmse"] = spectrum.rmse;
        json["chi2"] = spectrum.chi2;
        const Json configuration = to_json(spectrum.configuration);
        for (const char* key : {"quantity", "incidence_deg", "specular", "viewing_cone_deg"}) {
            json[key] = configuration[key];
        }
        spectra.push_back(json);
    }
    return spectra;
}

}  // namespace

Json json_report(const FitResult& result) {
    const Json configuration = to_json(result.configuration);
    Json json = {{"verdict", name_of(result.verdict)},
                 {"reasons", result.reasons},
                 {"unfinished", result.unfinished},
                 {"rmse", result.rmse},
                 {"chi2", result.chi2},
                 {"cost", result.cost},
                 {"degrees_of_freedom", result.degrees_of_freedom},
                 {"p_value", or_null(result.p_value)},
                 {"small_chi2", is_chi2_small(result)},
                 {"slow_residuals_p_value", or_null(result.slow_residuals_p_value)},
                 {"unexplained_rmse", result.unexplained_rmse},
                 {"departure_rms", result.departure_rms},
                 {"monte_carlo_error", result.monte_carlo_error},
                 {"emulator_error", or_null(result.emulator_error)},
                 {"solver_error", or_null(result.solver_error)},
                 {"parameters", parameters_json(result)},
                 {"tissue", tissue_json(result)},
                 {"split_by_model", splits_json(model_splits(result))},
                 {"other_assumptions", other_assumptions_json(result)},
                 {"correlation", correlation_json(result)},
                 {"uncertainty", uncertainty_json(result)},
                 {"solution", answer_json(result, result.answer, solver_name(result.answer.solver))}};
    json["searches"] = {{"starts", result.searches.starts},
                        {"minima", result.searches.rough_minima},
                        {"finished", result.searches.finished}};
    json["minima"] = minima_json(result);
    if (!result.cross_check.empty()) json["cross_check"] = Json::array();
    for (const SolverAnswer& other : result.cross_check) {
        json["cross_check"].push_back(answer_json(result, other, solver_name(other.solver)));
        json["cross_check"].back()["seconds"] = other.seconds;
    }
    if (result.spectra.size() == 1) {
        const FittedSpectrum& only = result.spectra.front();
        json["spectrum"] = origin_json(only);
        json.update(readings_json(only));
    } else {
        json["spectra"] = spectra_json(result);
    }
    json["findings"] = findings_json(result.findings);
    for (const char* key : {"edition", "engine", "seed", "rays"}) json[key] = configuration[key];
    json["version"] = version;
    json["configuration"] = configuration;
    return json;
}

}  // namespace skinfit
