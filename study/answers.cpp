#include "study/answers.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "fit/prior.hpp"
#include "study/marginal.hpp"

namespace skinfit {
namespace {

const ParameterEstimate* parameter_of(const LedgerRow& row, const std::string& name) {
    const auto found = std::ranges::find(row.studied.parameters, name, &ParameterEstimate::name);
    return found == row.studied.parameters.end() ? nullptr : &*found;
}

const TissueValue* tissue_of(const LedgerRow& row, const std::string& name) {
    const auto found = std::ranges::find(row.studied.tissue, name, &TissueValue::name);
    return found == row.studied.tissue.end() ? nullptr : &*found;
}

const IndexValue* index_of(const LedgerRow& row, const std::string& name) {
    const auto found = std::ranges::find(row.studied.indices, name, &IndexValue::name);
    return found == row.studied.indices.end() ? nullptr : &*found;
}

/// What is believed of a quantity, and whether its prior says most of it.
struct Belief {
    MarginalDistribution marginal;
    bool decided_by_prior;
};

/// The share of the prior of a fit above `threshold`, within its bounds.
double prior_above(const ParameterEstimate& parameter, double threshold) {
    const Bounds& bounds = parameter.bounds;
    const double split = std::clamp(threshold, bounds.lower, bounds.upper);
    if (!parameter.prior) return (bounds.upper - split) / (bounds.upper - bounds.lower);
    return mass_within(*parameter.prior, {.lower = split, .upper = bounds.upper}) /
           mass_within(*parameter.prior, bounds);
}

/// What a probability becomes where `prevalence` was to be expected in place of `expected`, which lies between 0 and 1:
/// its odds change by as much as those (Bayes's rule).
double at_prevalence(double probability, double expected, double prevalence) {
    const double yes = probability * prevalence / expected;
    const double no = (1.0 - probability) * (1.0 - prevalence) / (1.0 - expected);
    return yes / (yes + no);
}

std::optional<Belief> belief_in(const LedgerRow& row, const std::string& quantity) {
    if (!has_answer(row.studied.status)) return std::nullopt;
    if (const ParameterEstimate* const parameter = parameter_of(row, quantity)) {
        const std::optional<MarginalDistribution> marginal = marginal_of(*parameter);
        if (!marginal) return std::nullopt;
        return Belief{.marginal = *marginal, .decided_by_prior = parameter->decided_by_prior};
    }
    if (const TissueValue* const tissue = tissue_of(row, quantity)) {
        const std::optional<MarginalDistribution> marginal = marginal_of(*tissue);
        return marginal ? std::optional(Belief{.marginal = *marginal, .decided_by_prior = false}) : std::nullopt;
    }
    if (const IndexValue* const index = index_of(row, quantity)) {
        return Belief{.marginal = marginal_of(*index), .decided_by_prior = false};
    }
    return std::nullopt;
}

bool matches(const Metadata& metadata, const Metadata& wanted) {
    return std::ranges::all_of(wanted, [&](const auto& each) { return word_of(metadata, each.first) == each.second; });
}

/// What is believed of the reference of each specimen.
using References = std::map<std::string, std::vector<Belief>>;

References references_of(const Indicator& indicator, const std::vector<LedgerRow>& rows) {
    References references;
    if (!indicator.reference) return references;
    for (const LedgerRow& row : rows) {
        const std::string specimen = word_of(row.metadata, indicator.reference->same);
        if (specimen.empty() || !matches(row.metadata, indicator.reference->where)) continue;
        if (const std::optional<Belief> belief = belief_in(row, indicator.quantity)) {
            references[specimen].push_back(*belief);
        }
    }
    return references;
}

IndicatorAnswer answer(const Indicator& indicator, const LedgerRow& row, const References& references) {
    if (!has_answer(row.studied.status)) {
        return {.probability = {}, .why_none = std::string(name_of(row.studied.status))};
    }
    const std::optional<Belief> belief = belief_in(row, indicator.quantity);
    if (!belief) {
        const bool known = parameter_of(row, indicator.quantity) || tissue_of(row, indicator.quantity);
        return {.probability = {}, .why_none = indicator.quantity + (known ? " is not identifiable" : " is not known")};
    }
    double above = 0.0;
    bool decided_by_prior = belief->decided_by_prior;
    if (indicator.threshold) {
        above = belief->marginal.probability_above(*indicator.threshold);
    } else {
        const auto found = references.find(word_of(row.metadata, indicator.reference->same));
        if (found == references.end()) return {.probability = {}, .why_none = "no reference of the same specimen"};
        if (matches(row.metadata, indicator.reference->where)) return {.probability = {}, .why_none = "a reference"};
        for (const Belief& reference : found->second) {
            above += belief->marginal.probability_above(reference.marginal);
            decided_by_prior = decided_by_prior || reference.decided_by_prior;
        }
        above /= static_cast<double>(found->second.size());
    }
    double probability = indicator.above ? above : 1.0 - above;
    if (indicator.prevalence) {
        const double above_it = prior_above(*parameter_of(row, indicator.quantity), *indicator.threshold);
        const double expected = indicator.above ? above_it : 1.0 - above_it;
        if (!(expected > 0.0 && expected < 1.0)) {
            return {.probability = {}, .why_none = "the prior lies on one side of the threshold"};
        }
        probability = at_prevalence(probability, expected, *indicator.prevalence);
    }
    return {.probability = probability, .why_none = {}, .decided_by_prior = decided_by_prior};
}

/// Mean and standard deviation of a posterior whose distribution is linear between its quantiles.
QuantityEstimate of_posterior(const ParameterEstimate& parameter) {
    const std::vector<double>& quantiles = parameter.quantiles;
    const auto parts = static_cast<double>(quantiles.size() - 1);
    double mean = 0.0;
    for (std::size_t k = 1; k < quantiles.size(); ++k) mean += (quantiles[k - 1] + quantiles[k]) / 2.0 / parts;
    double variance = 0.0;
    for (std::size_t k = 1; k < quantiles.size(); ++k) {
        const double a = quantiles[k - 1] - mean;
        const double b = quantiles[k] - mean;
        variance += (a * a + a * b + b * b) / 3.0 / parts;
    }
    return {.value = mean,
            .sigma = std::sqrt(variance),
            .interval_95 = parameter.interval_95,
            .decided_by_prior = parameter.decided_by_prior,
            .split_by_model = parameter.split_by_model};
}

}  // namespace

std::vector<AnsweredRow> answered(const Study& study, std::vector<LedgerRow> rows) {
    std::vector<References> references;
    for (const Indicator& indicator : study.indicators) references.push_back(references_of(indicator, rows));
    std::vector<AnsweredRow> all;
    for (LedgerRow& row : rows) {
        AnsweredRow one{.row = {}, .indicators = {}};
        for (std::size_t i = 0; i < study.indicators.size(); ++i) {
            one.indicators.push_back(answer(study.indicators[i], row, references[i]));
        }
        one.row = std::move(row);
        all.push_back(std::move(one));
    }
    return all;
}

std::optional<QuantityEstimate> estimate_of(const LedgerRow& row, const std::string& quantity) {
    if (!has_answer(row.studied.status)) return std::nullopt;
    if (const ParameterEstimate* const parameter = parameter_of(row, quantity)) {
        if (!parameter->quantiles.empty()) return of_posterior(*parameter);
        return QuantityEstimate{.value = parameter->value,
                                .sigma = parameter->sigma,
                                .interval_95 = parameter->interval_95,
                                .decided_by_prior = parameter->decided_by_prior,
                                .split_by_model = parameter->split_by_model};
    }
    if (const TissueValue* const tissue = tissue_of(row, quantity)) {
        return QuantityEstimate{.value = tissue->value, .sigma = {}, .interval_95 = tissue->interval_95};
    }
    if (const IndexValue* const index = index_of(row, quantity)) {
        return QuantityEstimate{.value = index->value, .sigma = index->sigma, .interval_95 = {}};
    }
    return std::nullopt;
}

}  // namespace skinfit
