#include "fit/other_assumptions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/input_error.hpp"
#include "fit/left_out_bands.hpp"
#include "fit/preset.hpp"
#include "fit/tissue.hpp"

namespace skinfit {
namespace {

constexpr double clearly_better = 0.8;  // the root mean square of about ten bands is known to a fifth

/// Another assumption: what it makes of the problem, in words; nothing where it does not apply.
using Assumption = std::function<std::optional<std::string>(FitProblem&)>;

std::vector<FreeParameter>::iterator place_of(FitProblem& problem, Parameter parameter) {
    return std::ranges::find(problem.free, parameter, &FreeParameter::parameter);
}

bool is_free(FitProblem& problem, Parameter parameter) {
    return place_of(problem, parameter) != problem.free.end();
}

double& fixed_value(FitProblem& problem, Parameter parameter) {
    return value_of(problem.only().experiment.values, parameter);
}

std::string held(FitProblem& problem, Parameter parameter, double value) {
    problem.free.erase(place_of(problem, parameter));
    fixed_value(problem, parameter) = value;
    return fmt::format("{} {:g}", info(parameter).name, value);
}

std::string freed(FitProblem& problem, Parameter parameter, const Prior& prior) {
    const FitSettings& settings = problem.only().configuration;
    const Bounds bounds = within_support(prior, settings.bounds[static_cast<std::size_t>(parameter)]);
    problem.free.push_back({.parameter = parameter,
                            .start = std::clamp(prior_median(prior), bounds.lower, bounds.upper),
                            .bounds = bounds,
                            .prior = prior});
    return fmt::format("{} free", info(parameter).name);
}

/// The prior that preset skin gives a parameter.
const Prior& prior_of_skin(Parameter parameter) {
    static const Configuration skin = measured_configuration();
    return skin.priors[static_cast<std::size_t>(parameter)].value();
}

Assumption free_instrument(Parameter parameter, const std::function<Prior(double)>& prior_about) {
    return [parameter, prior_about](FitProblem& problem) -> std::optional<std::string> {
        if (is_free(problem, parameter)) return std::nullopt;
        return freed(problem, parameter, prior_about(fixed_value(problem, parameter)));
    };
}

std::optional<std::string> other_specular(FitProblem& problem) {
    Measurement& measurement = problem.only();
    Experiment& experiment = measurement.experiment;
    const bool matters = measurement.quantity == Quantity::reflectance && !experiment.viewing_cone_rad;
    if (!matters || !measurement.configuration.specular_is_assumed) return std::nullopt;
    const bool included = experiment.specular == Specular::included;
    experiment.specular = included ? Specular::excluded : Specular::included;
    return included ? "specular excluded" : "specular included";
}

Assumption blood_of(double share, std::string_view source) {
    return [share, source](FitProblem& problem) -> std::optional<std::string> {
        double& value = fixed_value(problem, Parameter::whole_blood_share);
        if (is_free(problem, Parameter::whole_blood_share) || value == share) return std::nullopt;
        value = share;
        return fmt::format("hemoglobin of {}", source);
    };
}

/// Held at `value` where it is free, free where it is fixed and `frees`.
Assumption held_or_freed(Parameter parameter, double value, bool frees) {
    return [=](FitProblem& problem) -> std::optional<std::string> {
        if (is_free(problem, parameter)) return held(problem, parameter, value);
        if (!frees) return std::nullopt;
        return freed(problem, parameter, prior_of_skin(parameter));
    };
}

std::optional<std::string> bilirubin_outside_vessels(FitProblem& problem) {
    const bool applies =
        is_free(problem, Parameter::bilirubin_g_per_l) && !is_free(problem, Parameter::dermal_bilirubin_g_per_l);
    if (!applies) return std::nullopt;
    (void)held(problem, Parameter::bilirubin_g_per_l,
               value_of(measured_configuration().values, Parameter::bilirubin_g_per_l));
    (void)freed(problem, Parameter::dermal_bilirubin_g_per_l, prior_of_skin(Parameter::dermal_bilirubin_g_per_l));
    return "bilirubin outside the vessels";
}

std::vector<Assumption> assumptions() {
    constexpr double scale_sigma_log = 0.05;  // chosen: what white standards and ports leave open
    constexpr double offset_sigma = 0.005;    // chosen: stray light of small instruments
    return {
        free_instrument(Parameter::scale,
                        [=](double value) { return LogNormalPrior{.median = value, .sigma_log = scale_sigma_log}; }),
        free_instrument(Parameter::offset,
                        [=](double value) { return NormalPrior{.mean = value, .sigma = offset_sigma}; }),
        other_specular,
        blood_of(0.0, "[PRAHL98]"),
        blood_of(1.0, "[BOSSCHAART14]"),
        held_or_freed(Parameter::melanin_slope, 0.0, true),
        held_or_freed(Parameter::lateral_loss_per_cm, 0.0, true),
        held_or_freed(Parameter::fibril_radius_nm, default_configuration().values.skin.fibril_radius_nm, false),
        bilirubin_outside_vessels,
    };
}

/// What should not depend on the assumptions, among what the fit adjusts.
struct Answers {
    std::vector<Parameter> parameters;
    std::vector<double (*)(const Skin&)> tissue;
};

Answers answers_of(const FitResult& result, OtherAssumptions& others) {
    Answers answers;
    for (const Parameter parameter : {Parameter::melanosome_fraction, Parameter::oxygen_saturation}) {
        const auto fitted = std::ranges::find(result.free, parameter, &FittedParameter::parameter);
        if (fitted == result.free.end()) continue;
        answers.parameters.push_back(parameter);
        others.answers.push_back({fitted->name, fitted->value, fitted->uncertainty.interval_95});
    }
    for (const TissueEstimate& each : tissue_estimates(result)) {
        const bool is_repeated = each.quantity->name == "epidermal_melanin_optical_depth" ||
                                 each.quantity->name == "tissue_bilirubin_umol_per_l";
        if (is_repeated || !each.interval_95) continue;
        answers.tissue.push_back(each.value_of);
        others.answers.push_back({std::string(each.quantity->name), each.value, *each.interval_95});
    }
    return answers;
}

std::vector<double> values_of(const Answers& answers, const ParameterValues& at) {
    std::vector<double> values;
    for (const Parameter parameter : answers.parameters) values.push_back(value_of(at, parameter));
    for (const auto value_of_skin : answers.tissue) values.push_back(value_of_skin(at.skin));
    return values;
}

/// The values of the free parameters of `problem` where the fit has ended; starts of those it did not adjust.
std::vector<double> begin_of(const FitProblem& problem, const FitProblem& fitted, const Minimum& minimum) {
    std::vector<double> values = starts(problem);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto same =
            std::ranges::find(fitted.free, problem.free[i].parameter, &FreeParameter::parameter) - fitted.free.begin();
        if (same < std::ssize(fitted.free)) values[i] = minimum.values[static_cast<std::size_t>(same)];
    }
    return values;
}

}  // namespace

std::optional<OtherAssumptions> try_other_assumptions(const FitResult& result, const Objective& objective,
                                                      const std::vector<ForwardModel>& models, const Minimum& minimum) {
    const FitProblem& fitted = objective.problem();
    if (fitted.measurements.size() > 1 || fitted.only().configuration.engine == Engine::solver) return std::nullopt;
    OtherAssumptions others;
    const Answers answers = answers_of(result, others);
    if (others.answers.empty()) return std::nullopt;
    others.left_out_rmse = left_out_rmse(objective, minimum.values);
    for (const Assumption& assumption : assumptions()) {
        FitProblem problem = fitted;
        const std::optional<std::string> words = assumption(problem);
        if (!words || problem.free.empty()) continue;
        const Objective other(problem, models, objective.stop());
        try {
            const Minimum found = minimise(other, Solver::ceres, begin_of(problem, fitted, minimum));
            if (!found.converged) continue;
            others.alternatives.push_back(
                {.assumption = *words,
                 .left_out_rmse = left_out_rmse(other, found.values),
                 .values = values_of(answers, other.models().front().at(found.values).values)});
        } catch (const InputError&) {
            // Outside what the model was made for.
        }
    }
    return others;
}

std::vector<std::size_t> answers_moved(const OtherAssumptions& assumptions,
                                       const OtherAssumptions::Alternative& alternative) {
    std::vector<std::size_t> moved;
    if (alternative.left_out_rmse > clearly_better * assumptions.left_out_rmse) return moved;
    for (std::size_t i = 0; i < alternative.values.size(); ++i) {
        const Bounds& interval = assumptions.answers[i].interval_95;
        const double value = alternative.values[i];
        if (std::isfinite(value) && (value < interval.lower || value > interval.upper)) moved.push_back(i);
    }
    return moved;
}

}  // namespace skinfit
